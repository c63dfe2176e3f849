# Counts of values against an even spread.
set xrange [0:1]
set yrange [0:2]
set xtics 0.25
set ytics 0.5
set xlabel 'value' textcolor rgb '#141414'
