#!/bin/bash
# The program from outside: help, exit statuses, messages, output files, pipes and terminals.
# usage: test_cli.sh PROGRAM SOURCE_DIR VERSION
set -u
glint=$(readlink -f "$1") source=$(readlink -f "$2") version=$3
export LC_ALL=C.UTF-8
unset NO_COLOR
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
[ -x "$glint" ] || {
    echo "no program: $1"
    exit 1
}
out=$place/out err=$place/err
checks=0 failures=0 name=

# ------------------------------------------------------------------ helpers

fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s: %s\n' "$name" "$1"
    sed 's/^/    stdout: /' "$out" | head -n 12
    sed 's/^/    stderr: /' "$err" | head -n 12
}

skip() { printf 'SKIPPED: %s: %s\n' "$1" "$2"; }

# t NAME STATUS WORD...: runs `glint WORD...`, and its exit status must be STATUS.
t() {
    local want=$2 got=0
    name=$1
    shift 2
    checks=$((checks + 1))
    "$glint" "$@" >"$out" 2>"$err" </dev/null || got=$?
    [ "$got" = "$want" ] || fail "exit status $got, expected $want, of: glint $*"
}

# Each text must (must not) be in the file.
has() {
    local file=$1 text
    shift
    for text in "$@"; do
        grep -qF -e "$text" "$file" || fail "'$text' is not in $(basename "$file")"
    done
}
lacks() {
    local file=$1 text
    shift
    for text in "$@"; do
        ! grep -qF -e "$text" "$file" || fail "'$text' is in $(basename "$file")"
    done
}
lines() { # FILE N
    [ "$(wc -l <"$1")" = "$2" ] || fail "$(basename "$1") has $(wc -l <"$1") lines, expected $2"
}
empty() { [ ! -s "$1" ] || fail "$(basename "$1") is not empty"; }
# holds NAME COMMAND...: the command must succeed.
holds() {
    name=$1
    shift
    checks=$((checks + 1))
    "$@" || fail "not so: $*"
}

matches() { compgen -G "$1" >/dev/null; }

# ------------------------------------------------------------------- inputs

cat >directions.csv <<'END'
sun_x,sun_y,sun_z,obs_x,obs_y,obs_z
0,0,1,0,0,1
0,0,1,1,0,1
0,0,1,1,0,-1
END
cat >plate.toml <<'END'
title = "A white plate"
[geometry]
table = "directions.csv"
range_km = 1000
[satellite]
self_shadows = "none"
[photometry]
bands = ["V"]
solar_disc = "point"
[materials.white]
brdf = "lambert"
rho = 0.5
[[component]]
name = "plate"
[[component.plate]]
size_m = [1, 1]
normal = [0, 0, 1]
tangent = [1, 0, 0]
material = "white"
END
# Lambert: the flux ratio is rho/pi area cos cos / range^2 = 0.5/pi 1e-12 face on.
cat plate.toml - >good.toml <<'END'
[[expect]]
row = 0
column = "flux_ratio_V"
value = 1.5915494309189534e-13
relative = 1e-12
source = "closed form: Lambert plate"
[[expect]]
row = 1
column = "phase_angle_deg"
value = 45
tolerance = 1e-9
source = "closed form"
END
sed 's/^value = 45/value = 44/' good.toml >wrong.toml
sed 's/^title/titel/; s/^rho = 0.5/rho = 1.5/' plate.toml >broken.toml
sed 's/^table.*/sweep = { phase_deg = [0, 150, 0.002], plane = "xz" }/' plate.toml >long.toml

# --------------------------------------------------------------------- help

t 'no command: help on stderr' 2
empty "$out"
has "$err" 'usage: glint COMMAND'
t 'help' 0 --help
empty "$err"
has "$out" 'run SCENARIO' 'check FILE...' 'verify FILE...' 'shares SCENARIO' 'compare SCENARIO' 'passes SCENARIO...' 'ephemeris SCENARIO' 'view FILE' 'brdf list' 'brdf fit DATA' '--version' 'exit status' example
lacks "$out" sweep
cp "$out" help
for words in help -h 'help --help'; do
    # shellcheck disable=SC2086 # words are wanted
    t "help by '$words'" 0 $words
    holds 'the same help' cmp -s help "$out"
done
for command in run check verify shares compare passes ephemeris view 'brdf list' 'brdf show' 'brdf fit'; do
    # shellcheck disable=SC2086
    t "help of $command" 0 $command --help
    empty "$err"
    has "$out" "usage: glint $command" 'example:' "  glint $command" --output --format --threads \
        --quiet --help
    cp "$out" help
    # shellcheck disable=SC2086
    t "help of $command by help" 0 help $command
    holds 'the same help' cmp -s help "$out"
    # shellcheck disable=SC2086
    t "help of $command among other options" 0 $command --quiet --help nonsense
    holds 'the same help' cmp -s help "$out"
done
t 'help of a group' 0 brdf --help
has "$out" 'usage: glint brdf list'
t 'help of a group by help' 0 help brdf
has "$out" 'usage: glint brdf list'
t 'version' 0 --version
holds 'the version alone' [ "$(cat "$out")" = "glint $version" ]

# ----------------------------------------------------- wrong command lines

t 'a slip in a command' 2 rum plate.toml
empty "$out"
has "$err" "glint: error: unknown command 'rum'; did you mean 'run'?"
t 'another word for a command' 2 xyzzy
has "$err" "unknown command 'xyzzy'; this version has: run, check, verify, shares, compare, passes, ephemeris, view, brdf list, brdf show, brdf fit"
for command in sweep; do
    # shellcheck disable=SC2086
    t "$command is not built yet" 2 $command plate.toml
    empty "$out"
    has "$err" "'$command' is not built yet; this version has: run, check, verify, shares, compare, passes, ephemeris, view, brdf list, brdf show, brdf fit"
done
t 'help of a command that is not built' 2 help sweep
t 'half a command' 2 brdf
has "$err" "needs one more word: list, show, fit"
t 'a group without such a member' 2 brdf lst
has "$err" "has no 'lst'; it has: list, show, fit"
t 'an option of another command' 2 run plate.toml --swap A=B
has "$err" "unknown option '--swap'"
t 'a slip in an option' 2 run plate.toml --quite
has "$err" "did you mean '--quiet'?" "'glint run --help' says more"
t 'an unknown letter' 2 run plate.toml -x
t 'an unknown option of glint' 2 --versoin
has "$err" "did you mean '--version'?"
t 'a value too many' 2 run plate.toml --quiet=1
t 'a value too few' 2 run plate.toml --set
t 'no scenario' 2 run
has "$err" "'glint run' needs SCENARIO"
t 'two scenarios' 2 run plate.toml good.toml
t 'no file to check' 2 check
t 'no file to verify' 2 verify
t 'the list of models' 0 brdf list
empty "$err"
has "$out" 'lambert: ' 'mirror: ' 'table: ' '    source: ' 'above 0 to 100' 'above -1 to below 1' \
    '(rows)' required optional 'default 0'
t 'a file too many' 2 brdf list plate.toml
t 'a list without scenario takes no override' 2 brdf list --set a=1
t 'threads in words' 2 run plate.toml --threads two
t 'an unknown format' 2 run plate.toml --format json
has "$err" 'this command writes: csv'
t 'an override without value' 2 run plate.toml --set time.step_s
t 'an unknown shell' 2 --completion zsh
t 'an option alone' 2 --

# ---------------------------------------------------------------------- run

t 'run' 0 run plate.toml
has "$out" 't_s,mag_V,' '# %ECSV'
holds 'a header line and three rows' [ "$(grep -vc '^#' "$out")" = 4 ]
has "$err" 'rows       3, of which 2 have a magnitude' 'magnitude  V: minimum ' 'brighter   than 6: ' \
    'brightest  V '
lacks "$err" $'\r' $'\033'
cp "$out" table
for words in '--quiet' '-q' '--format csv' '--format=csv' '--threads 1' '--threads=2' '--threads 0'; do
    # shellcheck disable=SC2086
    t "the same table with $words" 0 run $words plate.toml
    holds 'the same table' cmp -s table "$out"
    case $words in *-q*) empty "$err" ;; esac
done
t 'the same table after --' 0 run -- plate.toml
holds 'the same table' cmp -s table "$out"
t 'an override' 0 run plate.toml --set 'photometry.bands=["V", "R"]'
has "$out" mag_V, mag_R,
t 'an override without a key' 2 run plate.toml --set '#=1'
has "$err" "--set '#=1': there is no key; expected key=value"
t 'two overrides' 0 run plate.toml --set 'photometry.bands=["R"]' --set geometry.range_km=2000
has "$out" mag_R,
lacks "$out" mag_V,
# Nothing is written over a file that the scenario is read from, whatever kind of file that is.
mkdir inputs
cp "$source/scenarios/iss.tle" inputs/sets.tle
printf 'azimuth_deg,elevation_deg\n0,0\n90,5\n' >inputs/mask.csv
printf 't_s,qw,qx,qy,qz\n-10,1,0,0,0\n100,0.8,0,0,0.6\n' >inputs/turn.csv
printf 't_s,angle_deg\n-10,0\n100,40\n' >inputs/hinge.csv
cp "$source/tests/data/orbit/eop_finals.txt" inputs/eop.txt
cp "$source/scenarios/known/mesh-cube.obj" inputs/cube.obj
cat >inputs/all.toml <<'END'
time = { start = 2025-07-25T20:00:00Z, duration_s = 60, step_s = 30 }
observer = { latitude_deg = 48, longitude_deg = 16, horizon = "mask.csv" }
orbit = { tle = "sets.tle" }
attitude = { law = "table", file = "turn.csv" }
satellite = { model = "model.toml" }
END
cat >inputs/model.toml <<'END'
materials.white = { brdf = "lambert", rho = 0.5 }
[[component]]
name = "body"
hinge = { origin_m = [0, 0, 0], axis = [0, 0, 1], table = "hinge.csv" }
mesh = [{ file = "cube.obj", material = "white" }]
END
cp -r inputs kept
for file in all.toml model.toml sets.tle mask.csv turn.csv hinge.csv cube.obj; do
    for command in run passes ephemeris; do
        t "$command over $file" 3 $command -q inputs/all.toml -o inputs/$file
        has "$err" "inputs/$file: error: the scenario is read from this file"
        holds "$file as it was" cmp -s kept/$file inputs/$file
    done
done
t 'a run over its Earth orientation' 3 ephemeris -q inputs/all.toml -o inputs/eop.txt \
    --set time.start=2016-04-25T20:00:00Z --set 'corrections={eop="inputs/eop.txt"}' \
    --set 'orbit={circular={geostationary_longitude_deg=10}}'
has "$err" "inputs/eop.txt: error: the scenario is read from this file"
t 'a run over its picture' 2 run plate.toml -o same.svg --plot same.svg
t 'a run over its picture, spelled in two ways' 2 run plate.toml -o ./same.svg --plot same.svg
has "$err" "both go to 'same.svg'"
t 'an absent scenario' 1 run absent.toml
empty "$out"
has "$err" absent.toml 'No such file'
t 'a directory' 1 run .
t 'an empty file name' 1 run ''
t 'all that is wrong in a file, with places' 1 run broken.toml
empty "$out"
has "$err" "broken.toml:1:1: error: " "'title'" 'broken.toml:12:'
t 'an unknown key by override' 1 run plate.toml --set photometry.band='"V"'
has "$err" bands
t 'an override that is no TOML' 1 run plate.toml --set photometry.bands=V]
t 'control letters of file names are not sent to terminals' 1 run $'ab\033[31msent.toml'
lacks "$err" $'\033'

# ------------------------------------------------------------- output files

t 'a file' 0 run plate.toml -o file.csv
empty "$out"
has "$err" 'rows       3'
holds 'the same table' cmp -s table file.csv
(umask 027 && "$glint" run -q plate.toml --output=private.csv)
holds 'permissions follow the umask' [ "$(stat -c %a private.csv)" = 640 ]
mkdir elsewhere
ln -s elsewhere/new.csv dangling.csv
ln -s dangling.csv chain.csv
t 'a link to where nothing is' 0 run plate.toml -q -o chain.csv
holds 'the links stay' [ -L chain.csv -a -L dangling.csv ]
holds 'the file is written where they point to' cmp -s table elsewhere/new.csv
ln -s loop.csv loop.csv
t 'a link to itself' 3 run plate.toml -q -o loop.csv
ln -s no/such/folder.csv lost.csv
t 'a link into a folder that is not there' 3 run plate.toml -q -o lost.csv
holds 'the link stays' [ -L lost.csv ]
ln -s file.csv link.csv
t 'a link' 0 run plate.toml -qolink.csv
empty "$err"
holds 'a link stays a link' [ -L link.csv ]
echo precious >kept.csv
t 'a run that fails' 1 run broken.toml -o kept.csv
holds 'leaves the file as it was' [ "$(cat kept.csv)" = precious ]
t 'a run that fails makes no file' 1 run broken.toml -o new.csv
holds 'no file' [ ! -e new.csv ]
t 'a folder that is not there' 3 run plate.toml -o no/such/file.csv
lines "$err" 1
has "$err" no/such/file.csv error:
t 'a folder for a file' 3 run plate.toml -o .
lines "$err" 1
t 'a device' 0 run plate.toml -o /dev/null
holds 'a device stays a device' [ -c /dev/null ]
t 'a device that is full' 3 run plate.toml -o /dev/full
lines "$err" 1
mkfifo fifo
timeout 60 cat fifo >from-fifo &
t 'a named pipe' 0 run plate.toml -o fifo
wait $!
holds 'the same table' cmp -s table from-fifo
holds 'a named pipe stays one' [ -p fifo ]
holds 'nothing left behind' [ -z "$(find . -name '*.??????' -newer plate.toml -name '*csv*')" ]
for words in 'check plate.toml' 'verify good.toml' 'brdf list'; do
    # shellcheck disable=SC2086
    t "$words on stdout" 0 $words
    cp "$out" wanted
    # shellcheck disable=SC2086
    t "$words in a file" 0 $words -o text
    empty "$out"
    holds 'the same text' cmp -s wanted text
    rm text
    # shellcheck disable=SC2086
    t "$words in a folder that is not there" 3 $words -o no/such/text
    has "$err" no/such/text
    # shellcheck disable=SC2086
    t "$words to a full device" 3 $words -o /dev/full
    # shellcheck disable=SC2086
    t "$words to a device" 0 $words -o /dev/null
done

# ------------------------------------------------------------ stdout, pipes

for words in --help --version --man 'run plate.toml' 'check plate.toml' 'verify good.toml' 'brdf list'; do
    name="$words on a full device" checks=$((checks + 1))
    : >"$out"
    # shellcheck disable=SC2086
    "$glint" $words >/dev/full 2>"$err"
    status=$?
    [ $status = 3 ] || fail "exit status $status, expected 3"
    has "$err" 'standard output'
    name="$words on a closed stdout" checks=$((checks + 1))
    # shellcheck disable=SC2086
    "$glint" $words >&- 2>"$err"
    status=$?
    [ $status = 3 ] || fail "exit status $status, expected 3"
done
name='a reader that leaves early' checks=$((checks + 1))
"$glint" run long.toml 2>"$err" | head -n 1 >"$out"
status=${PIPESTATUS[0]}
[ "$status" = 3 ] || fail "exit status $status, expected 3"
empty "$err"
lines "$out" 1

# --------------------------------------------------------------------- view

for format in svg png pdf; do
    t "view as $format" 0 view plate.toml -o "view.$format"
    empty "$out"
    mv "view.$format" first
    t "view as $format again" 0 view plate.toml -o "view.$format"
    holds 'the same bytes' cmp -s first "view.$format"
    t "view as $format to a device" 0 view plate.toml --format $format -o /dev/null
    rm first "view.$format"
done
t 'view of a row' 0 view good.toml --at 1 --color material --size 640x480 -o row.png
t 'view without a file to write' 2 view plate.toml
has "$err" 'expected -o FILE'
t 'view as another format' 2 view plate.toml -o view.gif
t 'view at no time' 2 view plate.toml --at yesterday -o view.png
has "$err" "'yesterday' is no row"
t 'view from nowhere' 2 view plate.toml --from 1,2 -o view.png
has "$err" '--from' 'observer, sun, or a direction'
t 'view from a direction of length 0' 2 view plate.toml --from 0,0,0 -o view.png
t 'view with a Sun of its own' 2 view plate.toml --sun 1,0,0 -o view.png
t 'view in another colouring' 2 view plate.toml --color red -o view.png
has "$err" 'brightness, material, lit'
t 'view of materials on a logarithmic scale' 2 view plate.toml --color material --log -o view.png
for size in 10x10 800 800x 800x600x2 -800x600 99999x600; do
    t "view in size $size" 2 view plate.toml "--size=$size" -o view.png
    has "$err" '--size'
done
t 'view of a wrong file' 1 view broken.toml -o view.png
has "$err" broken.toml:1:1:
t 'view into a folder that is not there' 3 view plate.toml -o no/such/view.png
holds 'no picture is left' [ ! -e view.png ]

# ------------------------------------------------------------ check, verify

t 'check' 0 check plate.toml
has "$out" plate.toml white lambert
empty "$err"
holds 'nothing that could be shadowed' grep -q '^shadows     none computed; 0 of 1 facets' "$out"
t 'check of what shadows what' 0 check "$source/scenarios/models/box-wing.toml"
has "$out" '6 of 10 facets can be shadowed' 'shadow of wing-north' '1 of 6 facets of bus'
t 'check of an observed track' 0 check "$source/scenarios/compare-vienna.toml"
has "$out" 'observed    53 observations of' '(csv), magnitudes apparent, band V, by Vienna; a zero point' \
    'from 2025-07-24T19:10:00Z to 2025-07-24T19:16:19Z'
holds 'one line for the attitude' [ "$(grep -c '^attitude' "$out")" = 1 ]
holds 'no blanks at ends of lines' [ "$(grep -c ' $' "$out")" = 0 ]
holds 'paths without a way back' [ "$(grep -c '/\.\./materials' "$err")" = 0 ]
t 'check with no TOML in --set' 1 check plate.toml --set materials.white.rho=half
has "$err" 'syntax error' 'the value must be TOML'
t 'check with a value that cannot be in --set' 1 check plate.toml --set materials.white.rho=nan
has "$err" 'expected a finite number'
lacks "$err" 'must be TOML'
t 'check goes on after a wrong file' 1 check broken.toml plate.toml absent.toml
has "$out" plate.toml
has "$err" broken.toml:1:1: absent.toml
cat >moves.toml <<'END'
[time]
start = 2025-07-25T20:37:00Z
duration_s = 60
step_s = 10
[observer]
latitude_deg = 48.2
longitude_deg = 16.37
[orbit]
circular = { height_km = 780, inclination_deg = 98.6, raan_deg = 80, argument_of_latitude_deg = 132 }
[[attitude]]
law = "table"
file = "turn.csv"
[[attitude]]
from = 2025-07-25T20:37:20Z
slew_s = 15
law = "nadir"
nadir = "geodetic"
[satellite]
model = "moves-model.toml"
END
cat >moves-model.toml <<'END'
[materials.white]
brdf = "lambert"
rho = 0.5
[[component]]
name = "wing"
hinge = { origin_m = [0, 1, 0], axis = [0, 1, 0], table = "angles.csv" }
[[component.plate]]
size_m = [1, 1]
normal = [0, 0, 1]
tangent = [1, 0, 0]
material = "white"
END
printf 't_s,qw,qx,qy,qz\n0,1,0,0,0\n40,0.8,0,0,0.6\n' >turn.csv
printf 'utc,angle_deg\n2025-07-25T20:37:00Z,0\n2025-07-25T20:38:00Z,90\n' >angles.csv
t 'check of motions' 0 check moves.toml moves-model.toml
has "$out" "attitude    table: CSV table 'turn.csv', 2 rows from 0 to 40 s" \
    'from 20 s by a slew of 15 s to nadir, geodetic' 'by a table of 2 angles from 0 to 60 s' \
    'by a table of 2 angles over 60 s'
empty "$err"
t 'run of motions' 0 run moves.toml
has "$out" '# - attitude:' "#   - \"table: CSV table 'turn.csv', 2 rows from 0 to 40 s\"" \
    '#   - "from 20 s by a slew of 15 s to nadir, geodetic"' '# - attitude_slews:' \
    '# - attitude_tables:'
t 'check of a table that is too short' 0 check moves.toml --set 'attitude.1={from=50,law="nadir"}'
has "$err" 'the attitude table says nothing at 40 s from the start'
t 'check of a spin with an offset' 0 check -q "$source/scenarios/flashes-vienna.toml" \
    --set 'attitude.offset_deg={axis=[1,2,3],angle=-3}'
has "$out" 'attitude    spin, one turn in 30 s, with an offset of 3 deg'
t 'run beyond a table' 1 run moves.toml --set 'attitude.1={from=50,law="nadir"}'
has "$err" 'says nothing at' 'it ends at 40 s'
t 'verify' 0 verify good.toml
lines "$out" 1
has "$out" 'ok    good.toml: 2 expectations'
has "$err" '1 of 1 file as expected, 2 expectations compared'
t 'verify a deviation' 1 verify good.toml wrong.toml
lines "$out" 2
has "$out" 'ok    good.toml: 2 expectations' 'FAIL  wrong.toml: 1 of 2 expectations not met'
has "$err" 'wrong.toml:' error: phase_angle_deg '1 of 2 files as expected'
t 'verify in silence' 1 verify -q wrong.toml
lines "$out" 1
lines "$err" 1
t 'verify what expects nothing' 1 verify plate.toml
has "$out" 'FAIL  plate.toml'
t 'verify an absent file and go on' 1 verify absent.toml good.toml
has "$out" 'FAIL  absent.toml' 'ok    good.toml'
t 'verify with an override' 1 verify good.toml --set materials.white.rho=0.4
has "$err" flux_ratio_V

t 'brdf list' 0 brdf list
empty "$err"
has "$out" 'lambert: ' 'ward: ' 'ward-gmd: ' 'source: ' alpha_x required
lacks "$out" nan inf

# Two materials; the peak of ward at normal incidence is (rho_d + rho_s/(4 alpha^2)) / pi.
cat >materials.toml <<'END'
[materials.white]
brdf = "lambert"
rho = 0.5
[materials.lobe]
brdf = "ward"
rho_d = 0.1
rho_s = 0.4
alpha_x = 0.1
alpha_y = 0.1
[materials.lobe.bands.V]
rho_s = 0.2
END
t 'curves of all materials of a file' 0 brdf show materials.toml
has "$out" '# %ECSV' \
    'material,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,signed_theta_r_deg,f_per_sr,g_per_sr' \
    'white,75,0,89.5,180,89.5,0.159154943' 'lobe,0,0,0,180,0,3.2149298' \
    'lobe: ward rho_d=0.1 rho_s=0.4 alpha_x=0.1 alpha_y=0.1'
has "$err" 'peaks     0 deg: white 0.15915 per sr at 0.00 deg; lobe 3.2149 per sr at 0.00 deg, ratio 20.2000'
lines "$err" 6
holds '2 materials, 6 angles, 359 directions' [ "$(grep -c '^white,\|^lobe,' "$out")" = 4308 ]
cp "$out" curves
t 'the same in two words' 0 brdf show -q materials.toml:white materials.toml:lobe
empty "$err"
holds 'the same table' cmp -s curves "$out"
t 'the same in a file' 0 brdf show -q materials.toml -o curves.csv
empty "$out"
holds 'the same table' cmp -s curves curves.csv
t 'one material in a band' 0 brdf show materials.toml:lobe --band V --incidence 0 --step 45
has "$out" ', in band V' 'lobe,0,0,45,0,-45' 'lobe,0,0,0,180,0,1.623380'
holds 'three directions' [ "$(grep -c '^lobe,' "$out")" = 3 ]
t 'a map' 0 brdf show materials.toml:lobe --hemisphere 30 --step 10 --azimuth -20
holds 'the normal and eight rings' [ "$(grep -c '^lobe,' "$out")" = $((1 + 8 * 36)) ]
has "$out" 'lobe,30,-20,30,160,' 'theta_r_deg,phi_r_deg,f_per_sr,g_per_sr'
empty "$err"
printf '%s\n' phi_i_deg,theta_i_deg,phi_r_deg,theta_r_deg 0,0,0,45 0,0,0,90 >angles.csv
t 'values at given angles' 0 brdf show materials.toml:white --geometry angles.csv
has "$out" 'white,0,0,45,0,0.159154943' 'white,0,0,90,0,0,0'
t 'reflectances' 0 brdf show materials.toml:white --dhr --incidence 0,60
has "$out" 'material,theta_i_deg,phi_i_deg,dhr,dhr_error' white,60,0,0.5
printf '%s\n' phi_i_deg,theta_i_deg,phi_r_deg,theta_r_deg 0,0,0,x 0,99,0,45 >wrong.csv
t 'wrong angles, with places' 1 brdf show materials.toml --geometry wrong.csv
has "$err" wrong.csv:2:7: wrong.csv:3:3:
t 'a material that is not there' 1 brdf show materials.toml:withe
empty "$out"
has "$err" "materials.toml: error: there is no material 'withe' (did you mean 'white'?)"
t 'all that is wrong' 1 brdf show absent.toml:a materials.toml:b broken.toml
has "$err" absent.toml "'b'" broken.toml
t 'a file without materials' 1 brdf show angles.csv
cp materials.toml a:b.toml
t 'a file with a colon' 0 brdf show a:b.toml
t 'a material of a file with a colon' 0 brdf show a:b.toml:lobe
t 'two of the same name' 0 brdf show a:b.toml:lobe materials.toml:lobe --incidence 0 --step 45
has "$out" a:b.toml:lobe,0,0, materials.toml:lobe,0,0,
t 'no material' 2 brdf show
t 'a band that is none' 2 brdf show materials.toml --band W
has "$err" "'W' is not a band"
for words in '--incidence 90' '--incidence 1,,2' '--incidence nan' '--incidence 0x10' '--incidence=' \
    '--hemisphere -1' '--step 0' '--step 46' '--azimuth 400' '--azimuth 1,2'; do
    # shellcheck disable=SC2086
    t "angles that cannot be: $words" 2 brdf show materials.toml $words
    empty "$out"
done
for words in '--incidence 0 --hemisphere 0' '--geometry angles.csv --dhr' '--dhr --step 1' \
    '--geometry angles.csv --azimuth 1' '--hemisphere 0 --geometry angles.csv'; do
    # shellcheck disable=SC2086
    t "ways to show that exclude each other: $words" 2 brdf show materials.toml $words
done
for words in '--incidence 0,0.26,0.52,0.79,1.05' '--incidence 0.5236' '--hemisphere 1.047'; do
    # shellcheck disable=SC2086
    t "angles that look like radians: $words" 2 brdf show materials.toml $words
    has "$err" 'which look like radians; expected degrees, or --angles deg'
    # shellcheck disable=SC2086
    t "the same meant as degrees: $words" 0 brdf show materials.toml $words --step 45 --angles deg
done
t 'small angles in tenths' 0 brdf show materials.toml:white --incidence 0,0.5,1,1.5 --step 45
t 'radians' 2 brdf show materials.toml --angles rad
has "$err" "--angles has 'rad'"
printf '%s\n' phi_i_deg,theta_i_deg,phi_r_deg,theta_r_deg 0,0.3,0,0.7 0,1.5,0,0.2 >small.csv
t 'a file of angles that look like radians' 1 brdf show materials.toml:white --geometry small.csv
has "$err" 'small.csv:3:3:' '1.5: these look like radians'
t 'a file of small angles' 0 brdf show materials.toml:white --geometry small.csv --angles deg
has "$out" white,1.5,0,0.2,0
t 'a map too fine' 2 brdf show materials.toml --hemisphere 0 --step 0.1
has "$err" 'the step is 0.1 deg'
t 'curves in a folder that is not there' 3 brdf show materials.toml -o no/such/file.csv
for words in 'run plate.toml' 'shares plate.toml' 'brdf show materials.toml'; do
    # shellcheck disable=SC2086
    t "$words with a picture of another kind" 2 $words --plot picture.jpg
    has "$err" 'picture.jpg' '.svg, .png or .pdf'
    empty "$out"
    name="$words with a picture, without gnuplot" checks=$((checks + 1)) got=0
    # shellcheck disable=SC2086
    PATH=/no/such/folder "$glint" $words --plot picture.png >"$out" 2>"$err" || got=$?
    [ "$got" = 3 ] || fail "exit status $got, expected 3"
    has "$err" 'gnuplot' 'apt-get install gnuplot-nox'
    lines "$err" 1
    empty "$out"
done

# ------------------------------------------------------ shares and tracks

t 'shares' 0 shares plate.toml
empty "$err"
has "$out" 'light in 2 of 3 rows' 'materials ' 'components ' 'surfaces ' '/+z'
t 'shares as JSON' 0 shares plate.toml --format json
has "$out" '"shares": [' '"share_mean": 1'
t 'passes say what run they are of' 0 passes -q "$source/scenarios/iss-vienna.toml" --format csv
has "$out" '# - scenario_hash: ' '# - orbit: "SGP4' '# - zero_point_V: '
t 'passes of two scenarios say both' 0 passes -q "$source"/scenarios/{iss-vienna,flashes-vienna}.toml --format json
has "$out" '"scenario_hash": [' '"A spinning stage flashes over Vienna"' '"time_scale": '
t 'shares in a file' 0 shares plate.toml --format csv -o shares.csv
empty "$out"
has shares.csv '# %ECSV 1.0' 'kind,name,component,material,facing'
lacks shares.csv '# - set:' '# - swap:'
t 'shares of a changed satellite' 0 shares plate.toml --format csv --swap white=white --set materials.white.rho=0.2
has "$out" '# - scenario_hash: ' '# - set:' '#   - "materials.white.rho=0.2"' '# - swap:' '#   - "white=white"'
t 'shares of a changed satellite as JSON' 0 shares plate.toml --format json --swap white=white
has "$out" '"scenario_hash": ' '"swap": [' '"white=white"' '"set": []'
t 'shares of a changed satellite for people' 0 shares plate.toml --swap white=white
has "$out" 'changed (white=white): light in'
t 'shares in a folder that is not there' 3 shares plate.toml -o no/such/file.csv
t 'a swap without a name' 2 shares plate.toml --swap
t 'a swap that is none' 2 shares plate.toml --swap white
has "$err" 'expected A=B'
empty "$out"
t 'a swap of a material that is not there' 2 shares plate.toml --swap whit=white
has "$err" "no material 'whit'; did you mean 'white'?"
t 'without a component that is not there' 2 shares plate.toml --without plat
has "$err" "there is no component 'plat'"
t 'a swap to nothing like what there is' 2 shares plate.toml --swap white=gold
has "$err" "there is no material 'gold'; there are: white"
t 'shares of a scenario that is not there' 1 shares nothere.toml
track=$source/scenarios/compare-vienna.toml
t 'a track' 0 compare -q "$track"
empty "$err"
has "$out" '53 of 53 observations compared' 'zero point of +0.28' 'Pearson R 0.99' 'chi^2 '
t 'a track as CSV' 0 compare -q "$track" --format csv -o residuals.csv
has residuals.csv '# %ECSV 1.0' 'line,utc,t_s,observed,sigma,predicted,residual,state'
has residuals.csv '# - title: "Box-wing over Vienna' '# - scenario_hash: ' '# - zero_point_V: ' '# - rms_mag: '
t 'a track as JSON' 0 compare -q "$track" --format json --threads 2 --set observed.fit_zero_point=false
has "$out" '"scenario_hash": ' '"observed.fit_zero_point=false"' '"observations_compared": [' '"rms_mag": '
t 'a track of another format' 1 compare -q "$track" --set 'observed.format="mmt"'
has "$err" 'has 1 word; expected nine or ten' 'more errors are not shown'
lines "$err" 51
t 'a scenario without a track' 1 compare "$source/scenarios/iss-vienna.toml" -q
has "$err" 'no [observed]'
t 'a track in a folder that is not there' 3 compare -q "$track" -o no/such/file.csv
t 'a picture of a track of another kind' 2 compare -q "$track" --plot picture.jpg
cp "$source/scenarios/compare-vienna.csv" own.csv
sed "s#\"\(iss.tle\|models/\)#\"$source/scenarios/\1#; s#compare-vienna.csv#own.csv#" "$track" >own.toml
t 'a track that would be overwritten' 3 compare -q own.toml -o own.csv
has "$err" 'own.csv; expected another file'
holds 'the track as it was' cmp -s own.csv "$source/scenarios/compare-vienna.csv"
cp plate.toml plate-copy.toml
t 'shares over the scenario' 3 shares -q plate-copy.toml -o plate-copy.toml
holds 'the scenario as it was' cmp -s plate.toml plate-copy.toml
if command -v gnuplot >/dev/null; then
    t 'a picture of shares' 0 shares -q plate.toml --plot shares.svg
    has shares.svg '<svg' 'surfaces'
    t 'a picture in the place of its table' 2 shares -q plate.toml -o same.svg --plot same.svg
    has "$err" "both go to 'same.svg'"
    t 'a picture in the place of residuals' 2 compare -q "$track" -o same.svg --plot same.svg
    t 'a picture in the place of curves' 2 brdf show -q plate.toml -o same.svg --plot same.svg
    holds 'none of them written' [ ! -e same.svg ]
    t 'a picture of shares for two observers' 2 shares -q "$source/scenarios/geo-moon-shadow.toml" --plot two.svg
    has "$err" 'one observer, and there are 2'
    holds 'no picture for two' [ ! -e two.svg ]
    t 'a picture of a track' 0 compare -q "$track" --plot track.svg
    has track.svg '<svg' 'observed - predicted'
else
    skip 'pictures of shares and tracks' 'no gnuplot'
fi

printf 'theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n10,0,20,180\n10,0,30,18' >cut.csv
t 'values at angles of a file that is cut' 0 brdf show plate.toml --geometry cut.csv
has "$err" 'cut.csv:3:1: warning: the last row has no line end'
holds 'the whole row alone' [ "$(grep -vc '^#' "$out")" = 2 ]
printf 'sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n0,0,1,0,0,1\n0,0,1,0,0,0.' >cut.csv
t 'directions of a file that is cut' 0 run plate.toml --set 'geometry={table="cut.csv"}'
has "$err" 'cut.csv:3:1: warning: the last row has no line end'
holds 'the whole directions alone' [ "$(grep -vc '^#' "$out")" = 2 ]

# A Lambert surface of reflectance 0.2 and a lobe, at one incidence; the truth is among the models.
{
    echo 'theta_i,theta_r,f'
    awk 'BEGIN { for (r = -80; r <= 80; r += 2) {
        d = sin(r * 0.017453292519943295) - 0.5
        printf "30,%d,%.17g\n", r, 0.2 / 3.141592653589793 + 0.01 / (1e-3 + d * d) } }'
} >measured.csv
fit=(brdf fit measured.csv --signed-zenith --model 'lambert,lambert+abg')
t 'fits' 0 "${fit[@]}"
empty "$err"
has "$out" '# rank' 'lambert+abg: rms' '[materials.measured]' '[materials.measured-2]' 'g = 2'
lacks "$out" nan inf
cp "$out" fits
t 'fits in a file' 0 "${fit[@]}" -o fits.toml
holds 'the same materials' cmp -s fits fits.toml
has "$out" 'lambert+abg: rms' '+-'
lacks "$out" '[materials'
t 'fits in a folder that is not there' 3 "${fit[@]}" -o no/such/fits.toml
t 'fits by number of columns' 0 brdf fit measured.csv --columns theta_i=1,theta_r=2,f=3 \
    --signed-zenith --model 'lambert,lambert+abg'
holds 'the same fits' cmp -s fits "$out"
t 'fits nearer to the normal' 0 "${fit[@]}" --max-zenith 60
has "$out" '81 measurements, 61 fitted; left out: 20 more than 60 deg from the normal'
t 'fits above a floor' 0 "${fit[@]}" --floor 0.08
has "$out" 'without light'
t 'a fit of nothing' 2 brdf fit measured.csv
has "$err" 'expected --model'
t 'a fit of a slip' 2 brdf fit measured.csv --signed-zenith --model wrad
has "$err" "there is no BRDF 'wrad'; did you mean 'ward'?"
t 'a fit in gradians' 2 "${fit[@]}" --angles grad
has "$err" "--angles has 'grad'; expected deg or rad"
t 'a fit of a model of arrays' 2 brdf fit measured.csv --signed-zenith --model lambert,binomial
has "$err" "'binomial' cannot be fitted: it takes more than single numbers"
t 'a fit of a measured table' 2 brdf fit measured.csv --signed-zenith --model table
has "$err" "'table' cannot be fitted"
t 'a fit of a mirror' 2 brdf fit measured.csv --signed-zenith --model lambert+mirror
has "$err" "'mirror' cannot be fitted: f is a delta function"
awk -F, -v OFS=, 'NR > 1 { $1 *= 0.0174532925; $2 *= 0.0174532925 } 1' measured.csv >radians.csv
t 'a fit to unsaid radians' 1 brdf fit radians.csv --signed-zenith --model lambert
has "$err" 'radians.csv:2:10:' 'these look like radians' '--angles'
t 'a fit to radians' 0 brdf fit radians.csv --signed-zenith --model lambert --angles rad
t 'a fit to small degrees' 0 brdf fit radians.csv --signed-zenith --model lambert --angles deg
t 'a fit beyond the horizon' 2 "${fit[@]}" --max-zenith 95
t 'a fit to an absent file' 1 brdf fit absent.csv --model ward
t 'a fit to unsigned angles' 1 brdf fit measured.csv --model ward
has "$err" 'measured.csv:2:4:'
t 'a picture of another kind' 2 "${fit[@]}" --plot fits.gif
cat >panel.toml <<'END'
[geometry]
sweep = { phase_deg = [0, 85, 17], plane = "xz" }
[materials.panel]
brdf = "table"
file = "measured.csv"
signed_zenith = true
[[component]]
name = "c"
[[component.plate]]
size_m = [1, 1]
normal = [0, 0, 1]
tangent = [1, 0, 0]
material = "panel"
END
t 'a run with a measured material' 0 run panel.toml
has "$out" 'measured: "material panel in V: 81 rows of the plane of incidence'
# the light comes from up to 85 deg, and was measured up to 80 deg
has "$err" 'unmeasured panel: in 1 of 6 rows' 'the nearest measured values are taken'
t 'the same quietly' 0 run panel.toml -q
lacks "$err" unmeasured

# ---------------------------------------------------------------- terminals

if script -qec true /dev/null >/dev/null 2>&1; then
    name='colours on a terminal' checks=$((checks + 1))
    TERM=xterm script -qec "'$glint' run absent.toml" /dev/null >"$out" </dev/null
    has "$out" $'\033[1;31merror:\033[0m'
    name='NO_COLOR on a terminal' checks=$((checks + 1))
    NO_COLOR=1 TERM=xterm script -qec "'$glint' run absent.toml" /dev/null >"$out" </dev/null
    lacks "$out" $'\033'
    has "$out" 'error:'
    name='a dumb terminal' checks=$((checks + 1))
    TERM=dumb script -qec "'$glint' run absent.toml" /dev/null >"$out" </dev/null
    lacks "$out" $'\033'
    name='no progress bar where the table scrolls' checks=$((checks + 1))
    TERM=xterm script -qec "'$glint' run long.toml" /dev/null >"$out" </dev/null
    lacks "$out" '#####'
else
    skip 'terminals' 'script (of bsdutils) gets no terminal here'
fi

# --------------------------------------------------------- manual, completion

t 'the manual' 0 --man
empty "$err"
has "$out" '.TH GLINT 1' '.SH EXIT STATUS' '.SS glint run SCENARIO' '\-\-set' 'glint passes'
lacks "$out" sweep
if command -v groff >/dev/null; then
    holds 'the manual has no roff errors' [ -z "$(groff -man -Tutf8 -ww "$out" 2>&1 >/dev/null)" ]
else
    skip 'the manual has no roff errors' 'no groff'
fi

t 'completion' 0 --completion bash
empty "$err"
cp "$out" completion.bash
holds 'the completion is bash' bash -n completion.bash
# complete_words WORD...: what bash would offer for the last word.
complete_words() {
    bash -c 'source ./completion.bash; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _glint
             printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort | tr '\n' ' '
}
holds 'commands complete' [ "$(complete_words glint r)" = 'run ' ]
holds 'two-word commands complete' [ "$(complete_words glint brdf l)" = 'list ' ]
holds 'options complete' [ "$(complete_words glint run --th)" = '--threads ' ]
holds 'formats complete' [ "$(complete_words glint run --format c)" = 'csv ' ]
holds 'help topics complete' [ "$(complete_words glint help ver)" = 'verify ' ]
holds 'files complete' [ "$(complete_words glint run plate.t)" = 'plate.toml ' ]
holds 'output files complete' [ "$(complete_words glint run -o brok)" = 'broken.toml ' ]
holds 'picture files complete' [ "$(complete_words glint run --plot brok)" = 'broken.toml ' ]
holds 'models to fit complete' [ "$(complete_words glint brdf fit --model 'lambert,2*abg+ward-g')" = 'lambert,2*abg+ward-gmd ' ]
holds 'what cannot be fitted does not complete' [ "$(complete_words glint brdf fit --model bino)" = ' ' ]
holds 'models complete behind =' [ "$(complete_words glint brdf fit --model = ha)" = 'hapke ' ]
holds 'the first column completes' [ "$(complete_words glint brdf fit --columns phi_)" = 'phi_i= phi_r= ' ]
holds 'the next column completes' [ "$(complete_words glint brdf fit --columns theta_i = 1,theta_r = 2,f)" = '2,f= ' ]
holds 'data complete behind columns' [ "$(complete_words glint brdf fit --columns f = 5 measured.c)" = 'measured.csv ' ]
holds 'angles do not complete' [ "$(complete_words glint brdf show --incidence '')" = ' ' ]

# ------------------------------------------------- the table, as others read it

python=
for candidate in /usr/bin/python3 python3; do
    if "$candidate" -c 'import astropy.table' 2>/dev/null; then
        python=$candidate
        break
    fi
done
if [ -n "$python" ]; then
    cat >read.py <<'END'
import math, sys
from astropy.table import Table
table = Table.read(sys.argv[1], format="ascii.ecsv")
assert len(table) == 3, table
assert table["range_km"].unit == "km" and table["t_s"].unit == "s", table.info
assert table["mag_V"].mask.tolist() == [False, False, True], table["mag_V"]
assert math.isclose(table["flux_ratio_V"][0], 0.5 / math.pi * 1e-12, rel_tol=1e-12)
assert table.meta["title"] == "A white plate", table.meta
END
    holds 'astropy reads the table' "$python" read.py table
else
    skip 'astropy reads the table' 'no astropy'
fi

# ---------------------------------------------- what ships, as the help names it

while read -r file; do
    holds "the example's $file is there" matches "$source/$file"
done < <("$glint" --man | sed -n 's/\\-/-/g; s/^ *glint .* \(scenarios[^ ]*\.toml\).*/\1/p')
t 'known geometries come out as they should' 0 verify "$source"/scenarios/known/*.toml

printf '%d checks, %d failed\n' "$checks" "$failures"
[ "$failures" = 0 ]
