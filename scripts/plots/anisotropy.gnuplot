# Anisotropy of the annuli in decibels, by frequency.
set xrange [0:0.7072]
set yrange [-15:15]
set xtics 0.1
set ytics 5
set xlabel 'frequency, cycles/pixel' textcolor rgb '#141414'
