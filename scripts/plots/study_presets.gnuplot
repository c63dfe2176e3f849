# Figures of bn study presets. Columns of presets.csv:
# name,slice_share,pixel_share,slice_error,average_error,pixel_error,best
set datafile separator comma
set key top right
named(i) = strcol(1) eq "" ? NaN : column(i)
others(i) = strcol(1) eq "" && column(7) == 0 ? column(i) : NaN
front(i) = column(7) == 1 ? column(i) : NaN

set output figure("series_against_average")
set title "Error of one pixel's mean against that of the filtered average"
set xlabel "all frames at one pixel, no blur"
set ylabel "blur and exponential average, last frames"
plot "presets.csv" skip 1 using (others(6)):5 with points pt 7 ps 0.4 ls 7 title "kernels", \
     "presets.csv" skip 1 using (front(6)):5 with points pt 7 ps 0.8 ls 1 title "none is better in all three", \
     "presets.csv" skip 1 using (named(6)):5:1 with labels offset 0,0.8 notitle, \
     "presets.csv" skip 1 using (named(6)):5 with points pt 6 ps 1.4 ls 2 title "presets"

set output figure("slice_against_average")
set title "Error of one slice against that of the filtered average"
set xlabel "one slice after the blur"
plot "presets.csv" skip 1 using (others(4)):5 with points pt 7 ps 0.4 ls 7 title "kernels", \
     "presets.csv" skip 1 using (front(4)):5 with points pt 7 ps 0.8 ls 1 title "none is better in all three", \
     "presets.csv" skip 1 using (named(4)):5:1 with labels offset 0,0.8 notitle, \
     "presets.csv" skip 1 using (named(4)):5 with points pt 6 ps 1.4 ls 2 title "presets"
