# A rough profile on a half-plane: where it touches, and real contact length over load.
# Run in the folder of rough_window.csv and rough_load.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("rough", 800, 400)
set datafile separator comma
set multiplot

# Heights and pressures above each other, over the same cells.
stats "rough_window.csv" using 1:2 every ::1 name "w" nooutput
set xrange [w_min_x*1e3:w_max_x*1e3]
eval panel(0.10, 0.485, 0.525, 0.90)
set title "Mean pressure 0.01 E*: the peaks touch" offset 0, -0.3
set ylabel "height [L/1000]" offset 1
set yrange [-0.33:0.33]
set ytics 0.1
set format x ""
set key bottom left
eval gridlines
plot "rough_window.csv" using ($1*1e3):($2*1e3) every ::1 with filledcurves y1=-0.33 \
       fillcolor rgb solid notitle, \
     "" using ($1*1e3):($2*1e3) every ::1 with lines lw 1 lc rgb "#555555" title "profile", \
     "" using ($1*1e3):($3*1e3) every ::1 with lines lw 1.5 lc rgb blue title "elastic surface"
unset title
unset key
eval panel(0.10, 0.485, 0.14, 0.475)
set format x
set xlabel "x [L/1000], L the period" offset 0, 0.3
set ylabel "pressure [E*]"
stats "rough_window.csv" using 4 every ::1 name "p" nooutput
set yrange [0:1.05*p_max]
eval gridlines
unset key
plot "rough_window.csv" using ($1*1e3):4 every ::1 with filledcurves y1=0 fillcolor rgb vermilion notitle

eval panel(0.585, 0.985, 0.14, 0.90)
set key top left
set title "Contact length A of A_0: light loads in proportion" offset 0, -0.3
set xlabel "p / (E* h'),  p mean pressure, h' rms slope"
set ylabel "A / A_0"
set logscale xy
set ytics autofreq
set xrange [1e-3:1.2]
set yrange [1e-3:1.2]
set format "10^{%T}"
eval gridlines
plot [p=1e-3:1.2] erf(sqrt(2)*p) with lines ls KNOWN title "Persson: erf(√2 p/(E* h'))", \
     p < 0.55 ? 2*p : NaN with lines ls KNOWN lw 1.5 dt 2 title "A/A_0 = κ p/(E* h'), κ = 2", \
     "rough_load.csv" using ($1/$9):2 every ::1 with points ls FUGE title "fuge"
unset multiplot
