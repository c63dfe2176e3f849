# Power of a picture's error by frequency, dB against white noise.
set xrange [0:0.7072]
# At least so far, farther where curves go there.
set yrange [*<-24:9<*]
set xtics 0.1
set ytics 6
set xlabel 'frequency, cycles/pixel' textcolor rgb '#141414'
