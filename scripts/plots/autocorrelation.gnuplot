# Autocorrelation along an axis, by distance.
set xrange [1:16]
set xtics 1,3
set autoscale y
set format y '%.2f'
set xlabel 'distance, pixels' textcolor rgb '#141414'
