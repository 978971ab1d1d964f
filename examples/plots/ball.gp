# A ball and a barrel on a plane against Hertz. Run in the folder of ball_axis.csv and ball_map.dat.
set terminal pngcairo size 1200,480 font "sans,13" enhanced
set output "ball.png"
set multiplot
set border 3
set tics nomirror

set lmargin at screen 0.07
set rmargin at screen 0.48
set tmargin at screen 0.91
set bmargin at screen 0.14
set title "Ball R = 10 mm on a plane, 100 N, steel on steel"
set xlabel "x [mm]"
set ylabel "pressure [GPa]"
set grid lc rgb "#dddddd"
set key bottom center
set datafile separator comma
stats "ball_axis.csv" using 1:2 every ::1 name "b" nooutput
every_so_many = int(b_records/64) > 1 ? int(b_records/64) : 1
a = 0.186833
p0 = 1.367831
p(x) = abs(x) < a ? p0*sqrt(1 - x**2/a**2) : 0
set samples 2001
set xrange [-0.22:0.22]
set yrange [0:1.5]
plot p(x) with lines lw 2 lc rgb "#999999" title "Hertz", \
     "ball_axis.csv" every every_so_many::1 using 1:($2/1e3) with points pt 7 ps 0.7 lc rgb "#c0392b" \
       title sprintf("fuge, %d of %d cells", b_records/every_so_many, b_records)

set datafile separator whitespace
set title "Barrel R_x = 10 mm, R_y = 200 mm: pressure [GPa]"
set lmargin at screen 0.54
set rmargin at screen 0.90
unset grid
unset key
set border 15
set ylabel "y [mm]" offset 1
set xrange [-0.125:0.125]
set yrange [-0.87:0.87]
set palette defined (0 "#ffffff", 0.0001 "#fdebd0", 0.5 "#e67e22", 1 "#7b241c")
set cbrange [0:*]
set colorbox user origin 0.92, 0.14 size 0.015, 0.77
set parametric
set trange [0:2*pi]
plot "ball_map.dat" using 1:2:($3/1e3) with image, \
     0.105527*cos(t), 0.731164*sin(t) with lines lw 1.5 lc rgb "#1f4e79"
unset multiplot
