# Share of the pixels that move so far.
set boxwidth 0.8
set offsets 0.1, 0.1, 0, 0
set autoscale xfix
set yrange [0:*]
set xtics 0,1
set format y '%.0f %%'
set xlabel 'length of the move, pixels' textcolor rgb '#141414'
