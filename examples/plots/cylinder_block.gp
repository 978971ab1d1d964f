# Hertz's line contact by two meshes that do not match: meshes, nodal pressures, errors.
# Run in the folder of cylinder_block_mesh.dat, cylinder_block_pressure.csv and cylinder_block_errors.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("cylinder_block", 800, 640)
set multiplot
set datafile separator comma
stats "cylinder_block_pressure.csv" index 5 using 3:4 name "h" nooutput
a = h_mean_x
p0 = h_mean_y
set datafile separator whitespace

eval panel(0.07, 0.37, 0.565, 0.94)
set title "Cylinder on a block, right half" offset 0, -0.3
set xlabel "x [mm]" offset 0, 0.3
set ylabel "y [mm]" offset 0.5
set xtics 5
set ytics 5
unset key
set size ratio -1
set xrange [0:14]
set yrange [-6:8]
plot "cylinder_block_mesh.dat" index 0 using 1:2 with lines lw 0.6 lc rgb "#333333", \
     "" index 1 using 1:2 with lines lw 0.6 lc rgb brown

set size noratio
set xtics autofreq
set ytics autofreq
set key on
set datafile separator comma
eval panel(0.46, 0.985, 0.565, 0.94)
p(x) = x < a ? p0*sqrt(1 - x**2/a**2) : 0
set samples 2001
set title "Nodal pressures, a/h = 7: on the coarser surface as Hertz" offset 0, -0.3
set xlabel "x [mm]" offset 0, 0.3
set ylabel "pressure [N/mm^2]" offset 0.5
set xrange [0:1.2]
set yrange [0:950]
set ytics 200
set key bottom left
eval gridlines
plot p(x) with lines ls KNOWN title "Hertz", \
     "cylinder_block_pressure.csv" index 4 using 1:2 with points lc rgb vermilion pt 2 ps 0.8 lw 1.2 \
       title "linear, nodes against faces", \
     "" index 1 using 1:2 with points ls OTHER_TOO pt 6 title "linear, on the finer surface", \
     "" index 0 using 1:2 with points ls FUGE ps 0.9 title "linear, on the coarser surface", \
     "" index 5 using 1:2 with points pt 7 ps 0.25 lc rgb black title "linear, on the coarser one, a/h = 28", \
     "" index 3 using 1:2 with points ls FUGE_TOO lc rgb purple ps 0.7 title "quadratic"

# One measure a panel; h is the width of the cylinder's elements where the bodies touch.
set logscale xy
set format x "%g"
set format y "10^{%T}"
set xrange [0.03:0.33]
set xtics (0.05, 0.1, 0.2, 0.3)
set yrange [3e-5:1]
set ytics autofreq
set mytics 10
set xlabel "h / a"
E = "cylinder_block_errors.csv"
of(v, c) = column(1) == v ? column(c) : NaN
set ylabel "root mean square of errors" offset 0.8
eval panel(0.09, 0.37, 0.09, 0.425)
set title "Largest pressure"
eval gridlines
unset key
plot E using (1/$2):(of(5, 5)) with linespoints lc rgb vermilion pt 2 ps 0.8 lw 1.2, \
     E using (1/$2):(of(2, 5)) with linespoints ls OTHER_TOO pt 6, \
     E using (1/$2):(of(1, 5)) with linespoints ls FUGE, \
     E using (1/$2):(of(4, 5)) with linespoints ls FUGE_TOO lc rgb purple
eval panel(0.405, 0.685, 0.09, 0.425)
unset ylabel
set format y ""
set title "Half-width"
eval gridlines
unset key
plot E using (1/$2):(of(5, 4)) with linespoints lc rgb vermilion pt 2 ps 0.8 lw 1.2, \
     E using (1/$2):(of(2, 4)) with linespoints ls OTHER_TOO pt 6, \
     E using (1/$2):(of(1, 4)) with linespoints ls FUGE, \
     E using (1/$2):(of(4, 4)) with linespoints ls FUGE_TOO lc rgb purple
eval panel(0.72, 0.985, 0.09, 0.425)
set title "Force"
eval gridlines
unset key
plot E using (1/$2):(of(5, 3)) with linespoints lc rgb vermilion pt 2 ps 0.8 lw 1.2, \
     E using (1/$2):(of(2, 3)) with linespoints ls OTHER_TOO pt 6, \
     E using (1/$2):(of(1, 3)) with linespoints ls FUGE, \
     E using (1/$2):(of(4, 3)) with linespoints ls FUGE_TOO lc rgb purple
unset multiplot
