# An elastic block of finite elements under the punch, and two errors of the half-width.
# Run in the folder of fe_block_mesh.dat, fe_block_contact.dat, fe_block_size.csv and fe_block_elements.csv.
set terminal pngcairo size 1200,480 font "sans,13" enhanced
set output "fe_block.png"
set multiplot

# Every second grid line of the right half and its mirror image, vertical displacements enlarged.
scale = 8.0
blue = "#5d7f9e"
red = "#c0392b"
stats "fe_block_contact.dat" using 1:4 name "c" nooutput
stats "fe_block_mesh.dat" using 1:2 name "m" nooutput
punch(x) = scale*(0.05*x**4 - c_max_y)
set lmargin at screen 0.02
set rmargin at screen 0.48
set tmargin at screen 0.90
set bmargin at screen 0.03
set label 1 sprintf("Elastic block under the punch, vertical displacements × %.0f", scale) at screen 0.25, 0.945 center
unset border
unset tics
unset key
set size ratio -1
set xrange [-1.03*m_max_x:1.03*m_max_x]
set yrange [1.08*m_min_y:0.45]
set style fill solid noborder
set object 1 rectangle from -m_max_x, 1.05*m_min_y to m_max_x, m_min_y fillcolor rgb "#d5d8dc" fillstyle solid noborder behind
plot sample [-c_max_x:c_max_x] "+" using 1:(punch($1)):(0.35) with filledcurves fillcolor rgb "#d5d8dc", \
     for [part=0:1] for [side=-1:1:2] "fe_block_mesh.dat" index part every :2 using (side*$1):($2 + scale*$4) \
       with lines lw 0.7 lc rgb blue, \
     [-c_max_x:c_max_x] "+" using 1:(punch($1)) with lines lw 2 lc rgb "#555555", \
     for [side=-1:1:2] "fe_block_contact.dat" using ($3 > 0 ? side*$1 : NaN):(scale*$2) with points pt 7 ps 0.6 \
       lc rgb red

unset label 1
unset object 1
set size noratio
set border 3
set logscale xy
set format "%g"
set xtics nomirror autofreq
set ytics nomirror autofreq
set mxtics 10
set grid xtics ytics lt 1 lw 0.7 lc rgb "#dddddd"
set datafile separator comma
set lmargin at screen 0.57
set rmargin at screen 0.985
set bmargin at screen 0.13
set title "Error of the half-width a"
set xlabel "W/a: size of the block,   a/h: elements in the half-width"
set ylabel "error [%]" offset 1
set xrange [2:100]
set yrange [1e-3:30]
set xtics (2, 5, 10, 20, 50, 100)
set key at graph 0.98, 0.97 top right
plot "fe_block_size.csv" using 1:(100*$2) with linespoints pt 7 ps 0.9 lw 2 lc rgb red \
       title "by the block, bottom held", \
     "" using 1:(100*$3) with linespoints pt 6 ps 0.9 lw 2 lc rgb "#b9770e" title "by the block, sides held too", \
     "fe_block_elements.csv" using 1:(100*$2) with linespoints pt 7 ps 0.9 lw 2 lc rgb "#2471a3" \
       title "by the elements", \
     "" using 1:(100*$3) with points pt 4 ps 1.6 lw 1.5 lc rgb "#1e8449" title "half-plane on the same points, hats"
unset multiplot
