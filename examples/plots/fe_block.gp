# An elastic block of finite elements under the punch, and two errors of the half-width: by the size of the block, and
# by the width of the elements.
# Run in the folder of fe_block_mesh.dat, fe_block_contact.dat, fe_block_size.csv and fe_block_elements.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("fe_block", 800, 330)
set multiplot

# Every second grid line of the right half and its mirror image, vertical displacements enlarged.
scale = 8.0
stats "fe_block_contact.dat" using 1:4 name "c" nooutput
stats "fe_block_mesh.dat" using 1:2 name "m" nooutput
punch(x) = scale*(0.05*x**4 - c_max_y)
eval panel(0.01, 0.43, 0.02, 0.86)
set label 1 sprintf("Elastic block under the punch,\nvertical displacements × %.0f", scale) at screen 0.22, 0.90 center
unset border
unset tics
unset key
set size ratio -1
set xrange [-1.03*m_max_x:1.03*m_max_x]
set yrange [1.06*m_min_y:0.3]
set style fill solid noborder
set object 1 rectangle from -m_max_x, 1.05*m_min_y to m_max_x, m_min_y \
  fillcolor rgb solid fillstyle solid noborder behind
set label 2 "rigid punch" at 0, 0.13 center front
set label 3 "nodes in contact" at 0, -0.75 center front textcolor rgb vermilion boxed
set style textbox opaque noborder fillcolor rgb "#ffffff" margins 0.5, 0.3
set arrow 3 from 0.25, -0.62 to 0.25, scale*(-c_max_y) - 0.03 front lw 1 lc rgb vermilion size 0.06, 20 filled
plot sample [-c_max_x:c_max_x] "+" using 1:(punch($1)):(0.3) with filledcurves fillcolor rgb solid, \
     for [part=0:1] for [side=-1:1:2] "fe_block_mesh.dat" index part every :2 using (side*$1):($2 + scale*$4) \
       with lines lw 0.6 lc rgb mesh, \
     [-c_max_x:c_max_x] "+" using 1:(punch($1)) with lines lw 1.5 lc rgb "#555555", \
     for [side=-1:1:2] "fe_block_contact.dat" using ($3 > 0 ? side*$1 : NaN):(scale*$2) with points pt 7 ps 0.45 \
       lc rgb vermilion

unset label
unset arrow 3
unset object 1
set size noratio
set border 3
set logscale xy
set format "%g"
set xtics nomirror autofreq scale 0.6
set ytics nomirror autofreq scale 0.6
set mxtics 10
set mytics 10
set datafile separator comma
set yrange [1e-3:10]
set key top right noreverse Right

eval panel(0.525, 0.745, 0.155, 0.87)
set title "Error by the size of the\nblock, 2W wide, W deep" offset 0, -0.3
set xlabel "W / a" offset 0, 0.3
set ylabel "error of the half-width a [%]" offset 1
set xrange [2:110]
set xtics (2, 5, 10, 20, 50, 100)
eval gridlines
plot "fe_block_size.csv" using 1:(100*$2) with linespoints ls FUGE title "bottom held", \
     "" using 1:(100*$3) with linespoints ls FUGE_TOO title "sides too"

eval panel(0.77, 0.99, 0.155, 0.87)
set title "Error by the elements,\nh wide" offset 0, -0.3
set xlabel "a / h"
unset ylabel
set format y ""
set xrange [4:70]
set xtics (5, 10, 20, 50)
eval gridlines
plot "fe_block_elements.csv" using 1:(100*$2) with linespoints ls FUGE title "elements", \
     "" using 1:(100*$3) with points ls OTHER_TOO ps 1.1 title "half-plane, hats"
unset multiplot
