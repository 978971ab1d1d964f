# Below a cylinder and a ball: stresses on the axis, the von Mises stress, and errors of the largest shear stress.
# Run in the folder of stress_axis.csv, stress_axis_line.csv, stress_ball_mises.dat and stress_cylinder.csv.
stats "stress_ball_mises.dat" matrix name "b" nooutput
load system("dirname '".ARG0."'")."/style.gp"
eval picture("stress_hertz", 800, 700)
x_of(k) = 2.0*(k + 0.5)/b_size_x
z_of(k) = 2.0*(k + 0.5)/b_size_y
set contour base
set cntrparam levels incremental 0.1, 0.1, 0.6
unset surface
set table $contours
splot "stress_ball_mises.dat" matrix using (x_of($1)):(z_of($2)):3
unset table
unset contour
set multiplot

eval panel(0.085, 0.485, 0.58, 0.95)
set title "Stresses on the axis: fuge on the known curves" offset 0, -0.3
set xlabel "stress / p_0" offset 0, 0.3
set ylabel "z / a" offset 0.5
set xrange [-1.05:0.7]
set yrange [3:0]
set ytics 1
set yzeroaxis lt 1 lw 1 lc rgb "#777777"
set key bottom left
set datafile separator comma
eval gridlines
plot "stress_axis.csv" using 4:1 every ::1 with lines ls KNOWN title "known", \
     "" using 5:1 every ::1 with lines ls KNOWN notitle, \
     "" using (0.5*abs($4 - $5)):1 every ::1 with lines ls KNOWN notitle, \
     "stress_axis_line.csv" using 3:1 every ::1 with lines ls KNOWN notitle, \
     "stress_axis.csv" using 3:1 every ::1 with points ls FUGE ps 0.6 title "ball, zz", \
     "" using 2:1 every ::1 with points ls FUGE pt 5 ps 0.55 lc rgb sky title "ball, rr", \
     "" using (0.5*abs($2 - $3)):1 every ::1 with points ls FUGE_TOO ps 0.7 title "ball, shear", \
     "stress_axis_line.csv" using 2:1 every ::1 with points ls FUGE_THIRD ps 0.7 title "cylinder, shear"
unset yzeroaxis

eval panel(0.60, 0.985, 0.58, 0.95)
set title "Cylinder: error of its largest shear stress"
set xlabel "cells"
set ylabel "error / p_0"
set xrange [12:700]
set yrange [1e-8:1e-2]
set logscale xy
set xtics (16, 32, 64, 128, 256, 512)
set ytics autofreq nomirror
set format y "10^{%L}"
set key top right noreverse Right
eval gridlines
plot 0.1/x**2 with lines ls KNOWN lw 1.5 dt 2 title "second order", \
     "stress_cylinder.csv" using 1:3 every ::1 with linespoints ls FUGE_THIRD title "mean over cells", \
     "" using 1:2 every ::1 with linespoints ls FUGE ps 1.0 title "at centres of cells", \
     "" using 1:4 every ::1 with linespoints lc rgb sky pt 5 ps 0.5 title "hats"
unset logscale
set format y "%g"

set datafile separator whitespace
set border 15 front
set tics out
unset key
set size ratio -1
eval panel(0.27, 0.60, 0.07, 0.445)
set title "Ball, ν = 0.3: the largest von Mises stress is below the middle; blue: the contact"
set xlabel "r / a"
set ylabel "z / a" offset 0
set xrange [0:2]
set yrange [2:0]
set xtics 0.5
set ytics 0.5
eval pressures
set cbrange [0:0.65]
set cbtics 0.1
set cblabel "von Mises stress / p_0" offset 0.5
set colorbox user origin 0.625, 0.07 size 0.02, 0.375
set label 1 sprintf("%.4f", b_max) at 0.32, z_of(b_index_max_y) left front textcolor rgb "#ffffff"
set arrow 1 from 0.29, z_of(b_index_max_y) to 0.01, z_of(b_index_max_y) front lw 1 lc rgb "#ffffff" size 0.05, 20 filled
# Below the lines of the map, near the axis and at the bottom.
array lower_z[3] = [0.92, 1.19, 1.525]
do for [k=1:3] { set label 10 + k sprintf("%.1f", 0.6 - 0.1*k) at 0.04, lower_z[k] - 0.06 left front font "sans,9" }
set label 14 "0.2" at 0.14, 1.94 left front font "sans,9"
set label 15 "0.1" at 1.74, 1.94 right front font "sans,9"
plot "stress_ball_mises.dat" matrix using (x_of($1)):(z_of($2)):3 with image, \
     $contours using 1:2 with lines lw 0.8 lc rgb "#333333", \
     "+" using ($1 <= 1 ? $1 : NaN):(0) with lines lw 4 lc rgb blue
unset multiplot
