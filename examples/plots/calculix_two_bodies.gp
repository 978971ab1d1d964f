# Two elastic bodies of a CalculiX model, meshes that do not match: contact by fuge and by CalculiX with its own methods.
# Run in the folder of calculix_two_bodies.csv and hertz.csv.
set terminal pngcairo size 1200,480 font "sans,13" enhanced
set output "calculix_two_bodies.png"
set datafile separator comma
set multiplot layout 1,2
set border 3
set tics nomirror
set grid lc rgb "#dddddd"
set xrange [0:0.62]
set yrange [0:215]
set xlabel "x [mm]"
set ylabel "pressure at the nodes [N/mm^2]"
set key top right Left reverse

set title "CalculiX, surface to surface"
plot "hertz.csv" using 1:2 with lines lw 2 lc rgb "#999999" title "Hertz", \
     "calculix_two_bodies.csv" using 1:3 every ::1 with linespoints pt 6 ps 0.8 lw 1 lc rgb "#1f4e79" \
       title "penalty 5 E/mm", \
     "" using 1:5 every ::1 with linespoints pt 4 ps 0.8 lw 1 lc rgb "#27ae60" title "500 E/mm", \
     "" using 1:6 every ::1 with linespoints pt 8 ps 0.9 lw 1 lc rgb "#8e44ad" title "5000 E/mm", \
     "" using 1:2 every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge"

set title "CalculiX, node to surface and mortar"
plot "hertz.csv" using 1:2 with lines lw 2 lc rgb "#999999" title "Hertz", \
     "calculix_two_bodies.csv" using 1:8 every ::1 with linespoints pt 6 ps 0.8 lw 1 lc rgb "#1f4e79" \
       title "node to surface, 50 E/mm", \
     "" using 1:11 every ::1 with points pt 10 ps 1.6 lw 1.5 lc rgb "#27ae60" title "mortar", \
     "" using 1:2 every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge"
unset multiplot
