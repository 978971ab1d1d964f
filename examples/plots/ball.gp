# A ball and a barrel on a plane against Hertz. Run in the folder of ball_axis.csv and ball_map.dat.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("ball", 800, 350)
set multiplot

eval panel(0.085, 0.485, 0.16, 0.90)
set title "Ball R = 10 mm, 100 N: pressure as by Hertz" offset 0, -0.3
set xlabel "x [mm]" offset 0, 0.3
set ylabel "pressure [GPa]" offset 0.7
set key at graph 0.5, 0.06 center bottom
set datafile separator comma
stats "ball_axis.csv" using 1:2 every ::1 name "b" nooutput
every_so_many = int(b_records/64) > 1 ? int(b_records/64) : 1
a = 0.186833
p0 = 1.367831
p(x) = abs(x) < a ? p0*sqrt(1 - x**2/a**2) : 0
set samples 2001
set xrange [-0.22:0.22]
set yrange [0:1.5]
set xtics 0.1
eval gridlines
plot p(x) with lines ls KNOWN title "Hertz", \
     "ball_axis.csv" every every_so_many::1 using 1:($2/1e3) with points ls FUGE ps 0.6 \
       title every_so_many > 1 ? sprintf("fuge, one cell in %d", every_so_many) : "fuge"

set datafile separator whitespace
set title "Barrel R_x = 10, R_y = 200 mm: Hertz's ellipse"
eval panel(0.575, 0.865, 0.16, 0.90)
set key at graph 0.98, 0.98 right top samplen 1.2 noreverse Right
set border 15
set xrange [-0.125:0.125]
set yrange [-0.87:0.87]
set xtics 0.1
set ytics 0.4
set ylabel "y [mm], not to scale" offset 0.7
eval pressures
set cbrange [0:*]
set cblabel "pressure [GPa]" offset 0.5
set colorbox user origin 0.885, 0.16 size 0.02, 0.74
set parametric
set trange [0:2*pi]
plot "ball_map.dat" using 1:2:($3 > 0 ? $3/1e3 : NaN) with image notitle, \
     0.105527*cos(t), 0.731164*sin(t) with lines lw 1.5 lc rgb blue title "Hertz"
unset multiplot
