# Bild 5 and 6: the lifted section of the disc. Run in the folder of disc_1.dat and disc_2.dat.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("disc", 800, 330)
set multiplot
set xlabel "distance from the axis [mm]" offset 0, 0.3
set ylabel "gap [mm]" offset 0.5
set xrange [-125:125]
set xtics ("100" -100, "50" -50, "0" 0, "50" 50, "100" 100)
set key at graph 0.5, 0.99 center top samplen 1
set arrow 1 from -50, graph 0.58 to -50, graph 0.68 lw 2 lc rgb vermilion size 5, 20 filled
set arrow 2 from 50, graph 0.58 to 50, graph 0.68 lw 2 lc rgb vermilion size 5, 20 filled
set label 1 "q" at 56, graph 0.63 textcolor rgb vermilion
set label 2 "q" at -56, graph 0.63 right textcolor rgb vermilion
do for [k=1:2] {
  eval panel(k == 1 ? 0.10 : 0.60, k == 1 ? 0.49 : 0.985, 0.16, 0.90)
  set title sprintf("Rubber disc, lifted by q = 0.%d N/mm", 36*k) offset 0, -0.3
  if (k == 1) { set yrange [-0.001:0.0245]; set ytics 0.005 } else { set yrange [-0.06:1.55]; set ytics 0.5 }
  if (k == 2) { set label 3 "misprints" at 122, 0.47 right textcolor rgb "#777777" }
  f = sprintf("disc_%d.dat", k)
  eval gridlines
  plot f using 1:3 with points pt 6 ps 1.6 lw 2 lc rgb "#999999" title "paper", \
       "" using (-$1):3 with points pt 6 ps 1.6 lw 2 lc rgb "#999999" notitle, \
       "" using 1:($2 > 0 ? $2 : 1/0) with points pt 6 ps 0.8 lw 1.2 lc rgb blue title "open ring", \
       "" using (-$1):($2 > 0 ? $2 : 1/0) with points pt 6 ps 0.8 lw 1.2 lc rgb blue notitle, \
       "" using 1:($2 > 0 ? 1/0 : $2) with points pt 7 ps 0.8 lc rgb blue title "ring in contact", \
       "" using (-$1):($2 > 0 ? 1/0 : $2) with points pt 7 ps 0.8 lc rgb blue notitle
}
unset multiplot
