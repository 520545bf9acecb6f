#!/bin/bash
# `glint passes` and `glint ephemeris` from outside: formats, merged tables, exit statuses.
# usage: test_passes.sh PROGRAM SCENARIO_DIR
set -u
glint=$(readlink -f "$1") scenarios=$(readlink -f "$2")
export LC_ALL=C.UTF-8
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
failures=0

# t NAME STATUS WORD...: runs `glint WORD...`, and its exit status must be STATUS.
t() {
    name=$1
    local want=$2 got=0
    shift 2
    "$glint" "$@" >out 2>err </dev/null || got=$?
    [ "$got" = "$want" ] || fail "exit status $got, expected $want"
}
fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s: %s\n' "$name" "$1"
    head -n 8 out err
}
has() { grep -qF -e "$2" "$1" || fail "'$2' is not in $1"; }
lacks() { ! grep -qF -e "$2" "$1" || fail "'$2' is in $1"; }

cat >orbit.toml <<'END'
title = "no \"satellite\", one orbit"
[time]
start = 2024-01-01T12:30:00Z
duration_s = 86400
step_s = 3600
[observer]
name = "Vienna"
latitude_deg = 48.2
longitude_deg = 16.37
min_elevation_deg = 10
[orbit]
circular = { height_km = 780, inclination_deg = 98.6, raan_deg = 80, argument_of_latitude_deg = 132 }
END
sed 's/raan_deg = 80/raan_deg = 140/; s/^title.*/title = "other"/' orbit.toml >other.toml
sed 's/latitude_deg = 48.2/latitude_deg = -95/' orbit.toml >wrong.toml

t 'a table for people' 0 passes orbit.toml
has out 'culmination'
has out 'no "satellite", one orbit, Vienna'
t 'a pass of several days names them' 0 passes orbit.toml --set time.duration_s=200000 \
    --set 'orbit={circular={geostationary_longitude_deg=16.37}}'
for day in 02 03; do # the site gets light and dark on both
    [ "$(grep -c "^2024-01-$day  .* the site is" out)" = 2 ] || fail "not two notes of January $day"
done
t 'a culmination days after the rise is told with its date' 0 passes orbit.toml \
    --set time.duration_s=400000 --set 'orbit={kepler={semi_major_axis_km=41000,eccentricity=0,inclination_deg=0.05,raan_deg=0,argument_of_perigee_deg=0,mean_anomaly_deg=255,j2=false}}'
grep -q '^2024-01-0[3-5]  .* culmination$' out || fail 'the culmination has no date'
t 'a table in a file' 0 passes orbit.toml -o table.txt
[ ! -s out ] && [ -s table.txt ] || fail 'the file is empty, or standard output is not'
t 'csv' 0 passes orbit.toml other.toml --format csv
has out '# %ECSV 1.0'
grep -v '^#' out | sed 1d | awk -F, '{ print $(NF - 16) }' >times
sort -c times || fail 'events are not in order of time'
[ "$(grep -c ',culmination,' out)" = "$(tail -n 1 out | awk -F, '{ print $(NF - 18) }')" ] ||
    fail 'not one culmination for every pass'
has out 'other,Vienna,'
lacks out 'time.step_s'
t 'csv of several scenarios says what was set' 0 passes orbit.toml other.toml --format csv \
    --set time.step_s=1800
[ "$(grep -c 'time.step_s=1800' out)" = 1 ] || fail 'what was set is not told once'
if command -v python3 >/dev/null; then
    t 'json of passes' 0 passes orbit.toml --format json
    python3 -c 'import json, sys
d = json.load(open("out"))
assert d["passes"][0]["satellite"] == "no \"satellite\", one orbit"
assert all(any(e["event"] == "culmination" for e in p["events"]) for p in d["passes"])' ||
        fail 'the JSON is not as expected'
    t 'what was set is told of several scenarios, too' 0 passes orbit.toml other.toml --format json \
        --set time.step_s=1800 --set time.duration_s=7200
    python3 -c 'import json
d = json.load(open("out"))
assert d["set"] == ["time.step_s=1800", "time.duration_s=7200"], d["set"]
assert len(d["scenario_hash"]) == len(d["orbit"]) == 2' || fail 'the JSON is not as expected'
    t 'json of an ephemeris' 0 ephemeris orbit.toml --format json
    python3 -c 'import json
d = json.load(open("out"))
assert len(d["rows"]) == 25 and "q_w" not in d["rows"][0] and d["rows"][24]["t_s"] == 86400' ||
        fail 'the JSON is not as expected'
else
    echo 'SKIPPED: JSON: no python3'
fi
t 'help tells of both shadows' 0 passes --help
has out 'the shadows of Earth and Moon'
t 'no pass at all' 0 passes orbit.toml --set time.duration_s=1
has out 'no pass'
t 'an ephemeris' 0 ephemeris orbit.toml
[ "$(grep -vc '^#' out)" = 26 ] || fail 'not 25 rows and a header'
lacks out q_w
lacks out x_teme_km
t 'an ephemeris for people' 0 ephemeris orbit.toml --format table
[ "$(wc -l <out)" = 26 ] || fail 'not 25 rows and a header'
t 'a satellite has brightness' 0 passes -q "$scenarios/iss-vienna.toml" --format csv
has out ',brightest,'
t 'an ephemeris with attitude and hinges' 0 ephemeris -q "$scenarios/iss-vienna.toml"
has out q_w
has out _deg,hinge_
t 'a run needs a satellite' 1 run orbit.toml
t 'a wrong scenario' 1 passes orbit.toml wrong.toml
has err 'latitude_deg'
[ ! -s out ] || fail 'something was written'
t 'a wrong angle' 2 passes orbit.toml --flash-angle 0
t 'a wrong angle of flashes' 2 passes orbit.toml --flash-angle x
t 'an option of another command' 2 ephemeris orbit.toml --flash-angle 1
t 'a wrong format' 2 passes orbit.toml --format xml
has err 'table, csv, json'
t 'an output that cannot be written' 3 passes orbit.toml -o /nonexistent/out.txt
t 'given directions' 1 passes "$scenarios/known/cube.toml"
has err '[geometry]'
t 'what is wrong with any scenario is said before the work begins' 1 passes -q \
    "$scenarios/iss-vienna.toml" "$scenarios/known/cube.toml" "$scenarios/geo-moon-shadow.toml"
has err '[geometry]'
has err 'no observer is a site'

[ $failures = 0 ] && echo 'passes and ephemerides from outside: all as expected'
exit $((failures > 0))
