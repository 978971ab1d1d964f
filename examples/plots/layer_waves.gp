# The factor T of waves on one layer over wave number times thickness. Run in the folder of layer_waves.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("layer_waves", 800, 350)
set multiplot
set datafile separator comma
set logscale xy
set format x "%g"
set xrange [0.01:10]
set xlabel "q h" offset 0, 0.3

eval panel(0.085, 0.485, 0.16, 0.90)
set title "T of a layer bonded to a half-space" offset 0, -0.3
set yrange [0.005:200]
set format y "10^{%T}"
set key at graph 0.98, 0.97 right top noreverse Right
eval gridlines
plot "layer_waves.csv" using 1:5 every ::1 with lines lw 1.8 lc rgb vermilion title "100 times as stiff", \
     "" using 1:4 every ::1 with lines lw 1.8 dt (8, 3) lc rgb orange title "10", \
     "" using 1:3 every ::1 with lines lw 1.8 dt (8, 3) lc rgb sky title "1/10", \
     "" using 1:2 every ::1 with lines lw 1.8 lc rgb blue title "1/100"

eval panel(0.575, 0.985, 0.16, 0.90)
set title "T of a layer on a rigid base" offset 0, -0.3
set yrange [1e-5:2]
set key at graph 0.98, 0.06 right bottom noreverse Right
eval gridlines
plot "layer_waves.csv" using 1:8 every ::1 with lines lw 1.8 lc rgb green title "sliding", \
     "" using 1:6 every ::1 with lines lw 1.8 lc rgb blue title "bonded, Poisson's ratio 0.3", \
     "" using 1:7 every ::1 with lines lw 1.8 dt (8, 3) lc rgb vermilion title "bonded, incompressible"
unset multiplot
