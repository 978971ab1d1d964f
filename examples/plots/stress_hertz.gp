# Below a cylinder and a ball: stresses on the axis, the von Mises stress, and errors of the largest shear stress.
# Run in the folder of stress_axis.csv, stress_axis_line.csv, stress_ball_mises.dat and stress_cylinder.csv.
stats "stress_ball_mises.dat" matrix name "b" nooutput
set terminal pngcairo size 1500,520 font "sans,13" enhanced
set output "stress_hertz.png"
blue = "#1f4e79"
red = "#c0392b"
ochre = "#b9770e"
grey = "#999999"
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
set tics nomirror

set border 3
set lmargin at screen 0.045
set rmargin at screen 0.32
set tmargin at screen 0.92
set bmargin at screen 0.12
set grid lc rgb "#dddddd"
set title "On the axis: stresses, and the largest shear stress"
set xlabel "stress / p_0"
set ylabel "z / a" offset 1.5
set xrange [-1.05:0.7]
set yrange [3:0]
set key bottom left Left reverse samplen 2 spacing 1.15
set datafile separator comma
plot "stress_axis.csv" using 4:1 every ::1 with lines lw 2 lc rgb grey title "known", \
     "" using 5:1 every ::1 with lines lw 2 lc rgb grey notitle, \
     "" using (0.5*abs($4 - $5)):1 every ::1 with lines lw 2 lc rgb grey notitle, \
     "stress_axis_line.csv" using 3:1 every ::1 with lines lw 2 lc rgb grey notitle, \
     "stress_axis.csv" using 3:1 every ::1 with points pt 6 ps 0.8 lc rgb blue title "ball, zz", \
     "" using 2:1 every ::1 with points pt 4 ps 0.8 lc rgb blue title "ball, rr", \
     "" using (0.5*abs($2 - $3)):1 every ::1 with points pt 7 ps 0.7 lc rgb red title "ball, shear", \
     "stress_axis_line.csv" using 2:1 every ::1 with points pt 5 ps 0.7 lc rgb ochre title "cylinder, shear"

set datafile separator whitespace
set border 15 front
unset grid
unset key
set lmargin at screen 0.385
set rmargin at screen 0.615
set title "Ball: von Mises stress / p_0, {/Symbol n} = 0.3"
set xlabel "x / a"
set xrange [0:2]
set yrange [2:0]
set xtics 0.5
set ytics 0.5
set palette defined (0 "#ffffff", 0.25 "#fdebd0", 0.55 "#e67e22", 0.8 "#a93226", 1 "#4a0e0b")
set cbrange [0:0.65]
set cbtics 0.1
set colorbox user origin 0.625, 0.12 size 0.012, 0.80
set label 1 sprintf("%.4f", b_max) at 0.32, z_of(b_index_max_y) left front textcolor rgb "#ffffff"
set arrow 1 from 0.29, z_of(b_index_max_y) to 0.01, z_of(b_index_max_y) front lw 1.5 lc rgb "#ffffff"
plot "stress_ball_mises.dat" matrix using (x_of($1)):(z_of($2)):3 with image, \
     $contours using 1:2 with lines lw 1 lc rgb "#333333", \
     "+" using ($1 <= 1 ? $1 : NaN):(0) with lines lw 6 lc rgb red
unset label 1
unset arrow 1
unset colorbox

set border 3
set grid lc rgb "#dddddd"
set lmargin at screen 0.735
set rmargin at screen 0.985
set title "Cylinder: error of the largest shear stress"
set xlabel "cells"
set ylabel "error / p_0" offset 0.5
set xrange [12:700]
set yrange [1e-8:1e-2]
set logscale xy
set xtics (16, 32, 64, 128, 256, 512)
set ytics autofreq
set format y "10^{%L}"
set key top right noreverse Right
set datafile separator comma
plot 0.1/x**2 with lines dt 2 lw 1.5 lc rgb grey title "second order", \
     "stress_cylinder.csv" using 1:2 every ::1 with linespoints pt 7 ps 0.9 lw 1.5 lc rgb red title "FUGE\\_CENTRE", \
     "" using 1:3 every ::1 with linespoints pt 6 ps 1.1 lw 1.5 lc rgb ochre title "FUGE\\_MEAN", \
     "" using 1:4 every ::1 with linespoints pt 5 ps 0.8 lw 1.5 lc rgb blue title "FUGE\\_HAT"
unset multiplot
