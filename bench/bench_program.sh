#!/bin/bash
# The whole program: a million rows (with self-shadows: 100 000) of a satellite of 50 facets, on one
# thread and on all, the table to /dev/null; and, by bench_curve, the share of writing in it.
# usage: bench_program.sh BUILD_DIR
set -eu -o pipefail
[ $# = 1 ] || {
    echo "usage: bench_program.sh BUILD_DIR" >&2
    exit 2
}
glint=$(readlink -f "$1/glint") curve=$(readlink -f "$1/bench/bench_curve")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scenario=$here/fifty.toml
rounds=5
export LC_ALL=C
TIMEFORMAT='%R %U %S'

# least THREADS OVERRIDE...: rows, and the least elapsed and processor time of the rounds, in s.
least() {
    local threads=$1 sets=() rows word
    shift
    for word; do sets+=(--set "$word"); done
    rows=$("$glint" run "$scenario" --threads "$threads" "${sets[@]}" -o /dev/null 2>&1 |
        sed -n 's/^rows *\([0-9]*\),.*/\1/p')
    for ((round = 0; round < rounds; round++)); do
        { time "$glint" run -q "$scenario" --threads "$threads" "${sets[@]}" -o /dev/null; } 2>&1
    done | awk -v rows="$rows" '
        NR == 1 || $1 < elapsed { elapsed = $1 }
        NR == 1 || $2 + $3 < cpu { cpu = $2 + $3 }
        END { printf "%d %.3f %.3f\n", rows, elapsed, cpu }'
}

# measure TITLE OVERRIDE...
measure() {
    local title=$1 rows elapsed cpu all
    shift
    read -r rows elapsed cpu < <(least 1 "$@")
    read -r _ all _ < <(least 0 "$@")
    awk -v title="$title" -v rows="$rows" -v cpu="$cpu" -v elapsed="$elapsed" -v all="$all" \
        -v n="$(nproc)" 'BEGIN {
        printf "%s: %d rows, %.3f s of processor time, %.2f M rows/s\n", title, rows, cpu, rows / cpu * 1e-6
        printf "on %d threads: %.2f times as fast by the clock\n", n, elapsed / all }'
    "$curve" "$scenario" "$@"
    echo
}

none='satellite.self_shadows="none"'
measure 'one pass in steps of 0.42 ms, all rows bright, no self-shadows' "$none"
measure 'eleven days in steps of 1 s, most rows below the horizon, no self-shadows' "$none" \
    time.step_s=1 time.duration_s=999999
measure 'one pass in steps of 4.2 ms, exact self-shadows' time.step_s=0.0042
