# Below a rough surface: pressure, von Mises stress at the depth where it is largest, and on a cut below the highest
# pressure, which is in the middle. Run in the folder of stress_rough_pressure.dat, stress_rough_depth.dat,
# stress_rough_cut.dat and stress_rough_place.dat.
stats "stress_rough_place.dat" using 1 name "shortest" nooutput
stats "stress_rough_place.dat" using 2 name "deepest" nooutput
stats "stress_rough_depth.dat" matrix name "m" nooutput
stats "stress_rough_pressure.dat" matrix name "p" nooutput
stats "stress_rough_cut.dat" matrix name "c" nooutput
# Cells for the shortest wave, and the depth of the map in cells.
wave = shortest_max
depth = deepest_max
along(k, n) = (k - floor(n/2))/wave
load system("dirname '".ARG0."'")."/style.gp"
eval picture("stress_rough", 800, 640)
set multiplot
set border 15 lw 1 front
set tics out nomirror scale 0.6
set size ratio -1
unset key
eval pressures

half = along(p_size_x - 0.5, p_size_x)
set xrange [-half:half]
set yrange [-half:half]
set xtics 4
set ytics 4
set xlabel "x / shortest wave" offset 0, 0.3
set ylabel "y / shortest wave" offset 0.5
eval panel(0.085, 0.405, 0.535, 0.94)
set title "Pressure at z = 0: spots" offset 0, -0.3
set cbrange [0:p_max]
set cblabel "pressure / mean" offset 0.3
set cbtics 5
set colorbox user origin 0.415, 0.54 size 0.016, 0.395
plot "stress_rough_pressure.dat" matrix using (along($1, p_size_x)):(along($2, p_size_y)):($3 > 0 ? $3 : NaN) \
       with image, \
     "+" using 1:(0) with lines dt 2 lw 1.5 lc rgb blue

eval panel(0.565, 0.885, 0.535, 0.94)
unset ylabel
set title sprintf("Von Mises stress at z = %.2f waves: largest", depth/wave)
set cbrange [0:m_max]
set cblabel "von Mises stress / mean pressure"
set cbtics 2
set colorbox user origin 0.905, 0.54 size 0.016, 0.395
plot "stress_rough_depth.dat" matrix using (along($1, m_size_x)):(along($2, m_size_y)):3 with image, \
     "+" using 1:(0) with lines dt 2 lw 1.5 lc rgb blue

set colorbox user origin 0.905, 0.097 size 0.016, 0.25
set cblabel "as above"
eval panel(0.085, 0.885, 0.095, 0.40)
set yrange [c_size_y/wave:0]
set ytics 1
set ylabel "z / shortest wave" offset 0.5
set title "Von Mises stress on the vertical cut along the dashed lines: the spots blur within two waves"
plot "stress_rough_cut.dat" matrix using (along($1, c_size_x)):(($2 + 0.5)/wave):3 with image, \
     "+" using 1:(depth/wave) with lines dt 2 lw 1.5 lc rgb blue
unset multiplot
