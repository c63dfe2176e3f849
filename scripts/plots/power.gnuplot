# Radial power against white noise, by frequency.
set logscale y
set xrange [0:0.7072]
set yrange [1e-8:6]
set xtics 0.1
set ytics ("1" 1, "10⁻¹" 0.1, "10⁻²" 0.01, "10⁻³" 1e-3, "10⁻⁴" 1e-4, "10⁻⁵" 1e-5, "10⁻⁶" 1e-6, "10⁻⁷" 1e-7, "10⁻⁸" 1e-8)
set xlabel 'frequency, cycles/pixel' textcolor rgb '#141414'
