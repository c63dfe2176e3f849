# Figures of bn study anneal, from those of its CSV files that are in the current folder:
#   cd FOLDER && gnuplot .../scripts/gnuplot/anneal.gp
# Each figure is an SVG of one look: one line style a schedule, in the order of colour-blind safe hues.
set datafile separator ","
set terminal svg size 760,480 dynamic enhanced font "sans-serif,13" background "white"
set style line 1 lc rgb "#0072b2" lw 2 pt 7 ps 0.6
set style line 2 lc rgb "#d55e00" lw 2 pt 5 ps 0.6
set style line 3 lc rgb "#009e73" lw 2 pt 9 ps 0.6
set style line 4 lc rgb "#cc79a7" lw 2 pt 11 ps 0.6
set style line 5 lc rgb "#e69f00" lw 2 pt 13 ps 0.6
set style line 6 lc rgb "#56b4e9" lw 2 pt 6 ps 0.6
set style line 7 lc rgb "#000000" lw 2 pt 4 ps 0.6
set grid lc rgb "#dddddd"
set key outside right top
set border 3
set tics nomirror

there(file) = system("test -e ".file." && echo 1") eq "1"

schedules = there("medians.csv") ? system("cut -d, -f1 medians.csv | tail -n +2 | awk '!seen[$0]++'") \
  : system("ls | sed -n 's/^trace_\\(.*\\).csv/\\1/p'")
if (there("medians.csv")) {
radius = system("awk -F, 'NR==2 {print $2}' medians.csv")
# Columns of medians.csv: schedule,radius,proposals,seconds,excess_low,excess_median,excess_high
set output "error_against_time.svg"
set title "Energy above the proven optimum, radius ".radius.", median and range over seeds"
set xlabel "seconds on one core"
set ylabel "above the optimum, %"
set logscale xy
plot for [i=1:words(schedules)] sprintf("< awk -F, '$1==\"%s\" && $2==%s' medians.csv", word(schedules,i), radius) \
  using 4:6:5:7 with yerrorlines ls i title word(schedules,i)
unset logscale
}

if (there("surface.csv")) {
set output "run_energy.svg"
set title "Energy during a run"
set xlabel "proposals"
set ylabel "energy"
set logscale y
set yrange [3000:20000]
set format x "%.1e"
set xtics rotate by -30
plot for [i=1:words(schedules)] "trace_".word(schedules,i).".csv" using 1:4 every ::1 with lines ls i title word(schedules,i), \
  "trace_".word(schedules,1).".csv" using 1:6 every ::1 with lines lc rgb "#888888" dt 2 title "optimum"

set output "run_temperature.svg"
set title "Temperature during a run"
set ylabel "temperature, levels"
set autoscale y
plot for [i=1:words(schedules)] "trace_".word(schedules,i).".csv" using 1:($3>0?$3:1/0) every ::1 with lines ls i title word(schedules,i)

set output "run_acceptance.svg"
set title "Accepted share of all proposals during a run"
set ylabel "accepted share"
plot for [i=1:words(schedules)] "trace_".word(schedules,i).".csv" using 1:7 every ::2 with lines ls i title word(schedules,i)
unset logscale

# surface.csv: step,worsening_class,share on a full grid
set output "acceptance_surface.svg"
set title "Accepted share of worsening swaps, exponential, from accepting everything"
set ylabel "rise of the energy"
set cblabel "accepted share"
set ytics ("1" 0, "2" 1, "4" 2, "8" 3, "16" 4, "32" 5, "64" 6, "128" 7, "256" 8)
set logscale cb
set cbrange [1e-3:1]
set yrange [-0.5:8.5]
set key off
set palette defined (0 "#deebf7", 0.5 "#6baed6", 1 "#08306b")
plot "surface.csv" using 1:2:($3>0?$3:1/0) every ::1 with image pixels
unset logscale
set ytics auto
set key outside right top
set autoscale
set format x "%g"
set xtics norotate
}

if (there("throughput.csv")) {
# throughput.csv: engine,side,threads,temperature,proposals_per_second
set output "threads.svg"
set title "Throughput against threads, 512 x 512 at constant temperature"
set xlabel "threads"
set ylabel "proposals a second"
set format y "%.1e"
set xrange [0.5:*]
set yrange [0:*]
set xtics 1
plot for [i=1:2] sprintf("< awk -F, '$2==512 && $4==%s' throughput.csv", word("3 0.5", i)) using 3:5 \
  with linespoints ls i title "T = ".word("3 0.5", i)
}
