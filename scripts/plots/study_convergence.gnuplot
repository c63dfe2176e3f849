# Figures of bn study convergence. Before this stands
#   sources: an array of count names, as in convergence.csv: source,integrand,frame,mean,filtered,later
set ytics auto
set logscale xy
set format y "%g"
set key inside right top noenhanced
set xtics (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024)
set xrange [1:*]
set xlabel "frames"
# The first seven as they are, then the same hues dashed.
do for [i=1:7] { set style line 20+i lc rgb word(hues, i) lw 2 dt 2 }
style(i) = i <= 7 ? i : 21 + (i - 8) % 7
shown(i, what) = strcol(1) eq sources[i] && strcol(2) eq what ? $3 : NaN

set output figure("filtered")
set title "Error of random steps after blur and exponential average"
set ylabel "root mean square"
plot for [i=1:count] "convergence.csv" skip 1 using (shown(i, "heavisides")):5 with lines ls style(i) title sources[i]

set output figure("mean")
set title "Error of random steps, plain mean of each pixel's frames"
plot for [i=1:count] "convergence.csv" skip 1 using (shown(i, "heavisides")):4 with lines ls style(i) title sources[i]

set output figure("disk")
set title "Error of a disk of two numbers, after blur and exponential average"
plot for [i=1:count] "convergence.csv" skip 1 using (shown(i, "disk")):5 with lines ls style(i) title sources[i]
