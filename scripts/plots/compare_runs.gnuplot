# Runs that the inspector compared. Before this stands
#   runs: their names, apart by spaces; trace_NAME.csv has the columns that AnnealTrace::csv() names
set format x "%.1e"
set xtics rotate by -30
set xlabel "proposals"
set logscale y
file(i) = "trace_".word(runs, i).".csv"
style(i) = (i - 1) % 7 + 1

set output "energy.svg"
set title "Energy during the runs"
set ylabel "energy"
plot for [i=1:words(runs)] file(i) using 1:4 every ::2 with lines ls style(i) title word(runs, i), \
  for [i=1:words(runs)] file(i) using 1:($6>0?$6:1/0) every ::2 with lines ls style(i) dt 2 notitle

set output "temperature.svg"
set title "Temperature during the runs"
set ylabel "temperature"
plot for [i=1:words(runs)] file(i) using 1:($3>0?$3:1/0) every ::1 with lines ls style(i) title word(runs, i)

set output "acceptance.svg"
set title "Accepted share of all proposals"
set ylabel "accepted share"
plot for [i=1:words(runs)] file(i) using 1:($7>0?$7:1/0) every ::2 with lines ls style(i) title word(runs, i)
