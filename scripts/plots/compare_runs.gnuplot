# Runs that the inspector compared. Before this stands
#   runs: their names, apart by spaces; trace_NAME.csv has the columns that AnnealTrace::csv() names
file(i) = "trace_".word(runs, i).".csv"
style(i) = (i - 1) % 7 + 1
set xlabel "proposals, 10^9"
set xrange [0:*] noextend
set yrange [*:*] noextend
set logscale y

# What is 0 in every run (a constant picture's energy, greedy's temperature) has no place on a logarithmic axis.
array largest[7]
least_energy = 0
do for [column=3:7] {
  largest[column] = 0
  do for [i=1:words(runs)] {
    undefine STATS_*
    stats file(i) skip 2 using column nooutput
    if (!exists("STATS_max")) { continue }
    if (STATS_max > largest[column]) { largest[column] = STATS_max }
    if ((column == 4 || column == 6) && STATS_min > 0 && (least_energy == 0 || STATS_min < least_energy)) {
      least_energy = STATS_min
    }
  }
}

# From the second point on: the first is the start.
if (largest[4] > 0) {
set output "energy.svg"
set title "Energy during the runs (dashed: proven optimum)"
set ylabel "energy"
set yrange [least_energy/1.1:*] noextend
plot for [i=1:words(runs)] file(i) skip 2 using ($1/1e9):4 with lines ls style(i) title word(runs, i), \
  for [i=1:words(runs)] file(i) skip 2 using ($1/1e9):($6 > 0 ? $6 : NaN) with lines ls style(i) dt 2 notitle
set yrange [*:*] noextend
}
if (largest[3] > 0) {
set output "temperature.svg"
set title "Temperature during the runs"
set ylabel "temperature, levels"
plot for [i=1:words(runs)] file(i) skip 2 using ($1/1e9):($3 > 0 ? $3 : NaN) with lines ls style(i) title word(runs, i)
}
if (largest[7] > 0) {
set output "acceptance.svg"
set title "Accepted share of all proposals"
set ylabel "accepted share"
plot for [i=1:words(runs)] file(i) skip 2 using ($1/1e9):($7 > 0 ? $7 : NaN) with lines ls style(i) title word(runs, i)
}
