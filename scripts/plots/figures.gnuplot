# The look of figures that stand as files: SVG of 760 x 480 pixels on white, so that dark pages show them too;
# hues that colour-blind eyes tell apart, and a sign of its own for each.
set datafile separator ","
set encoding utf8
set terminal svg size 760,480 dynamic enhanced font "sans-serif,13" background "white"
set style line 1 lc rgb "#0072b2" lw 2 pt 7 ps 0.6
set style line 2 lc rgb "#d55e00" lw 2 pt 5 ps 0.6
set style line 3 lc rgb "#009e73" lw 2 pt 9 ps 0.6
set style line 4 lc rgb "#cc79a7" lw 2 pt 11 ps 0.6
set style line 5 lc rgb "#e69f00" lw 2 pt 13 ps 0.6
set style line 6 lc rgb "#56b4e9" lw 2 pt 6 ps 0.6
set style line 7 lc rgb "#000000" lw 2 pt 4 ps 0.6
set style line 8 lc rgb "#888888" lw 2 dt 2
set grid lt 1 lw 1 lc rgb "#d8d8d8"
set key outside right top
set border 3
set tics nomirror
# Of logarithmic axes, which need not reach from decade to decade; `set ytics auto` for others.
set ytics ()
do for [decade=-4:9] {
  set for [digit in "1 2 5"] ytics add (sprintf("%g", digit*10.0**decade) digit*10.0**decade)
}
