# Radial power against white noise, by frequency.
set logscale y
set xrange [0:0.7072]
set yrange [1e-6:6]
set xtics 0.1
set ytics ("1" 1, "0.1" 0.1, "0.01" 0.01, "0.001" 1e-3, "1e-4" 1e-4, "1e-5" 1e-5, "1e-6" 1e-6)
set xlabel 'frequency, cycles/pixel' textcolor rgb '#141414'
