# A roller covered with rubber: half width of the nip over the thickness, and pressures of incompressible rubber.
# Run in the folder of coated_roller.csv and coated_roller_pressure.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("coated_roller", 800, 350)
set multiplot
set datafile separator comma

eval panel(0.085, 0.485, 0.16, 0.90)
set title "Half width of the nip" offset 0, -0.3
set xlabel "thickness of the rubber over a_H" offset 0, 0.3
set ylabel "half width over a_H" offset 0.5
set logscale xy
set xrange [0.001:10]
set yrange [0.02:2]
set format "%g"
set key at graph 0.98, 0.06 right bottom noreverse Right
eval gridlines
plot 1 with lines ls KNOWN title "solid rubber, thin layers", \
     "coated_roller.csv" using 1:($3 < 2 ? $3 : NaN) every ::1 with lines ls KNOWN notitle, \
     "" using 1:($7 < 2 ? $7 : NaN) every ::1 with lines ls KNOWN notitle, \
     "" using 1:2 every ::1 with linespoints ls FUGE title "Poisson's ratio 0.3", \
     "" using 1:4 every ::1 with linespoints ls FUGE_TOO title "0.45", \
     "" using 1:6 every ::1 with linespoints ls FUGE_THIRD title "0.5"

unset logscale
eval panel(0.575, 0.985, 0.16, 0.90)
set title "Pressure, incompressible rubber" offset 0, -0.3
set xlabel "x/a_H" offset 0, 0.3
set ylabel "pressure over p_H" offset 0
set xrange [0:1.1]
set yrange [0:7]
set xtics 0.2
set ytics 1
set key at graph 0.98, 0.97 right top noreverse Right
set samples 1001
# The thin law: pressures over p_H, lengths over a_H.
thin(x, a) = abs(x) < a ? 15*pi/32/a*(1 - (x/a)**2)**2 : NaN
a_thin = 0.236836
eval gridlines
plot thin(x, a_thin) with lines ls KNOWN title "thin layer, 0.032", \
     sqrt(1 - x**2) with lines ls KNOWN dt (4, 4) title "solid rubber", \
     "coated_roller_pressure.csv" using 1:($2 > 0 ? $2 : NaN) every ::1 with lines lw 1.8 lc rgb vermilion \
       title "thickness 0.032 a_H", \
     "" using 3:($4 > 0 ? $4 : NaN) every ::1 with lines lw 1.8 dt (8, 3) lc rgb green title "0.32", \
     "" using 5:($6 > 0 ? $6 : NaN) every ::1 with lines lw 1.8 lc rgb sky title "1", \
     "" using 7:($8 > 0 ? $8 : NaN) every ::1 with lines lw 1.8 lc rgb blue title "10"
unset multiplot
