# Press fit of a shaft in a hub by meshes that do not match: pressures at the nodes by angle.
# Run in the folder of shaft_hub_pressure.csv.
set terminal pngcairo size 1400,520 font "sans,13" enhanced
set output "shaft_hub.png"
set datafile separator comma
set multiplot
blue = "#1f4e79"
red = "#c0392b"
green = "#1e8449"
brown = "#b9770e"
lame = 5.7422
f = "shaft_hub_pressure.csv"
set border 3
set xtics nomirror 15
set ytics nomirror
set grid xtics ytics lt 1 lc rgb "#dddddd"
set xrange [0:90]
set xlabel "angle [degrees]"
set tmargin at screen 0.90
set bmargin at screen 0.13
set key top center Left reverse samplen 2

set lmargin at screen 0.06
set rmargin at screen 0.49
set title "Smooth bodies, and faces as they are"
set ylabel "pressure [N/mm^2]"
set yrange [0:16]
plot f using ($1 == 4 ? $2 : NaN):3 with points pt 6 ps 1.2 lw 1.5 lc rgb red title "linear, 96 and 64, as they are (up to 137)", \
     f using ($1 == 3 ? $2 : NaN):3 with points pt 4 ps 1.1 lw 1.5 lc rgb brown title "linear, 64 and 96, as they are: no contact", \
     f using ($1 == 5 ? $2 : NaN):3 with linespoints pt 2 ps 1.1 lw 1.2 lc rgb green title "quadratic, 24 and 36, as they are", \
     f using ($1 == 1 ? $2 : NaN):3 with points pt 7 ps 0.9 lc rgb blue title "smooth: linear, 64 and 96", \
     f using ($1 == 2 ? $2 : NaN):3 with points pt 7 ps 0.5 lc rgb "#5dade2" title "smooth: quadratic, 24 and 36", \
     lame with lines lw 1 lc rgb "#666666" title "Lamé"

set lmargin at screen 0.56
set rmargin at screen 0.985
set title "Smooth bodies: mortar method, and nodes against faces"
unset ylabel
set yrange [0:16]
plot f using ($1 == 6 ? $2 : NaN):3 with linespoints pt 6 ps 1.2 lw 1.2 lc rgb red title "nodes against faces: linear, 64 and 96", \
     f using ($1 == 7 ? $2 : NaN):3 with linespoints pt 2 ps 1.1 lw 1.2 lc rgb green title "nodes against faces: quadratic, 24 and 36", \
     f using ($1 == 1 ? $2 : NaN):3 with points pt 7 ps 0.9 lc rgb blue title "mortar: linear, 64 and 96", \
     f using ($1 == 2 ? $2 : NaN):3 with points pt 7 ps 0.5 lc rgb "#5dade2" title "mortar: quadratic, 24 and 36", \
     lame with lines lw 1 lc rgb "#666666" title "Lamé"
unset multiplot
