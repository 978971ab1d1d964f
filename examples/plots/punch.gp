# Bild 7 and 8: pressure at 30 kN/mm, and half contact length over the load.
# Run in the folder of punch_pressure.dat, punch_halfwidth.dat and punch_edge.dat.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("punch", 800, 350)
set multiplot
a = 0.699001
E = 1e6/(1 - 0.25**2)
p(x) = abs(x) < a ? E*0.05*(2*x**2 + a**2)*sqrt(a**2 - x**2)/1e3 : 0
b(F) = (F*1e3/(0.75*pi*E*0.05))**0.25
stats "punch_pressure.dat" using 1:2 name "c" nooutput
spacing = (c_max_x - c_min_x)/(c_records - 1)
stats "punch_halfwidth.dat" using 1:2 name "h" nooutput
last = h_max_y

eval panel(0.075, 0.485, 0.16, 0.90)
set title "The paper's punch y = 0.05 x^4 mm, 30 kN/mm" offset 0, -0.3
set xlabel "x [mm]" offset 0, 0.3
set ylabel "pressure [kN/mm^2]" offset 0.7
set xrange [-0.88:0.88]
set yrange [0:31]
set samples 2001
eval gridlines
set label 1 \
  sprintf("E = 10^6 N/mm^2 as in the paper,\nfive times that of steel;\n" \
  ."%d cells of %.0f µm from x = 0,\nlight: mirrored", \
  c_records, 1e3*spacing) at 0, 14.5 center
set key at graph 0.5, 0.13 center center maxrows 1 width -1
plot p(x) with lines ls KNOWN title "exact", \
     "punch_pressure.dat" using (-$1):($2/1e3) with points ls FUGE ps 0.6 lc rgb sky notitle, \
     "" using 1:($2/1e3) with points ls FUGE ps 0.6 title "fuge"
unset label 1

eval panel(0.575, 0.985, 0.16, 0.90)
set title "Half contact length: steps, refined edges"
set xlabel "load F [kN/mm]"
set ylabel "a [mm]"
set xrange [0:53]
set yrange [0:0.9]
set key at graph 0.99, 0.04 right bottom maxrows 3 noreverse Right
eval gridlines
plot [F=0.001:53] b(F) with lines ls KNOWN title "exact", \
     "punch_halfwidth.dat" using 1:2 with steps lw 1.5 lc rgb vermilion title "outer end of the last cell in contact", \
     "+" using (h_max_x + $0*(50 - h_max_x)):(last) every ::0::1 with lines lw 1.5 lc rgb vermilion notitle, \
     "punch_edge.dat" using 1:2 with points ls FUGE title "edge refined from the pressure"
unset multiplot
