# Figures of bn study presets. Columns of presets.csv:
# name,slice_share,pixel_share,slice_error,average_error,pixel_error,best
set ytics auto
set key inside right top title "slice share" textcolor rgb ink
shares = "1 0.9 0.8 0.6 0.4 0.2"
of(share, i) = strcol(1) eq "" && abs(column(2) - share) < 1e-6 ? column(i) : NaN
preset(i) = strcol(1) eq "" ? NaN : column(i)

set output figure("series_against_average")
set title "One pixel's mean against the filtered average; along each line the pixel share grows from 0 to 2"
set xlabel "error of all frames at one pixel, no blur (logarithmic)"
set ylabel "error after blur and exponential average"
set logscale x
set yrange [0.0024:*]
set xtics (0.02, 0.025, 0.03, 0.04, 0.05, 0.06, 0.07)
set xrange [0.0195:0.075]
plot for [n=1:words(shares)] "presets.csv" skip 1 using (of(word(shares, n) + 0, 6)):5 with linespoints ls n title word(shares, n), \
     "presets.csv" skip 1 using (preset(6)):5 with points ls 8 pt 6 ps 1.6 title "presets", \
     "presets.csv" skip 1 using (preset(6)):5:1 with labels left offset 1,0 textcolor rgb ink notitle

set output figure("slice_against_average")
unset logscale x
set xtics auto
set xrange [*:*]
set title "One slice against the filtered average; along each line the pixel share grows from 0 to 2"
set xlabel "error of one slice after the blur"
plot for [n=1:words(shares)] "presets.csv" skip 1 using (of(word(shares, n) + 0, 4)):5 with linespoints ls n title word(shares, n), \
     "presets.csv" skip 1 using (preset(4)):5 with points ls 8 pt 6 ps 1.6 title "presets", \
     "presets.csv" skip 1 using (preset(4)):5:1 with labels left offset 1,0 textcolor rgb ink notitle
