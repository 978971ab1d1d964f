# A finite element block on a rigid plate: contact by fuge, by CalculiX with penalties, by Hertz.
# Run in the folder of calculix.csv.
set terminal pngcairo size 1200,480 font "sans,13" enhanced
set output "calculix.png"
set datafile separator comma
set multiplot layout 1,2
set border 3
set tics nomirror
set grid lc rgb "#dddddd"
P = 100
R = 250
E = 2.1e5/(1 - 0.3**2)
a = sqrt(4*P*R/(pi*E))
p(x) = abs(x) < a ? 2*P/(pi*a)*sqrt(1 - x**2/a**2) : 0
set samples 2001
set xrange [0:0.55]
set xlabel "x [mm]"

set title "Block of finite elements on a rigid plate, 100 N/mm"
set ylabel "nodal force over area [N/mm^2]"
set yrange [0:185]
set key bottom left Left reverse
plot p(x) with lines lw 2 lc rgb "#999999" title "Hertz, half-plane", \
     "calculix.csv" using 1:4 every ::1 with linespoints pt 6 ps 0.8 lw 1 lc rgb "#1f4e79" \
       title "CalculiX, penalty 5 E/mm", \
     "" using 1:6 every ::1 with linespoints pt 4 ps 0.8 lw 1 lc rgb "#27ae60" \
       title "CalculiX, penalty 50 E/mm", \
     "" using 1:2 every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge"

set title "Gap; below zero penetration"
set ylabel "gap [{/Symbol m}m]"
set yrange [-0.16:0.2]
set key top left Left reverse
plot 0 with lines lw 1 lc rgb "#999999" notitle, \
     "calculix.csv" using 1:($5*1e3) every ::1 with linespoints pt 6 ps 0.8 lw 1 lc rgb "#1f4e79" \
       title "CalculiX, penalty 5 E/mm", \
     "" using 1:($7*1e3) every ::1 with linespoints pt 4 ps 0.8 lw 1 lc rgb "#27ae60" \
       title "CalculiX, penalty 50 E/mm", \
     "" using 1:($3*1e3) every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge"
unset multiplot
