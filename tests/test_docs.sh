#!/bin/bash
# Holds README.md and the pages of docs/ against the program: their commands run, their TOML is read, their
# programs work, their links lead somewhere, and docs/scenario.md names every key that is known.
# usage: test_docs.sh PROGRAM SOURCE_DIR API_PROGRAM
#   API_PROGRAM: the program in docs/api.md, compiled
#
# What a fence means:
#   sh        commands, run from a copy of the repository's root; none may fail
#   console   commands after "$ ", each followed by exactly what it prints on both streams
#   toml      with [time] or [geometry]: a complete scenario, which must run, and hold what it
#             expects; with materials or components: a complete model; else tables that a scenario
#             may have
#   python, gnuplot   scripts, run where the program and its modules are installed
#   c         compiled with the tests
#   text      anything else
# shellcheck disable=SC2016 # backquotes are wanted as they are
set -u
program=$(readlink -f "$1") source=$(readlink -f "$2") api_program=$(readlink -f "$3")
export LC_ALL=C.UTF-8
unset NO_COLOR
place=$(mktemp -d) || exit 1
trap 'rm -rf "$place"' EXIT
checks=0 failures=0

fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s: %s\n' "$1" "$2"
    [ -z "${3-}" ] || sed 's/^/    /' "$3" | head -n 15
}
skip() { printf 'SKIPPED: %s: %s\n' "$1" "$2"; }

# Everything runs in a copy, so that nothing is written beside the sources.
root=$place/root blocks=$place/blocks log=$place/log
mkdir -p "$root/out" "$blocks" "$place/bin"
cp -r "$source/scenarios" "$source/scripts" "$source/docs" "$source/README.md" "$root"
for page in CONTRIBUTING.md LICENSE; do
    [ ! -e "$source/$page" ] || cp "$source/$page" "$root"
done
ln -s "$source/include" "$root/include"
ln -s "$program" "$place/bin/glint"
PATH=$place/bin:$PATH
cd "$root" || exit 1
mapfile -t pages < <(find README.md docs -name '*.md' | sort)

# ------------------------------------------------------------------ the blocks

# take_blocks PAGE: every fenced block becomes a file PAGE:LINE.LANGUAGE.
take_blocks() {
    awk -v page="$1" -v folder="$blocks" '
        /^```/ && !inside {
            inside = 1
            gsub("/", "_", page)
            name = sprintf("%s/%s:%04d.%s", folder, page, NR, substr($0, 4))
            printf "" > name
            next
        }
        /^```$/ && inside { inside = 0; close(name); next }
        inside { print > name }
        END { if (inside) exit 1 }' "$1" || fail "$1" 'a fence is not closed'
}

# Commands. Those of README.md name the program where a build by hand puts it. The scripts that
# build everything are not run from within a test.
run_sh() {
    local name=$1 file=$2 line script
    while IFS= read -r line; do
        script=${line%% *}
        [ -x "$script" ] || fail "$name" "no program: $script"
    done < <(grep '^scripts/' "$file")
    sed 's#^build/release/glint#glint#; /^scripts\//d' "$file" >"$place/commands.sh"
    if ! command -v gnuplot >/dev/null && grep -q -e '--plot' "$file"; then
        skip "$name" 'no gnuplot'
        sed -i 's/ --plot [^ ]*//' "$place/commands.sh"
    fi
    bash -eu -x "$place/commands.sh" >"$log" 2>&1 || fail "$name" 'a command failed' "$log"
}

run_console() {
    local name=$1 file=$2 line
    : >"$log"
    while IFS= read -r line; do
        printf '$ %s\n' "$line" >>"$log"
        bash -o pipefail -c "$line" >>"$log" 2>&1 || fail "$name" "failed: $line"
    done < <(sed -n 's/^\$ //p' "$file")
    diff "$file" "$log" >"$place/difference" ||
        fail "$name" 'it prints something else' "$place/difference"
}

# splice FRAGMENT: the example scenario with the fragment's tables in place of its own.
splice() {
    awk 'function table(line) { gsub(/^\[+|[].].*/, "", line); return line }
        NR == FNR { if (/^\[/) replaced[table($0)] = 1; next }
        /^\[/ { keep = !(table($0) in replaced) }
        FNR == 1 { keep = 1 }
        keep' "$1" scenarios/iss-vienna.toml
    cat "$1"
}

run_toml() {
    local name=$1 file=$2 as=$root/scenarios/block.toml kind=fragment
    if grep -qE '^\[(time|geometry)\]' "$file"; then
        kind=scenario
        cp "$file" "$as"
    elif grep -qE '^\[\[component|^\[materials' "$file"; then
        cp "$file" "$as"
    else
        splice "$file" >"$as"
    fi
    glint check -q "$as" >"$log" 2>&1 || fail "$name" 'glint check' "$log"
    [ $kind = scenario ] || return
    glint run -q "$as" -o /dev/null >"$log" 2>&1 || fail "$name" 'glint run' "$log"
    grep -qE '^\[+(expect|require)' "$as" || return
    glint verify "$as" >"$log" 2>&1 || fail "$name" 'glint verify' "$log"
}

run_python() {
    local name=$1 file=$2 python modules candidate
    modules=$(sed -nE 's/^(from|import) ([a-z_.]+).*/import \2;/p' "$file" | tr '\n' ' ')
    for candidate in /usr/bin/python3 python3; do
        "$candidate" -c "$modules" 2>/dev/null && python=$candidate && break
    done
    if [ -z "${python-}" ]; then
        skip "$name" "no Python with: $modules"
    else
        "$python" "$file" >"$log" 2>&1 || fail "$name" 'the script failed' "$log"
    fi
}

run_gnuplot() {
    if ! command -v gnuplot >/dev/null; then
        skip "$1" 'no gnuplot'
    else
        gnuplot "$2" >"$log" 2>&1 || fail "$1" 'the script failed' "$log"
    fi
}

for page in "${pages[@]}"; do
    take_blocks "$page"
done
for file in "$blocks"/*; do
    name=$(basename "$file")
    checks=$((checks + 1))
    case $file in
        *.sh) run_sh "$name" "$file" ;;
        *.console) run_console "$name" "$file" ;;
        *.toml) run_toml "$name" "$file" ;;
        *.python) run_python "$name" "$file" ;;
        *.gnuplot) run_gnuplot "$name" "$file" ;;
        *.c | *.text) ;;
        *) fail "$name" 'no such fence; what is not to be run is text' ;;
    esac
done
[ $checks -ge 20 ] || fail 'blocks' "only $checks were found"

# ------------------------------------------------------- the program of api.md

checks=$((checks + 1))
"$api_program" scenarios/iss-vienna.toml time.step_s=10 >"$log" 2>"$place/err" ||
    fail 'docs/api.md' 'its program failed' "$place/err"
wanted=$(glint run -q scenarios/iss-vienna.toml --set time.step_s=10 | grep -v '^#' |
    awk -F, 'NR > 1 && $3 != "" && (best == "" || $3 < best) { best = $3; t_s = $2 }
        END { printf "brightest at t_s = %g: V = %.3f\n", t_s, best }')
[ "$(cat "$log")" = "$wanted" ] || fail 'docs/api.md' "its program does not say: $wanted" "$log"
"$api_program" absent.toml >"$log" 2>&1
[ $? = 1 ] || fail 'docs/api.md' 'an absent file gives another status' "$log"
grep -qF 'absent.toml' "$log" || fail 'docs/api.md' 'an absent file is not named' "$log"

# ----------------------------------------------------------------------- links

# The name that a heading gets: letters in lower case, blanks to '-', punctuation left out.
anchors() {
    awk '/^```/ { inside = !inside } /^#+ / && !inside' "$1" |
        sed -E 's/^#+ //; s/[^[:alnum:] _-]//g; s/ /-/g' | tr '[:upper:]' '[:lower:]'
}

check_link() { # PAGE TARGET
    local page=$1 target=${2%%#*} anchor=
    case $2 in
        *://*) return ;;
        *'#'*) anchor=${2#*#} ;;
    esac
    target=${target:+$(dirname "$page")/$target}
    target=${target:-$page}
    checks=$((checks + 1))
    if [ ! -e "$target" ]; then
        fail "$page" "the link leads nowhere: $2"
    elif [ -n "$anchor" ]; then
        anchors "$target" | grep -qxF -e "$anchor" || fail "$page" "no such heading: $2"
    fi
}

for page in "${pages[@]}"; do
    while IFS= read -r link; do
        check_link "$page" "$link"
    done < <(grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//')
done

# -------------------------------------------- every key that is known is described

book=docs/scenario.md
nobody=qqqqqqqqqqqq # near to no key, so that the message lists all

# section TITLE: the part of the book under "## TITLE".
section() {
    awk -v title="## $1" '/^## / { inside = $0 == title } inside' "$book"
}

# known_keys BASE SETTING: what the program would have known in place of the key nobody.
known_keys() {
    glint check -q "$1" --set "$2" 2>&1 |
        sed -n "s/.*unknown key '$nobody' in .*; expected one of: //p" | tr -d ','
}

# described TITLE BASE SETTING...: under the title (or among what is not built), all keys that are
# known where the settings put nobody's; and no row of its tables begins with another.
described() {
    local title=$1 base=$2 setting key all=' ' keys
    shift 2
    section "$title" >"$place/section"
    [ -n "$(section "$title")" ] || fail "$book" "there is no section: $title"
    for setting; do
        checks=$((checks + 1))
        keys=$(known_keys "$base" "$setting")
        [ -n "$keys" ] || fail "$book" "no keys are known where --set $setting puts one"
        for key in $keys; do
            grep -qF -e "\`$key\`" -e "\`\"$key\"\`" "$place/section" ||
                fail "$book" "$title: '$key' is missing"
            all+="$key "
        done
    done
    while IFS= read -r key; do
        [[ $all == *" $key "* ]] || fail "$book" "$title: '$key' is described, but not known"
    done < <(section "$title" | grep '^| `' | cut -d'|' -f2 | grep -oE '`[^`]+`' | tr -d '`')
}

# words TITLE BASE KEY...: all words that the key may have are described.
words() {
    local title=$1 base=$2 key word
    shift 2
    section "$title" >"$place/section"
    for key; do
        checks=$((checks + 1))
        local found=0
        for word in $(glint check -q "$base" --set "$key=\"$nobody\"" 2>&1 |
            sed -n "s/.*\"$nobody\"; expected one of: //p" | sed 's/ (did.*//' | tr -d ','); do
            found=1
            grep -qF -e "\"$word\"" -e "\`$word\`" "$place/section" ||
                fail "$book" "$title: the word \"$word\" of $key is missing"
        done
        [ $found = 1 ] || fail "$book" "no words are known for $key"
    done
}

iss=scenarios/iss-vienna.toml
given=$root/scenarios/given.toml
cp "$(grep -lE '^\[geometry\]' "$blocks"/docs_scenario.md:*.toml)" "$given"
q="$nobody=1"
axes='axis=[0,0,1],second_axis=[1,0,0]'

described 'Top level' "$iss" "$q" "title=\"\"
$q"
described '`[time]`' "$iss" "time.$q"
described '`[observer]`' "$iss" "observer.$q" "observer={satellite={},$q}" \
    "observer={direction={},$q}" "observer.refraction={$q}" "observer={direction={$q}}" \
    "observer={direction={frame=\"gcrs\",ra_deg=1,dec_deg=1,$q}}"
described '`[orbit]`' "$iss" "orbit.$q" "orbit={tle_lines=[\"\",\"\"],$q}" "orbit={oem=\"\",$q}" \
    "orbit={stk=\"\",$q}" "orbit={sp3=\"\",$q}" \
    "orbit={kepler={$q}}" "orbit={circular={$q}}" \
    "orbit={circular={geostationary_longitude_deg=0,$q}}"
laws=()
for law in $(glint check -q "$iss" --set "attitude={law=\"$nobody\"}" 2>&1 |
    sed -n 's/.*; expected one of: //p' | tr -d ','); do
    laws+=("attitude={law=\"$law\",$q}")
done
described '`[attitude]`' "$iss" "${laws[@]}" \
    "attitude={law=\"nadir\",offset_deg={axis=[1,0,0],angle=1,$q}}" "attitude=[{law=\"nadir\",$q}]"
described '`[satellite]`' "$iss" "satellite.$q"
described '`[corrections]`' "$iss" "corrections.$q"
described '`[output]`' "$iss" "output.$q"
described '`[geometry]`' "$given" "geometry.$q" "geometry.sweep.$q" "geometry={rotate={$q}}"
described '`[[expect]]`' "$given" "expect.0.$q"
described '`[expect_table]`' "$given" "expect_table={file=\"\",$q}"
described '`[[require]]`' "$given" "require=[{$q}]"
described '`[observed]`' "$iss" "observed.$q" "observed={columns={$q}}"
described 'Hinges' "$given" "component.0.hinge={$q}" "component.0.hinge={track=\"sun\",$q}" \
    "component.0.hinge={table=\"\",$q}"
described 'Components' "$given" "component.0.$q"
primitives=()
for kind in $(known_keys "$given" "component.0.$q"); do
    case $kind in
        name | parent | hinge) ;;
        *) primitives+=("component=[{name=\"x\",$kind=[{$q}]}]") ;;
    esac
done
for table in rotation_deg repeat; do
    primitives+=("component.0.plate.0.$table={$q}")
done
described 'Primitives' "$given" "${primitives[@]}"
described 'The model file' scenarios/models/box-wing.toml "$q"

# contains TITLE BASE SETTING...: as described, where tables list other things than keys, too.
contains() {
    local title=$1 base=$2 setting key keys
    shift 2
    section "$title" >"$place/section"
    for setting; do
        checks=$((checks + 1))
        keys=$(known_keys "$base" "$setting")
        [ -n "$keys" ] || fail "$book" "no keys are known where --set $setting puts one"
        for key in $keys; do
            grep -qE "[\` ]$key\b" "$place/section" || fail "$book" "$title: '$key' is missing"
        done
    done
}
contains '`[photometry]`' "$iss" "photometry.$q"
contains 'Materials' "$given" "materials.grey={brdf=\"sum\",$q}"
{ section 'Materials'; section 'Reflectance models'; } >"$place/models"
for brdf in $(glint brdf list | sed -n 's/^\([a-z][a-z-]*\): .*/\1/p'); do
    checks=$((checks + 1))
    keys=$(known_keys "$given" "materials.grey={brdf=\"$brdf\",$q}")
    [ -n "$keys" ] || fail "$book" "no keys are known of a material with brdf = \"$brdf\""
    for key in "$brdf" $keys; do
        grep -qF "\`$key\`" "$place/models" || fail "$book" "materials, $brdf: '$key' is missing"
    done
done
section 'Materials' | grep -qF '`weight`' || fail "$book" "Materials: 'weight' is missing"
for table in 'ra_deg=0' 'latitude_deg=0'; do
    contains 'Directions' "$iss" "attitude={law=\"sun-pointing\",$axes,second_to={$table,$q}}"
done

words '`[attitude]`' "$iss" attitude.law
words '`[satellite]`' "$iss" satellite.self_shadows
words '`[photometry]`' "$iss" photometry.system photometry.solar_disc
words '`[output]`' "$iss" output.rows output.shares
words '`[observed]`' "$iss" observed.format observed.magnitude
words '`[geometry]`' "$given" geometry.sweep.plane
words 'Primitives' "$given" component.0.plate.0.mirror

printf '%d checks, %d failed\n' "$checks" "$failures"
[ "$failures" = 0 ]
