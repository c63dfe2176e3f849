# Energies of a stack's retarget tiles by the slice that they start from. Energies of one stack are alike, so the axis
# need not begin at 0.
set autoscale xfix
set offsets 0.5, 0.5, graph 0.1, graph 0.1
set xtics autofreq
set ytics autofreq
set lmargin 9
set xlabel 'slice' textcolor rgb '#141414'
