# Plots the magnitude of a light curve, brighter upwards.
# usage: gnuplot -c plot-magnitude.gp TABLE PICTURE.png [BAND]
table = ARG1
band = ARGC > 2 ? ARG3 : "V"
set terminal pngcairo size 1200,700 font ",12"
set output ARG2
set datafile separator comma
set datafile commentschars "#"
set key off
set grid
set xlabel "time since the start / s"
set ylabel sprintf("magnitude in %s", band)
set yrange [*:*] reverse
plot table using (column("t_s")):(column("mag_" . band)) with points pointtype 7 pointsize 0.5
