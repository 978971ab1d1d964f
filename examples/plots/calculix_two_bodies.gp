# Two elastic bodies of a CalculiX model, meshes that do not match: contact by fuge and by CalculiX with its own methods.
# Run in the folder of calculix_two_bodies.csv and hertz.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("calculix_two_bodies", 800, 350)
set datafile separator comma
set multiplot
set xrange [0:0.62]
set yrange [0:235]
set xlabel "x [mm]" offset 0, 0.3
set key top right noreverse Right

eval panel(0.085, 0.53, 0.16, 0.90)
set ylabel "pressure at the nodes [N/mm^2]" offset 0.5
set title "Aluminium pressed on steel; CalculiX: surface to surface" offset 0, -0.3
eval gridlines
plot "hertz.csv" using 1:2 with lines ls KNOWN title "Hertz", \
     "calculix_two_bodies.csv" using 1:3 every ::1 with linespoints ls OTHER title "penalty 5 E/mm", \
     "" using 1:5 every ::1 with linespoints ls OTHER_TOO title "500 E/mm", \
     "" using 1:6 every ::1 with linespoints ls OTHER_THIRD title "5000 E/mm", \
     "" using 1:2 every ::1 with points ls FUGE title "fuge"

eval panel(0.56, 0.985, 0.16, 0.90)
unset ylabel
set format y ""
set title "CalculiX: node to surface, mortar"
eval gridlines
plot "hertz.csv" using 1:2 with lines ls KNOWN title "Hertz", \
     "calculix_two_bodies.csv" using 1:8 every ::1 with linespoints ls OTHER title "node to surface, 50 E/mm", \
     "" using 1:11 every ::1 with points ls OTHER_TOO ps 1.2 title "mortar", \
     "" using 1:2 every ::1 with points ls FUGE title "fuge"
unset multiplot
