# The crown of a roller: largest pressure along its axis, and the profiles.
# Run in the folder of crown.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("crown", 800, 620)
set datafile separator ","
set multiplot

hertz = 1.3529
set xrange [0:10.2]
set xtics 2
set key top left
eval panel(0.085, 0.985, 0.52, 0.94)
set title "Steel roller, R = 10 mm, L = 20 mm, F = 10 kN: crowns found by least squares, and Lundberg's" offset 0, -0.3
set ylabel "largest pressure [GPa]" offset 0.5
set yrange [1.15:1.6]
set ytics 0.1
eval gridlines
plot hertz with lines ls KNOWN title "a roller without ends", \
     "crown.csv" using 1:($3/1e3) every ::1 with lines lw 1.8 lc rgb sky title "Lundberg, made for F", \
     "" using 1:($4/1e3) every ::1 with lines lw 1.8 dt (8, 3) lc rgb green title "Lundberg, made for 1.2 F", \
     "" using 1:($5/1e3) every ::1 with lines lw 1.8 lc rgb vermilion title "logarithm found, two parameters", \
     "" using 1:($6/1e3) every ::1 with lines lw 1.8 lc rgb blue title "24 splines found"

eval panel(0.085, 0.48, 0.09, 0.40)
set title "The profiles"
set xlabel "y, from the middle to one end [mm]" offset 0, 0.3
set ylabel "drop [{/Symbol m}m]"
set yrange [0:7.5]
set ytics 2
eval gridlines
unset key
plot "crown.csv" using 1:8 every ::1 with lines lw 1.8 lc rgb sky notitle, \
     "" using 1:9 every ::1 with lines lw 1.8 dt (8, 3) lc rgb green notitle, \
     "" using 1:10 every ::1 with lines lw 1.8 lc rgb vermilion notitle, \
     "" using 1:11 every ::1 with lines lw 1.8 lc rgb blue notitle

eval panel(0.59, 0.985, 0.09, 0.40)
set title "Less that of Lundberg, made for F"
set ylabel "difference [{/Symbol m}m]" offset 0.5
set ytics 0.2
set yrange [-0.1:1.3]
eval gridlines
unset key
plot 0 with lines lw 1.8 lc rgb sky notitle, \
     "crown.csv" using 1:($9 - $8) every ::1 with lines lw 1.8 dt (8, 3) lc rgb green notitle, \
     "" using 1:($10 - $8) every ::1 with lines lw 1.8 lc rgb vermilion notitle, \
     "" using 1:($11 - $8) every ::1 with lines lw 1.8 lc rgb blue notitle
unset multiplot
