# Hertz's line contact by two meshes that do not match: meshes, nodal pressures, errors.
# Run in the folder of cylinder_block_mesh.dat, cylinder_block_pressure.csv and cylinder_block_errors.csv.
set terminal pngcairo size 1500,500 font "sans,13" enhanced
set output "cylinder_block.png"
set multiplot
blue = "#1f4e79"
red = "#c0392b"
green = "#1e8449"
brown = "#b9770e"
set datafile separator comma
stats "cylinder_block_pressure.csv" index 5 using 3:4 name "h" nooutput
a = h_mean_x
p0 = h_mean_y
set datafile separator whitespace

set lmargin at screen 0.01
set rmargin at screen 0.30
set tmargin at screen 0.90
set bmargin at screen 0.02
set label 1 "Cylinder on a block, linear elements" at screen 0.155, 0.945 center
unset border
unset tics
unset key
set size ratio -1
set xrange [0:16]
set yrange [-8:12]
plot "cylinder_block_mesh.dat" index 0 using 1:2 with lines lw 0.8 lc rgb blue, \
     "" index 1 using 1:2 with lines lw 0.8 lc rgb brown
unset label 1

set size noratio
set border 3
set xtics nomirror autofreq
set ytics nomirror autofreq
set grid xtics ytics lt 1 lc rgb "#dddddd"
set datafile separator comma
set lmargin at screen 0.36
set rmargin at screen 0.66
set bmargin at screen 0.13
p(x) = x < a ? p0*sqrt(1 - x**2/a**2) : 0
set samples 2001
set title "Pressures at the nodes, a/h = 7"
set xlabel "x [mm]"
set ylabel "N/mm^2" offset 1.5
set xrange [0:1.2]
set yrange [0:900]
set key inside bottom left Left reverse samplen 1.5
plot p(x) with lines lw 2 lc rgb "#999999" title "Hertz", \
     "cylinder_block_pressure.csv" index 4 using 1:2 with points pt 2 ps 1.1 lw 1.5 lc rgb brown \
       title "linear, nodes to faces", \
     "" index 1 using 1:2 with points pt 6 ps 1.1 lw 1.5 lc rgb blue title "linear, on the finer surface", \
     "" index 0 using 1:2 with points pt 7 ps 1.1 lc rgb blue title "linear, on the coarser one", \
     "" index 5 using 1:2 with points pt 7 ps 0.35 lc rgb "black" title "the same, finest mesh", \
     "" index 3 using 1:2 with points pt 7 ps 0.8 lc rgb red title "quadratic"

set lmargin at screen 0.73
set rmargin at screen 0.99
set title "Relative errors, root mean squares"
set xlabel "h/a of the cylinder"
set ylabel "relative error" offset 1
set logscale xy
set format "%g"
set format y "10^{%T}"
set xrange [0.03:0.33]
set xtics (0.05, 0.1, 0.2, 0.3)
set yrange [1e-7:0.5]
set mytics 10
set key inside bottom right Left reverse samplen 2
E = "cylinder_block_errors.csv"
of(v, c) = column(1) == v ? column(c) : NaN
plot E using (1/$2):(of(5, 5)) with linespoints pt 2 lw 1.5 lc rgb brown title "peak, nodes to faces", \
     E using (1/$2):(of(2, 5)) with linespoints pt 6 lw 1.5 lc rgb blue title "peak, linear, finer", \
     E using (1/$2):(of(1, 5)) with linespoints pt 7 lw 1.5 lc rgb blue title "peak, linear, coarser", \
     E using (1/$2):(of(4, 5)) with linespoints pt 7 lw 1.5 lc rgb red title "peak, quadratic", \
     E using (1/$2):(of(1, 4)) with linespoints pt 4 lw 1.5 lc rgb green title "half-width, linear, coarser", \
     E using (1/$2):(of(1, 3)) with linespoints pt 8 lw 1.5 lc rgb "#777777" title "force, linear, coarser"
unset multiplot
