# A finite element block on a rigid plate: contact by fuge, by CalculiX with penalties, by Hertz.
# Run in the folder of calculix.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("calculix", 800, 370)
set datafile separator comma
set multiplot
P = 100
R = 250
E = 2.1e5/(1 - 0.3**2)
a = sqrt(4*P*R/(pi*E))
p(x) = abs(x) < a ? 2*P/(pi*a)*sqrt(1 - x**2/a**2) : 0
set samples 2001
set xrange [0:0.56]
set xlabel "x [mm]" offset 0, 0.3

eval panel(0.085, 0.485, 0.15, 0.90)
set title "Steel block on a rigid plate: pressure" offset 0, -0.3
set ylabel "nodal force / area [N/mm^2]" offset 0.8
set yrange [0:185]
set key bottom left
eval gridlines
plot p(x) with lines ls KNOWN title "Hertz, half-plane", \
     "calculix.csv" using 1:4 every ::1 with linespoints ls OTHER title "penalty 5 E/mm", \
     "" using 1:6 every ::1 with linespoints ls OTHER_TOO title "penalty 50 E/mm", \
     "" using 1:2 every ::1 with points ls FUGE title "fuge"

eval panel(0.585, 0.985, 0.15, 0.90)
set title "Gap; with penalties the bodies overlap"
set ylabel "gap [µm]"
set yrange [-0.16:0.2]
set xzeroaxis lt 1 lw 1 lc rgb "#777777"
set key top left
eval gridlines
plot "calculix.csv" using 1:($5*1e3) every ::1 with linespoints ls OTHER title "CalculiX, penalty 5 E/mm", \
     "" using 1:($7*1e3) every ::1 with linespoints ls OTHER_TOO title "CalculiX, penalty 50 E/mm", \
     "" using 1:($3*1e3) every ::1 with points ls FUGE title "fuge"
unset multiplot
