# Bild 7 and 8: pressure at 30 kN/mm, and half contact length over the load.
# Run in the folder of punch_pressure.dat, punch_halfwidth.dat and punch_edge.dat.
set terminal pngcairo size 1200,480 font "sans,13" enhanced
set output "punch.png"
set multiplot layout 1,2
set border 3
set tics nomirror
set grid lc rgb "#dddddd"
a = 0.699001
E = 1e6/(1 - 0.25**2)
p(x) = abs(x) < a ? E*0.05*(2*x**2 + a**2)*sqrt(a**2 - x**2)/1e3 : 0
b(F) = (F*1e3/(0.75*pi*E*0.05))**0.25

set title "Punch y = 0.05 x^4 mm on a half-plane, F = 30 kN/mm"
set xlabel "x [mm]"
set ylabel "pressure [kN/mm^2]"
set xrange [-0.85:0.85]
set yrange [0:30]
set samples 2001
set key bottom center
plot p(x) with lines lw 2 lc rgb "#999999" title "exact", \
     "punch_pressure.dat" using 1:($2/1e3) with points pt 7 ps 0.8 lc rgb "#c0392b" title "fuge, 33 cells", \
     "" using (-$1):($2/1e3) with points pt 7 ps 0.8 lc rgb "#c0392b" notitle

set title "Half contact length"
set xlabel "F [kN/mm]"
set ylabel "a [mm]"
set xrange [0:55]
set yrange [0:0.9]
set key bottom right
plot [F=0.001:55] b(F) with lines lw 2 lc rgb "#999999" title "exact", \
     "punch_halfwidth.dat" using 1:2 with steps lw 1.5 lc rgb "#c0392b" title "last cell in contact, 0.025 mm wide", \
     "punch_edge.dat" using 1:2 with points pt 7 ps 0.9 lc rgb "#2471a3" title "edge from the pressure"
unset multiplot
