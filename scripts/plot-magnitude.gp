# Plots a light curve: the magnitude, brighter upwards, and below it the share of each material or
# component.
# usage: gnuplot -c plot-magnitude.gp TABLE PICTURE.png|PICTURE.svg [BAND]
table = ARG1
band = ARGC > 2 ? ARG3 : "V"
if (ARG2[strlen(ARG2) - 2:] eq "svg") {
    set terminal svg size 900,560 font "sans,13" background "white"
} else {
    set terminal pngcairo size 1200,750 font "sans,13"
}
set output ARG2
set datafile separator comma
set datafile commentschars "#"
set datafile columnheaders

# The columns, by their names in the first line that is no comment.
names = system("sed -n '/^#/!{p;q}' '" . table . "' | tr ',' ' '")
share_names = ""
do for [name in names] {
    if (name[1:6] eq "share_") { share_names = share_names . name . " " }
}
number_of(wanted) = sum [i = 1:words(names)] (word(names, i) eq wanted ? i : 0)
label_of(name) = name[1:15] eq "share_material_" ? name[16:] : name[17:]

set xdata time
set timefmt "%Y-%m-%dT%H:%M:%S"
set format x "%H:%M"
set grid lc rgb "#dddddd" lw 1
set border lc rgb "#444444"
set lmargin 9
set rmargin 22
set key outside right top Left reverse samplen 2
panels = words(share_names) > 0 ? 2 : 1
set multiplot layout panels, 1
set ylabel sprintf("magnitude (%s)", band)
set yrange [*:*] reverse
unset key
plot table using 1:(column(number_of("mag_" . band))) with lines lw 2.5 lc rgb "#1f4e79"
if (panels == 2) {
    set key
    set ylabel "share of the light"
    set yrange [0:1] noreverse
    set xlabel "UTC"
    set style fill solid 0.75 noborder
    colours = "#c58b1b #7a8ca3 #6aa84f #a64d79 #3d85c6 #999999 #e06666 #45818e"
    # Stacked: each band reaches from the sum of those before it to its own.
    from(k) = sum [i = 1:k - 1] column(number_of(word(share_names, i)))
    plot for [k = 1:words(share_names)] table \
        using 1:(from(k)):(from(k + 1)) with filledcurves lc rgb word(colours, (k - 1) % 8 + 1) \
        title label_of(word(share_names, k)) noenhanced
}
unset multiplot
