# The look of figures that stand as files: SVG of 760 x 480 pixels; hues that colour-blind eyes tell apart, and a sign
# of its own for each. Drawn twice, for light and for dark pages: `gnuplot figures.gp`, `gnuplot -e dark=1 figures.gp`.
if (!exists("dark")) { dark = 0 }
# The file of a figure.
figure(name) = name.(dark ? "-dark" : "").".svg"
ink = dark ? "#c9ced6" : "#24292f"
paper = dark ? "#16181c" : "#ffffff"
faint = dark ? "#33383f" : "#d8d8d8"
untried = dark ? "#2a2e34" : "#e4e4e4"
set datafile separator ","
set encoding utf8
set terminal svg size 760,480 dynamic enhanced font "sans-serif,13" background paper
# One colour and one sign a schedule, whichever others are shown; the colours of bn/palette.h, and lighter ones for dark pages.
hues = dark ? "#56b4e9 #f0803c #2fbf93 #d994bb #e6b800 #a6d8f5 #9aa1ab" \
            : "#0072b2 #d55e00 #009e73 #cc79a7 #e69f00 #56b4e9 #888888"
signs = "7 5 9 11 13 6 4"
do for [i=1:7] { set style line i lc rgb word(hues, i) lw 2 pt int(word(signs, i)) ps 0.6 }
# What is not measured: bounds, optima, ideals.
set style line 8 lc rgb ink lw 1.5 dt 2
all_schedules = "exponential kirkpatrick linear inverse hajek constant greedy"
place_in_list(name) = sum [i=1:words(all_schedules)] (word(all_schedules, i) eq name ? i : 0)
style_of(name) = place_in_list(name) > 0 ? place_in_list(name) : 7
set grid lt 1 lw 1 lc rgb faint
set key inside right top opaque fillcolor rgb paper textcolor rgb ink
set border 3 lc rgb ink
set tics nomirror textcolor rgb ink
set title textcolor rgb ink
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set cblabel textcolor rgb ink
# Of logarithmic axes, which need not reach from decade to decade; `set ytics auto` for others.
set ytics ()
do for [decade=-4:9] {
  set for [digit in "1 2 3 5"] ytics add (sprintf("%g", digit*10.0**decade) digit*10.0**decade)
  set for [digit in "4 6 7 8 9"] ytics add ("" digit*10.0**decade 1)
}
# Counts on an axis come in units of a thousand, a million, ...: scale is the unit, counted() the label.
exponent(most) = most >= 1000 ? 3*int(floor(log10(most)/3)) : 0
counted(what, most) = exponent(most) > 0 ? sprintf("%s, 10^{%d}", what, exponent(most)) : what
