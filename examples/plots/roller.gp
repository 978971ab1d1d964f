# A roller of finite length on a plane: pressure along its axis, and maps of one end.
# Run in the folder of roller_axis.csv and roller_map_1.dat to roller_map_4.dat.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("roller", 800, 500)
set multiplot

eval panel(0.085, 0.985, 0.50, 0.93)
set title \
  "Steel roller, R = 10 mm, L = 20 mm, F = 10 kN: a logarithmic profile made for 1.2 F keeps the pressure even" \
  offset 0, -0.3
set xlabel "y, along the axis [mm]" offset 0, 0.3
set ylabel "largest pressure [GPa]" offset 0.5
set key at graph 0.5, 0.97 center top maxrows 3 width -3
set datafile separator comma
stats "roller_axis.csv" using 2 every ::1 name "s" nooutput
set xrange [-10.4:10.4]
set yrange [0:3]
set ytics 0.5
eval gridlines
plot "roller_axis.csv" using 1:($2/1e3) every ::1 with lines lw 1.8 lc rgb vermilion \
       title sprintf("straight, up to %.1f GPa at its ends", s_max/1e3), \
     "" using 1:($3/1e3) every ::1 with lines lw 1.8 dt (8, 3) lc rgb green title "crowned by 0.015 mm", \
     "" using 1:($4/1e3) every ::1 with lines lw 1.8 lc rgb sky title "logarithmic, made for F", \
     "" using 1:($5/1e3) every ::1 with lines lw 1.8 lc rgb blue title "logarithmic, made for 1.2 F", \
     1.3529 with lines lc rgb black dt (4, 4) lw 0.8 title "a roller without ends"

set datafile separator whitespace
set border 15
unset key
set xrange [8:10.2]
set xtics 0.5
set yrange [-0.34:0.34]
set ytics 0.2
# Beyond 2 GPa another colour.
set palette defined (0 "#fff7ec", 0.5 "#fdd49e", 1 "#fc8d59", 1.5 "#d7301f", 2 "#5a0000", 2 "#4b2a8c", 2.2 "#4b2a8c")
set cbrange [0:2.2]
set cbtics (0, 0.5, 1, 1.5, sprintf("2 to %.1f", s_max/1e3) 2.1)
set xlabel "y [mm], one end"
do for [k=1:4] {
  left = 0.085 + 0.2*(k - 1)
  eval panel(left, left + 0.183, 0.12, 0.345)
  if (k == 1) { set ylabel "x [mm]"; set format y } else { unset ylabel; set format y "" }
  if (k == 4) { set colorbox user origin 0.885, 0.12 size 0.017, 0.225 } else { unset colorbox }
  set title (k < 3 ? word("straight crowned", k) : k == 3 ? "logarithmic, F" : "logarithmic, 1.2 F") offset 0, -0.3
  if (k == 4) { set label 1 "[GPa]" at screen 0.885, 0.375 left }
  plot sprintf("roller_map_%d.dat", k) using 2:1:($3 > 0 ? $3/1e3 : NaN) with image
}
unset multiplot
