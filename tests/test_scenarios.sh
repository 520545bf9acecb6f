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
    column=$("$glint" run "$file" --quiet | grep -v '^#' | head -n 1 | tr , '\n' | grep -n -m 1 '^mag_')
    bright=$(cut -d, -f"${column%%:*}" <<<"$rows" | grep -c .)
    [ "$bright" -gt 10 ] || fail "$name has only $bright rows with a magnitude"
    ! grep -qi nan <<<"$rows" || fail "$name has a NaN"
    if grep -qE '^\[(\[expect|\[require|expect_table)' "$file"; then
        "$glint" verify "$file" || fail "glint verify $name"
    fi
done
for file in "$dir"/models/*.toml; do
    "$glint" check "$file" >/dev/null || fail "glint check models/${file##*/}"
done
# A file of materials says of each where it comes from and what its standing is, and none of them makes
# light.
for file in "$dir"/materials/*.toml; do
    name=materials/${file##*/}
    said=$("$glint" check "$file" 2>&1 >/dev/null) || fail "glint check $name"
    ! grep -q 'more than it gets' <<<"$said" || fail "$name: $said"
    n=$(grep -c '^\[materials\.' "$file")
    [ "$(grep -c '^source = ".' "$file")" = "$n" ] || fail "$name: a material has no source"
    [ "$(grep -c '^status = ".' "$file")" = "$n" ] || fail "$name: a material has no status"
done
# Exposures against brute force: Simpson's rule over moments 2 ms apart, in the flashes.
rows() { "$glint" run "$dir/flashes-vienna.toml" --quiet "$@" | grep -v '^#' | tail -n +2; }
means=$(rows | awk -F, '$2 > 91 && $2 < 113 { print $2, $4 }')
brute=$(rows --set time.start=2025-07-25T20:38:31Z --set time.end=2025-07-25T20:38:53Z \
    --set time.step_s=0.002 --set time.exposure_s=1e-7 | awk -F, '
    NR > 1 { sum += 0.002 / 3 * (NR % 2 == 0 ? 4 * $4 : $4 + first); if (NR % 2) first = $4 }
    NR == 1 { first = $4 }
    NR > 1 && (NR - 1) % 1000 == 0 { printf "%d %.17g\n", 90 + 2 * (NR - 1) / 1000, sum / 2; sum = 0 }')
paste -d ' ' <(echo "$means") <(echo "$brute") | awk '
    { off = $2 / $4 - 1; if ($1 != $3 || off > 1e-5 || off < -1e-5) bad = 1; n++ }
    END { exit bad || n != 11 }' || fail "exposures of flashes-vienna.toml differ from sums of moments"
# A material can be set wherever its file is; one that no file has cannot.
plain=$("$glint" run "$dir/iss-vienna.toml" --quiet | sed -n '/^#/!p' | cksum)
for key in materials.mli.rho_d materials.white-paint.rho; do
    "$glint" run "$dir/iss-vienna.toml" --quiet --set "$key=0.3" >/dev/null || fail "--set $key"
done
changed=$("$glint" run "$dir/iss-vienna.toml" --quiet --set materials.mli.rho_d=0.3 |
    sed -n '/^#/!p' | cksum)
[ "$plain" != "$changed" ] || fail "--set materials.mli.rho_d changes nothing"
! "$glint" run "$dir/iss-vienna.toml" --quiet --set materials.nil.rho=0.3 >/dev/null 2>&1 ||
    fail "--set of a material that is not there"
echo "${#files[@]} scenarios"
exit $failed
