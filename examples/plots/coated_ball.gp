# A ball on steel with a hard film: pressure, radius, approach and stresses over the thickness. Run in the folder of
# coated_ball.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("coated_ball", 800, 560)
set multiplot
set datafile separator comma
set logscale x
set xrange [0.001:10]
set format x "%g"
set ylabel offset 0.7

# Hertz's values on a plate of k times the modulus of steel, over those on steel; e is 1/E*.
e(k) = 0.5*(1 + 1.0/k)
eval panel(0.07, 0.325, 0.61, 0.94)
set title "Largest pressure over p_H" offset 0, -0.3
set yrange [0.9:1.7]
set ytics 0.2
set key at graph 0.03, 0.98 left top
eval gridlines
plot e(2)**(-2.0/3) with lines ls KNOWN title "plate of film", \
     e(4)**(-2.0/3) with lines ls KNOWN notitle, \
     "coated_ball.csv" using 1:8 every ::1 with linespoints ls FUGE_THIRD title "4 times as stiff", \
     "" using 1:5 every ::1 with linespoints ls FUGE title "2 times", \
     "" using 1:2 every ::1 with linespoints ls FUGE_TOO title "steel"

eval panel(0.40, 0.655, 0.61, 0.94)
set title "Contact radius over a_H" offset 0, -0.3
set yrange [0.83:1.02]
set ytics 0.05
unset key
eval gridlines.'; unset key'
plot e(2)**(1.0/3) with lines ls KNOWN, e(4)**(1.0/3) with lines ls KNOWN, \
     "coated_ball.csv" using 1:9 every ::1 with linespoints ls FUGE_THIRD, \
     "" using 1:6 every ::1 with linespoints ls FUGE, \
     "" using 1:3 every ::1 with linespoints ls FUGE_TOO

eval panel(0.73, 0.985, 0.61, 0.94)
set title "Approach over that of steel" offset 0, -0.3
set yrange [0.7:1.03]
set ytics 0.1
eval gridlines.'; unset key'
plot e(2)**(2.0/3) with lines ls KNOWN, e(4)**(2.0/3) with lines ls KNOWN, \
     "coated_ball.csv" using 1:10 every ::1 with linespoints ls FUGE_THIRD, \
     "" using 1:7 every ::1 with linespoints ls FUGE, \
     "" using 1:4 every ::1 with linespoints ls FUGE_TOO
set xlabel "thickness of the film over a_H" offset 0, 0.3
eval panel(0.07, 0.325, 0.10, 0.43)
set title "Tension at the surface over p_H" offset 0, -0.3
set yrange [0:0.5]
set ytics 0.1
eval gridlines.'; unset key'
plot (1 - 2*0.3)/3 with lines ls KNOWN, \
     "coated_ball.csv" using 1:17 every ::1 with linespoints ls FUGE_THIRD, \
     "" using 1:14 every ::1 with linespoints ls FUGE, \
     "" using 1:11 every ::1 with linespoints ls FUGE_TOO

eval panel(0.40, 0.655, 0.10, 0.43)
set title "Tension at the bottom over p_H" offset 0, -0.3
set yrange [0:0.8]
eval gridlines.'; unset key'
plot "coated_ball.csv" using 1:18 every ::1 with linespoints ls FUGE_THIRD, \
     "" using 1:15 every ::1 with linespoints ls FUGE

eval panel(0.73, 0.985, 0.10, 0.43)
set title "Shear at the interface over p_H" offset 0, -0.3
set yrange [0:0.3]
eval gridlines.'; unset key'
plot "coated_ball.csv" using 1:19 every ::1 with linespoints ls FUGE_THIRD, \
     "" using 1:16 every ::1 with linespoints ls FUGE
unset multiplot
