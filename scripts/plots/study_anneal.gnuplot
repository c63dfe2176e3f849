# Figures of bn study anneal. Before this stand
#   schedules: their names, apart by spaces
#   runs, traces, throughput: 1 where the CSV files of that part stand
# No logarithm holds the optimum itself. In percent above it:
shown(excess) = excess > 0.01 ? excess : 0.01
set ytics add ("0.01 or less" 0.01)

if (runs) {
# Columns of medians.csv: schedule,radius,proposals,seconds,excess_low,excess_median,excess_high
# The least of the radii.
stats "medians.csv" skip 1 using 2 nooutput
radius = int(STATS_min)
set output figure("error_against_time")
set title "Energy above the proven optimum, radius ".radius.": median and range over seeds"
set xlabel "time on one core, s (logarithmic)"
set ylabel "above the optimum, % (logarithmic)"
set logscale xy
stats "medians.csv" skip 1 using ($2 == radius ? shown($5) : NaN):(shown($7)) nooutput
set yrange [STATS_min_x/1.2:STATS_max_y*1.2]
plot for [i=1:words(schedules)] "medians.csv" skip 1 \
  using 4:(strcol(1) eq word(schedules, i) && $2 == radius ? shown($6) : NaN):(shown($5)):(shown($7)) \
  with yerrorlines ls style_of(word(schedules, i)) title word(schedules, i)
unset logscale
set autoscale
}

if (traces) {
# Columns of traces: proposals,seconds,temperature,energy,best,lower_bound,accepted,...; a bound of 0 is none. The
# first points are the fall from the start, which no axis shows beside the rest.
trace(i) = "trace_".word(schedules, i).".csv"
longest = 0
heated = ""  # schedules whose temperature is above 0
accepting = ""
# The largest of a column; 0 where there is none.
most_of(file, column) = sprintf("undefine STATS_*; stats '%s' skip 3 using %d nooutput; most = exists('STATS_max') ? STATS_max : 0", file, column)
do for [i=1:words(schedules)] {
  eval most_of(trace(i), 1)
  if (most > longest) { longest = most }
  eval most_of(trace(i), 3)
  if (most > 0) { heated = heated." ".word(schedules, i) }
  eval most_of(trace(i), 7)
  if (most > 0) { accepting = accepting." ".word(schedules, i) }
}
scale = 10.0**exponent(longest)
set xlabel counted("proposals", longest)
set xrange [0:*] noextend
set yrange [*:*] noextend
set logscale y

set output figure("run_energy")
set title "Energy during a run"
set ylabel "energy above the proven optimum, % (logarithmic)"
plot for [i=1:words(schedules)] trace(i) skip 3 using ($1/scale):(shown($6 > 0 ? 100.0*($4-$6)/$6 : $4)) \
  with lines ls style_of(word(schedules, i)) title word(schedules, i)

set ytics add ("0.01" 0.01)

# Room below the curves: they end at their end temperature, not at 0.
coldest = 1e300
hottest = 0
do for [name in heated] {
  stats "trace_".name.".csv" skip 3 using ($3 > 0 ? $3 : NaN) nooutput
  if (STATS_min < coldest) { coldest = STATS_min }
  if (STATS_max > hottest) { hottest = STATS_max }
}
if (words(heated) > 0) {
set output figure("run_temperature")
set yrange [0.7*coldest:1.6*hottest]
set title "Temperature during a run\n{/*0.9 not shown: greedy and the last 64th of every run, which are at 0}"
set ylabel "temperature, levels (logarithmic)"
plot for [name in heated] "trace_".name.".csv" skip 3 using ($1/scale):($3 > 0 ? $3 : NaN) \
  with lines ls style_of(name) title name
}

if (words(accepting) > 0) {
set output figure("run_acceptance")
set yrange [*:*] noextend
set title "Accepted share of all proposals during a run"
set ylabel "accepted share (logarithmic)"
plot for [name in accepting] "trace_".name.".csv" skip 3 using ($1/scale):($7 > 0 ? $7 : NaN) \
  with lines ls style_of(name) title name
}
unset logscale

# surface.csv: proposals,worsening_class,share on a full grid; NaN where fewer than eight were tried. A short run has counted
# hardly any, and a figure of it would be empty.
undefine STATS_*  # stays so where no number stands
stats "surface.csv" skip 1 using 3 nooutput
if (exists("STATS_records") && STATS_records > 0.3*(STATS_records+STATS_invalid)) {
set output figure("acceptance_surface")
set title "Accepted share of worsening swaps, exponential, from a start that accepts everything\n{/*0.9 grey: fewer than eight tried}"
set ylabel "rise of the energy, levels"
set cblabel "accepted share (faintest: none, or less than 0.001)"
set ytics ("1" 0, "2–3" 1, "4–7" 2, "8–15" 3, "16–31" 4, "32–63" 5, "64–127" 6, "128–255" 7, "256–511" 8)
set logscale cb
set cbrange [1e-3:1]
set cbtics textcolor rgb ink
set xrange [*:*] noextend
set yrange [-0.5:8.5]
set key off
unset grid
if (dark) {
  set palette defined (0 "#16181c", 0.25 "#173a5c", 0.6 "#3f8ac0", 1 "#d6ecfa")
} else {
  set palette defined (0 "#ffffff", 0.25 "#c6dbef", 0.6 "#6baed6", 1 "#08306b")
}
set object 1 rectangle from graph 0, graph 0 to graph 1, graph 1 behind fillcolor rgb untried fillstyle solid noborder
plot "surface.csv" skip 1 using ($1/scale):2:($3 > 0.001 ? $3 : $3 >= 0 ? 0.001 : NaN) with image pixels
unset object 1
unset logscale
set key on
set grid lt 1 lw 1 lc rgb faint
}
set ytics auto
set autoscale
}

if (throughput) {
# Columns of throughput.csv: engine,side,threads,temperature,proposals_per_second
set output figure("threads")
set title "Throughput against threads, 512 × 512 at constant temperature"
set xlabel "threads"
stats "throughput.csv" skip 1 using ($2 == 512 ? $5 : NaN) nooutput
scale = 10.0**exponent(STATS_max)
set ylabel counted("proposals a second", STATS_max)
set xrange [0:*]
set yrange [0:*]
set xtics 1
set key inside left top
temperatures = "3 0.5"
at(i) = word(temperatures, i)
array alone[2]
do for [i=1:2] {
  stats "throughput.csv" skip 1 using ($2 == 512 && $3 == 1 && $4 == at(i) ? $5/scale : NaN) nooutput
  alone[i] = STATS_max
}
plot for [i=1:2] "throughput.csv" skip 1 using ($2 == 512 && $4 == at(i) ? $3 : NaN):($5/scale) \
    with linespoints ls i ps 1 title "T = ".at(i), \
  for [i=1:2] alone[i]*x ls 8 lw 1 title i == 1 ? "ideal: threads × one thread" : ""
}
