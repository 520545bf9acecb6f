#!/bin/bash
# The pictures of `scripts/figures`, and those of `glint run` and `glint brdf show` of every kind.
# usage: test_figures.sh PROGRAM SOURCE_DIR     exit status 77: there is no gnuplot
set -u
glint=$(readlink -f "$1") source=$(readlink -f "$2")
export LC_ALL=C.UTF-8
if ! command -v gnuplot >/dev/null; then
    echo "SKIPPED: figures: no gnuplot"
    exit 77
fi
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
failures=0
materials=$source/scenarios/materials/huang2013.toml

fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s\n' "$1"
}

# is_png FILE WIDTH HEIGHT: the signature, and the size in the first chunk.
is_png() {
    [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || return 1
    [ "$(od -An -j16 -N8 -tx1 "$1" | tr -d ' \n')" = "$(printf '%08x%08x' "$2" "$3")" ]
}

# big FILE N: a picture with curves or surfaces has more than a frame and letters.
big() { [ "$(wc -c <"$1")" -gt "$2" ] || fail "$1 has only $(wc -c <"$1") bytes"; }

# ------------------------------------------------------------ the paper's figures

said=$(GLINT=$glint "$source/scripts/figures" new/folder 2>&1) || fail "scripts/figures: $said"
for n in 2 3 4 5; do
    is_png "new/folder/fig$n.png" 1200 800 || fail "fig$n.png is no picture of 1200 x 800"
    big "new/folder/fig$n.png" 20000
    [ -s "new/folder/fig$n.csv" ] || fail "fig$n.csv is not there"
done
[ "$(find new -type f | wc -l)" = 8 ] || fail "other files than figures and tables: $(find new)"
grep -qF '4.2624 times' <<<"$said" || fail "the ratio of the peaks is not 4.2624: $said"
# The tables' own peaks at normal incidence: 8.5732 and 36.542 per sr.
highest() { grep "^$2,0,0," "$1" | cut -d, -f7 | sort -g | tail -n 1; }
ratio=$(echo "$(highest new/folder/fig2.csv solar-panel) $(highest new/folder/fig4.csv mli)" |
    awk '{ printf "%.4f", $2 / $1 }')
[ "$ratio" = 4.2624 ] || fail "the ratio of the peaks in the tables is $ratio"
GLINT=$glint "$source/scripts/figures" >/dev/null 2>&1 && fail 'scripts/figures without a folder'

# ----------------------------------------------------------------- every kind

cat >angles.csv <<'END'
theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg
30,0,30,180
30,0,40,170
END
cat >edge.toml <<'END'
[materials.black]
brdf = "lambert"
rho = 0
[materials.needle]
brdf = "ward-gmd"
rho_d = 0
rho_s = 0.5
alpha_x = 1e-4
alpha_y = 1e-4
[materials.two_words]
brdf = "lambert"
rho = 0.3
END
# show WANTED WORD...: draws an SVG that must hold the wanted text.
show() {
    local wanted=$1
    shift
    rm -f a.svg
    "$glint" brdf show -q "$@" -o a.csv --plot a.svg 2>err || fail "brdf show $*: $(cat err)"
    [ ! -s err ] || fail "brdf show $* says: $(cat err)"
    grep -qF '<svg' a.svg || fail "brdf show $*: no SVG"
    grep -qF -e "$wanted" a.svg || fail "brdf show $*: '$wanted' is not in the picture"
    ! grep -qi 'nan\b' a.svg || fail "brdf show $*: a NaN is in the picture"
}
show 'BRDF in the plane of incidence' "$materials"
show 'BRDF of mli in the plane of incidence' "$materials:mli" --log --incidence 0,89.9
show 'BRDF of mli in band V in the plane of incidence' "$materials:mli" --band V
show 'incidence 30' "$materials" --hemisphere 30
show 'BRDF of mli over the hemisphere' "$materials:mli" --hemisphere 0,89 --log --azimuth 200
show 'row of the table of angles' "$materials" --geometry angles.csv
show 'solar-panel' "$materials" --geometry angles.csv --log
show 'angle of incidence (deg)' "$materials" --dhr --incidence 0,45
show 'two_words' edge.toml
show 'black' edge.toml --log
show 'needle' edge.toml --hemisphere 45 --log
show 'needle' edge.toml --hemisphere 0,45
# What is written around a map stands at its edge: low where all is black, below the heading where all is bright.
label_y() { grep -B1 '>90°<' a.svg | sed -n 's/.*translate([^,]*,\([0-9]*\).*/\1/p'; }
show '90°' edge.toml:black --hemisphere 45
[ "$(label_y)" -gt 450 ] || fail "the edge of a black map is at $(label_y) px of 800"
show '90°' edge.toml:two_words --hemisphere 45
[ "$(label_y)" -gt 170 ] || fail "the edge of a bright map is at $(label_y) px of 800"
show 'black' edge.toml --geometry angles.csv
show 'black' edge.toml --dhr --incidence 10
cp "$materials" copy.toml
show 'copy.toml:mli' copy.toml:mli "$materials:mli"

# A lobe of a hundredth of a degree reaches its peak in the picture, whatever the steps of the table.
"$glint" brdf show edge.toml:needle --hemisphere 45 -o a.csv --plot a.png || fail 'a needle'
is_png a.png 1200 800 || fail 'a needle: no picture'

scenario=$source/scenarios/iss-vienna.toml
"$glint" run -q "$scenario" -o a.csv --plot a.svg || fail 'run --plot a.svg'
"$glint" run -q "$scenario" -o b.csv --plot a.pdf || fail 'run --plot a.pdf'
"$glint" run -q "$scenario" --plot a.png >c.csv || fail 'run --plot a.png'
"$glint" run -q "$scenario" -o d.csv || fail 'run'
for table in a b c; do
    cmp -s $table.csv d.csv || fail "the table is another with a picture: $table"
done
for word in 'magnitude V' solar-panel 'material share' '24 Jul 2025' 'over Vienna'; do
    grep -qF "$word" a.svg || fail "'$word' is not in the picture of the run"
done
[ "$(head -c 5 a.pdf)" = %PDF- ] || fail 'a.pdf is no PDF'
is_png a.png 1200 800 || fail 'a.png of a run is no picture of 1200 x 800'

[ "$failures" = 0 ] && echo 'all pictures are drawn'
[ "$failures" = 0 ]
