# A rough surface whose pressure is limited by its hardness: areas over load, and a cut through the pressures.
# Run in the folder of hardness_load.csv and hardness_cut.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("hardness", 800, 660)
set datafile separator ","
set multiplot

hardnesses = "0 1 0.5 0.25"
colours = blue." ".green." ".vermilion." ".purple
marks = "7 9 13 5"
name(k) = k == 1 ? "no limit" : "H = ".word(hardnesses, k)
# Persson's areas, as in hardness_theory.f90.
term(p, H, n) = 2/(n*pi)*sin(n*pi*p/H)*exp(-0.125*(n*pi/H)**2)
limited(p, H) = p/H - sum [n=1:40] (n % 2 ? 1 : -1)*term(p, H, n)
contact(p, H) = H == 0 ? erf(sqrt(2)*p) : limited(p, H) + sum [n=0:20] 2*term(p, H, 2*n + 1)
set samples 400

eval panel(0.085, 0.48, 0.575, 0.95)
set title "Real area of contact, for the hardness H [E* g]" offset 0, -0.3
set xlabel "mean pressure p [E* g],  g rms gradient" offset 0, 0.3
set ylabel "area / A_0" offset 0.5
set format "%g"
set logscale xy
set xrange [0.008:1.5]
set yrange [0.012:1.3]
set key bottom right
eval gridlines
plot for [k=1:4] (k == 1 || x <= real(word(hardnesses, k))) ? contact(x, real(word(hardnesses, k))) : NaN \
       with lines ls KNOWN title k == 1 ? "Persson" : "", \
     for [k=1:4] "hardness_load.csv" using (abs($1 - real(word(hardnesses, k))) < 1e-6 ? $2 : NaN):3 every ::1 \
       with points pt int(word(marks, k)) ps 0.7 lc rgb word(colours, k) title name(k)

eval panel(0.59, 0.985, 0.575, 0.95)
unset logscale
set title "How much of it is at its limit"
set xlabel "p / H"
set ylabel "area at the limit / area of contact"
set xrange [0:1]
set yrange [0:1.03]
set key bottom right
eval gridlines
share(p, H) = limited(p, H)/contact(p, H)
plot for [k=2:4] x > 0 ? share(x*real(word(hardnesses, k)), real(word(hardnesses, k))) : NaN \
       with lines ls KNOWN title k == 2 ? "Persson" : "", \
     for [k=2:4] "hardness_load.csv" using (abs($1 - real(word(hardnesses, k))) < 1e-6 ? $2/$1 : NaN):($4/$3) \
       every ::1 with points pt int(word(marks, k)) ps 0.7 lc rgb word(colours, k) title name(k)

eval panel(0.085, 0.985, 0.085, 0.44)
set title "Cut through the highest pressure, p = 0.08 E* g: the edges of the spots carry what is cut off"
set xlabel "from the highest pressure [periods]"
set ylabel "pressure [E* g]"
set xrange [-0.035:0.035]
set yrange [0:2.1]
set key top right
eval gridlines
plot for [k=1:4] "hardness_cut.csv" using 1:(column(6 - k)) every ::1 with histeps lw 1.5 \
       lc rgb word(colours, k) title name(k)
unset multiplot
