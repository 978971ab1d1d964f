# Press fit of a shaft in a hub by meshes that do not match: pressures at the nodes by angle.
# Run in the folder of shaft_hub_pressure.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("shaft_hub", 800, 440)
set datafile separator comma
set multiplot
lame = 5.7422
f = "shaft_hub_pressure.csv"
at(k, angle) = column(1) == k ? angle : NaN
set xtics 15
set xrange [-2:92]
set yrange [-0.3:12]
set ytics 2
set xlabel "angle [degrees]" offset 0, 0.3

eval panel(0.075, 0.485, 0.13, 0.66)
set ylabel "pressure [N/mm^2]" offset 0.5
set key at screen 0.08, 0.925 left top
eval gridlines
set label 3 "crosses: 0, or 137, beyond the picture" at 45, 0.8 center
set label 1 "Smoothed surfaces give Lamé's pressure" at screen 0.28, 0.965 center
set label 2 "Mortar does too, nodes against faces do not" at screen 0.77, 0.965 center
plot lame with lines ls KNOWN title "Lamé", \
     f using (at(1, $2)):3 with points ls FUGE ps 0.8 title "smoothed: linear, 64 and 96", \
     f using (at(2, $2)):3 with points ls FUGE_TOO ps 0.6 title "smoothed: quadratic, 24 and 36", \
     f using (at(5, $2)):3 with linespoints ls OTHER title "as they are: quadratic, 24 and 36", \
     f using (at(3, $2)):3 with points ls OTHER_THIRD pt 4 ps 1.0 title "as they are: linear, 64 and 96", \
     f using (at(4, $2)):3 with points lc rgb black pt 2 ps 0.6 title "as they are: linear, 96 and 64"

eval panel(0.565, 0.975, 0.13, 0.66)
unset ylabel
unset label
set key at screen 0.57, 0.925 left top
eval gridlines
plot lame with lines ls KNOWN title "Lamé", \
     f using (at(1, $2)):3 with points ls FUGE ps 0.8 title "mortar: linear, 64 and 96", \
     f using (at(2, $2)):3 with points ls FUGE_TOO ps 0.6 title "mortar: quadratic, 24 and 36", \
     f using (at(7, $2)):3 with linespoints ls OTHER title "nodes on faces: quadratic, 24 and 36", \
     f using (at(6, $2)):3 with linespoints ls OTHER_THIRD pt 4 title "nodes on faces: linear, 64 and 96"
unset multiplot
