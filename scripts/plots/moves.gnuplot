# Share of the pixels that move so far.
set boxwidth 0.8
set xrange [-0.6:*]
set yrange [0:*]
set xtics 1
set format y '%.0f %%'
set xlabel 'length of the move, pixels' textcolor rgb '#141414'
