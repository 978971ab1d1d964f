# Bild 5 and 6: the lifted section of the disc. Run in the folder of disc_1.dat and disc_2.dat.
set terminal pngcairo size 1200,720 font "sans,13" enhanced
set output "disc.png"
set multiplot layout 2,1 title "Rubber disc on a rigid plane: bending enlarged, rings in contact in red" font "sans,15"
set xlabel "radius [mm]"
set ylabel "gap [mm]"
set xrange [-125:125]
set grid ytics lc rgb "#dddddd"
set border 3
set lmargin 11
set tics nomirror
set key off
set style fill solid 0.25 noborder
set arrow 1 from -50, graph 0.86 to -50, graph 0.98 lw 2 lc rgb "#1f4e79"
set arrow 2 from 50, graph 0.86 to 50, graph 0.98 lw 2 lc rgb "#1f4e79"
set label 1 "q" at 53, graph 0.93 textcolor rgb "#1f4e79"
set label 2 "q" at -58, graph 0.93 textcolor rgb "#1f4e79"

set title "Load case 1: q = 0.36 N/mm"
set yrange [-0.001:0.018]
plot "disc_1.dat" using 1:2 with lines lw 3 lc rgb "#1f4e79", \
     "" using (-$1):2 with lines lw 3 lc rgb "#1f4e79", \
     "" using 1:($2 > 0 ? $2 : 1/0) with points pt 7 ps 1.1 lc rgb "#1f4e79", \
     "" using (-$1):($2 > 0 ? $2 : 1/0) with points pt 7 ps 1.1 lc rgb "#1f4e79", \
     "" using 1:($2 > 0 ? 1/0 : $2) with points pt 7 ps 1.5 lc rgb "#c0392b", \
     "" using (-$1):($2 > 0 ? 1/0 : $2) with points pt 7 ps 1.5 lc rgb "#c0392b"

set title "Load case 2: q = 0.72 N/mm"
set yrange [-0.06:1.3]
plot "disc_2.dat" using 1:2 with lines lw 3 lc rgb "#1f4e79", \
     "" using (-$1):2 with lines lw 3 lc rgb "#1f4e79", \
     "" using 1:($2 > 0 ? $2 : 1/0) with points pt 7 ps 1.1 lc rgb "#1f4e79", \
     "" using (-$1):($2 > 0 ? $2 : 1/0) with points pt 7 ps 1.1 lc rgb "#1f4e79", \
     "" using 1:($2 > 0 ? 1/0 : $2) with points pt 7 ps 1.5 lc rgb "#c0392b", \
     "" using (-$1):($2 > 0 ? 1/0 : $2) with points pt 7 ps 1.5 lc rgb "#c0392b"
unset multiplot
