#!/bin/bash
# Every scenario that ships: it can be checked and run, gives rows with magnitudes, and those that carry
# expectations meet them.
# usage: test_scenarios.sh GLINT SCENARIO_DIR
set -u
glint=$1
dir=$2
failed=0

fail() {
    echo "FAILED: $1"
    failed=1
}

shopt -s nullglob
files=("$dir"/*.toml)
[ ${#files[@]} -gt 0 ] || fail "there are no scenarios in $dir"
for file in "${files[@]}"; do
    name=${file##*/}
    grep -q '^# What to look at' "$file" || fail "$name does not say what to look at"
    "$glint" check "$file" >/dev/null || fail "glint check $name"
    rows=$("$glint" run "$file" --quiet | grep -v '^#' | tail -n +2) || fail "glint run $name"
    bright=$(cut -d, -f3 <<<"$rows" | grep -c .)
    [ "$bright" -gt 10 ] || fail "$name has only $bright rows with a magnitude"
    ! grep -qi nan <<<"$rows" || fail "$name has a NaN"
    if grep -qE '^\[(\[expect|\[require|expect_table)' "$file"; then
        "$glint" verify "$file" || fail "glint verify $name"
    fi
done
for file in "$dir"/models/*.toml; do
    "$glint" check "$file" >/dev/null || fail "glint check models/${file##*/}"
done
echo "${#files[@]} scenarios"
exit $failed
