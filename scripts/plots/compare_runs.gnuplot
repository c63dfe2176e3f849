# Runs that the inspector compared. Before this stands
#   runs: their names, apart by spaces; trace_NAME.csv has the columns that AnnealTrace::csv() names
file(i) = "trace_".word(runs, i).".csv"
# A schedule's colour, as everywhere; of its runs the later ones are dashed.
schedule(i) = (name = word(runs, i), name[strstrt(name, "-")+1:*])
style(i) = style_of(schedule(i))
repeat(i) = i < 2 ? 0 : sum [j=1:i-1] (schedule(j) eq schedule(i) ? 1 : 0)
dash(i) = repeat(i) % 5 + 1
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

longest = 0
do for [i=1:words(runs)] {
  stats file(i) skip 1 using 1 nooutput
  if (STATS_max > longest) { longest = STATS_max }
}
scale = 10.0**exponent(longest)
set xlabel counted("proposals", longest)

# From the second point on: the first is the start.
if (largest[4] > 0) {
set output figure("energy")
set title "Energy during the runs"
set ylabel "energy (logarithmic)"
set yrange [least_energy/1.1:*] noextend
plot for [i=1:words(runs)] file(i) skip 2 using ($1/scale):4 with lines ls style(i) dt dash(i) title word(runs, i), \
  for [i=1:words(runs)] file(i) skip 2 using ($1/scale):($6 > 0 ? $6 : NaN) with lines ls 8 title i == 1 ? "proven optimum" : ""
set yrange [*:*] noextend
}
if (largest[3] > 0) {
set output figure("temperature")
set title "Temperature during the runs"
set ylabel "temperature, levels (logarithmic)"
plot for [i=1:words(runs)] file(i) skip 2 using ($1/scale):($3 > 0 ? $3 : NaN) with lines ls style(i) dt dash(i) title word(runs, i)
}
if (largest[7] > 0) {
set output figure("acceptance")
set title "Accepted share of all proposals"
set ylabel "accepted share (logarithmic)"
plot for [i=1:words(runs)] file(i) skip 2 using ($1/scale):($7 > 0 ? $7 : NaN) with lines ls style(i) dt dash(i) title word(runs, i)
}
