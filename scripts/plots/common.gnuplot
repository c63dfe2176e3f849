# What all plots of the report share. Colours are numbers, written as greys, that the page translates to its own
# (libbn/report/plot.cpp): 1 white noise, 2 reference, 3..8 textures, 9 other textures, 20 text and axes, 21 grid. plot_width and
# plot_height are the drawing's size on the page.
set terminal svg size plot_width,plot_height noenhanced font 'sans-serif,13'
set encoding utf8
set style line 1 linecolor rgb '#010101' linewidth 1.4 dashtype (6,5)
set style line 2 linecolor rgb '#020202' linewidth 3.2
set style line 3 linecolor rgb '#030303' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 4 linecolor rgb '#040404' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 5 linecolor rgb '#050505' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 6 linecolor rgb '#060606' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 7 linecolor rgb '#070707' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 8 linecolor rgb '#080808' linewidth 1.8 pointtype 7 pointsize 0.4
set style line 9 linecolor rgb '#090909' linewidth 0.8
set style fill solid 1 noborder
set border 3 linecolor rgb '#141414' linewidth 1
set tics nomirror out scale 0.6 textcolor rgb '#141414'
set grid xtics ytics linecolor rgb '#151515' linewidth 1 linetype 1
set lmargin 8
set rmargin 2
set tmargin 1
set bmargin 3.6
