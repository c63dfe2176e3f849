# Power of the pixels' sequences against white noise, by frequency in time.
set logscale y
set xrange [0:0.5]
set yrange [1e-3:6]
set xtics 0.1
set ytics ("1" 1, "10⁻¹" 0.1, "10⁻²" 0.01, "10⁻³" 1e-3)
set xlabel 'frequency, cycles/frame' textcolor rgb '#141414'
