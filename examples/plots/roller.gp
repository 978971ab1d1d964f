# A roller of finite length on a plane: pressure along its axis, and maps of one end.
# Run in the folder of roller_axis.csv and roller_map_1.dat to roller_map_4.dat.
set terminal pngcairo size 1200,560 font "sans,13" enhanced
set output "roller.png"
set multiplot
set tics nomirror

set border 3
set lmargin at screen 0.07
set rmargin at screen 0.99
set tmargin at screen 0.93
set bmargin at screen 0.56
set title "Roller of steel on a plane, R = 10 mm, L = 20 mm, 10 kN: largest pressure across the contact"
set xlabel "y, along the axis [mm]" offset 0, 0.5
set ylabel "pressure [GPa]"
set grid lc rgb "#dddddd"
set key top center maxrows 3 width 2
set datafile separator comma
stats "roller_axis.csv" using 2 every ::1 name "s" nooutput
set xrange [-10.4:10.4]
set yrange [0:2.6]
set label 1 sprintf("up to %.1f GPa", s_max/1e3) at -9.7, 2.4 left textcolor rgb "#c0392b"
plot 1.3529 with lines dt 2 lw 1.5 lc rgb "#999999" title "a roller without ends", \
     "roller_axis.csv" using 1:($2/1e3) every ::1 with lines lw 2 lc rgb "#c0392b" title "straight", \
     "" using 1:($3/1e3) every ::1 with lines lw 2 lc rgb "#b9770e" title "crowned by 0.015 mm", \
     "" using 1:($4/1e3) every ::1 with lines lw 2 lc rgb "#7fb3d5" title "logarithmic, made for the load", \
     "" using 1:($5/1e3) every ::1 with lines lw 2 lc rgb "#1f4e79" title "logarithmic, made for 1.2 times the load"
unset label 1

set datafile separator whitespace
set border 15
unset grid
unset key
set tmargin at screen 0.40
set bmargin at screen 0.11
set xrange [8:10.2]
set xtics 0.5
set yrange [-0.34:0.34]
set ytics 0.2
set cbrange [0:2]
set palette defined (0 "#ffffff", 0.0001 "#fdebd0", 0.5 "#e67e22", 0.75 "#a93226", 1 "#4a0e0b")
set xlabel "y [mm]"
do for [k=1:4] {
  set lmargin at screen 0.07 + 0.217*(k - 1)
  set rmargin at screen 0.07 + 0.217*(k - 1) + 0.195
  if (k == 1) { set ylabel "x [mm]"; set format y } else { unset ylabel; set format y "" }
  if (k == 4) { set colorbox user origin 0.94, 0.11 size 0.012, 0.29 } else { unset colorbox }
  set title word("straight crowned logarithmic -", k) offset 0, -0.5
  if (k == 4) { set title "logarithmic, 1.2 F" offset 0, -0.5; set cblabel "pressure [GPa]" offset 0.5 }
  plot sprintf("roller_map_%d.dat", k) using 2:1:($3/1e3) with image
}
unset multiplot
