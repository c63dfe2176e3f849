# Power of each slice in the lower bands, against white noise.
set logscale y
set autoscale xfix
set offsets 0.5, 0.5, 0, 0
set yrange [1e-6:2]
set xtics autofreq
set ytics ("1" 1, "10⁻¹" 0.1, "10⁻²" 0.01, "10⁻³" 1e-3, "10⁻⁴" 1e-4, "10⁻⁵" 1e-5, "10⁻⁶" 1e-6)
set xlabel 'slice' textcolor rgb '#141414'
