# Low-frequency error of a picture by frame, dB against white noise.
set xrange [0:*]
# At least so far, farther where curves go there.
set yrange [*<-21:6<*]
set xtics autofreq
set ytics 3
set xlabel 'frame' textcolor rgb '#141414'
