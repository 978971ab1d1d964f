# A flange bolted on its gasket: pressure around the ring, force of the bolts, and the least pressure.
# Run in the folder of gasket_pressure.csv and gasket_load.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("gasket", 800, 700)
set datafile separator ","
set multiplot

counts = "4 8 16"
colours = vermilion." ".blue." ".green
marks = "13 7 9"

set key top right
set xlabel "angle from a bolt [degrees]" offset 0, 0.3
set xrange [0:90]
set xtics 22.5
set yrange [0:30]
do for [shown=0:1] {
  if (shown == 0) {
    eval panel(0.085, 0.48, 0.575, 0.95)
    set title "Tightened: few bolts open the gasket" offset 0, -0.3
    set ylabel "pressure of the gasket [N/mm^2]" offset 0.5
  } else {
    eval panel(0.58, 0.965, 0.575, 0.95)
    set title "Under a thrust of 240 kN"
  }
  eval gridlines
  plot for [k=2:3] "gasket_pressure.csv" using (abs($2 - 240*shown) < 1 && $1 == int(word(counts, k)) ? $3 : NaN):5 \
         every ::1 with lines ls KNOWN title k == 2 ? "closed form" : "", \
       for [k=1:3] "" using (abs($2 - 240*shown) < 1 && $1 == int(word(counts, k)) ? $3 : NaN):4 every ::1 \
         with points pt int(word(marks, k)) ps 0.6 lc rgb word(colours, k) title word(counts, k)." bolts"
}

# The joint diagram of a rigid ring.
stiffness = 2.1e5*1960/60
factor = stiffness/(stiffness + 2*pi*150*15000)
rigid(thrust) = thrust < 480/(1 - factor) ? 480 + factor*thrust : thrust
eval panel(0.085, 0.48, 0.085, 0.45)
set title "The bolts feel the thrust once the gasket opens"
set xlabel "thrust of the pressure [kN]"
set ylabel "force of all bolts [kN]" offset 1.2
set xrange [0:1000]
set yrange [400:1000]
set xtics 200
set samples 1001
set key top left
eval gridlines
plot rigid(x) with lines ls KNOWN title "joint diagram", \
     for [k=1:3] "gasket_load.csv" using ($1 == int(word(counts, k)) && $2 == 0 ? $3 : NaN):4 every ::1 \
       with points pt int(word(marks, k)) ps 0.45 lc rgb word(colours, k) title word(counts, k)." bolts", \
     "" using ($2 > 0 ? $3 : NaN):4 every ::1 with points pt 6 ps 0.7 lc rgb purple title "8 that yield"

eval panel(0.58, 0.965, 0.085, 0.45)
set title "More bolts keep the gasket closed for longer"
set ylabel "least pressure of the gasket [N/mm^2]" offset 0.5
set yrange [-0.3:11]
set key top right
eval gridlines
plot for [k=2:3] "gasket_load.csv" using ($1 == int(word(counts, k)) && $2 == 0 && $6 > -0.3 ? $3 : NaN):6 every ::1 \
       with lines ls KNOWN title k == 2 ? "closed form" : "", \
     for [k=1:3] "" using ($1 == int(word(counts, k)) && $2 == 0 ? $3 : NaN):5 every ::1 \
       with points pt int(word(marks, k)) ps 0.45 lc rgb word(colours, k) title word(counts, k)." bolts"
unset multiplot
