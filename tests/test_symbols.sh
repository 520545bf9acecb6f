#!/bin/bash
# Holds the external names of the library, in both of its forms, to the functions of glint.h: no
# other name, and none of them missing.
# usage: test_symbols.sh NM CC HEADER FORM LIBRARY INSIDE MAP
#   FORM: static, shared, or open (a static one whose inner names could not be hidden); INSIDE: the
#   archive of all objects, MAP: the linker's, of which the shared form is made where FORM is another
set -eu
nm=$1 cc=$2 header=$3 form=$4 library=$5 inside=$6 map=$7
if ! command -v "$nm" >/dev/null; then
    echo 'SKIPPED: external names of the library: no nm'
    exit 77
fi
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
failures=0

# Functions are what is declared at the beginning of a line, or behind a type there.
grep -v typedef "$header" | grep -oE '\bglint_[a-z0-9_]+\(' | tr -d '(' | sort -u >"$place/declared"

# names OPTION FILE: its external names. OpenMP sees to those of its named critical sections, which
# have ours in them; the address sanitizer reads what is no leak from __lsan_default_*; and the linker
# adds the version of a shared form.
names() {
    "$nm" "$1" --defined-only -P "$2" | awk 'NF >= 2 { print $1 }' |
        grep -vE '^(\.gomp_critical_user_glint_|__lsan_default_)' | sed 's/@.*//' | sort -u
}

# check WHAT OPTION FILE
check() {
    names "$2" "$3" >"$place/defined"
    if ! diff "$place/declared" "$place/defined" >"$place/difference"; then
        printf '%s: < in glint.h alone, > in the library alone\n' "$1"
        grep '^[<>]' "$place/difference" | head -20
        failures=$((failures + 1))
    fi
}

# A guard against a test that compares nothing with nothing.
grep -qx glint_version "$place/declared"

case $form in
    static) check 'the static library' -g "$library" ;;
    shared) check 'the shared library' -D "$library" ;;
esac
if [ "$form" != shared ]; then
    "$cc" -shared -o "$place/form.so" -Wl,--whole-archive "$inside" -Wl,--no-whole-archive \
        -Wl,--version-script="$map"
    check 'the shared form' -D "$place/form.so"
fi
if [ "$form" = open ] && [ "$failures" = 0 ]; then
    echo 'SKIPPED: external names of the static form: no tools to hide them'
    exit 77
fi
exit "$failures"
