#!/bin/bash
# The example of every command's --help, run as it is written, in a folder that holds scenarios/.
# usage: test_examples.sh PROGRAM SCENARIO_DIR
set -u
glint=$(readlink -f "$1") scenarios=$(readlink -f "$2")
export LC_ALL=C.UTF-8
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
mkdir bin
ln -s "$glint" bin/glint
ln -s "$scenarios" scenarios
export PATH="$place/bin:$PATH"

# What the example of `brdf fit` reads: a matt surface with a lobe about the mirror direction, in
# the plane of incidence; the zenith angle of what leaves it has a sign.
awk 'BEGIN {
    for (i = 10; i <= 60; i += 10)
        for (r = -80; r <= 80; r += 5)
            printf "%d,180,%d,0,%.6g\n", i, r, 0.05 + 2 * exp(-((r - i) / 8) ^ 2)
}' >chassis_brdf.csv

checks=0 failures=0
while read -r name; do
    # shellcheck disable=SC2086 # some names have two words
    example=$(glint $name --help | sed -n '/^example: /{n;s/^  //p}')
    checks=$((checks + 1))
    case $example in
    "glint $name"*) ;;
    *)
        failures=$((failures + 1))
        echo "FAILED: 'glint $name --help' has no example of its own: '$example'"
        continue
        ;;
    esac
    case $example in
    *--plot*)
        if ! command -v gnuplot >/dev/null; then
            echo "SKIPPED: $example: no gnuplot"
            continue
        fi
        ;;
    esac
    status=0
    bash -c "$example" >out 2>err </dev/null || status=$?
    if [ $status != 0 ]; then
        failures=$((failures + 1))
        echo "FAILED: exit status $status of: $example"
        head -n 5 err
    fi
done < <(glint --help | sed -n '/^commands:/,/^$/s/^  \([a-z]\+\( [a-z]\+\)\?\) .*/\1/p')

[ $checks -ge 7 ] || {
    failures=$((failures + 1))
    echo "FAILED: only $checks commands were found in 'glint --help'"
}
[ $failures = 0 ] && echo "$checks examples: all run as written"
exit $((failures > 0))
