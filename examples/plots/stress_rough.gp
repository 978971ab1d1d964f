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
set terminal pngcairo size 1200,880 font "sans,13" enhanced
set output "stress_rough.png"
set multiplot
set border 15 front
set tics out nomirror
set size ratio -1
unset key
set palette defined (0 "#ffffff", 0.04 "#fef5e7", 0.2 "#fad7a0", 0.5 "#e67e22", 0.75 "#a93226", 1 "#4a0e0b")
blue = "#1f4e79"

half = along(p_size_x - 0.5, p_size_x)
set xrange [-half:half]
set yrange [-half:half]
set xtics 2
set ytics 2
set xlabel "x / shortest wave" offset 0, 0.3
set ylabel "y / shortest wave" offset 1
set tmargin at screen 0.957
set bmargin at screen 0.503
set lmargin at screen 0.06
set rmargin at screen 0.395
set title "Pressure / mean" offset 0, -0.5
set cbrange [0:p_max]
set colorbox user origin 0.405, 0.503 size 0.012, 0.454
plot "stress_rough_pressure.dat" matrix using (along($1, p_size_x)):(along($2, p_size_y)):($3 > 0 ? $3 : NaN) \
       with image, \
     "+" using 1:(0) with lines dt 2 lw 1.5 lc rgb blue

set lmargin at screen 0.56
set rmargin at screen 0.895
set title sprintf("Von Mises stress / mean pressure at z = %.2f waves", depth/wave)
set cbrange [0:m_max]
set colorbox user origin 0.91, 0.083 size 0.012, 0.874
plot "stress_rough_depth.dat" matrix using (along($1, m_size_x)):(along($2, m_size_y)):3 with image, \
     "+" using 1:(0) with lines dt 2 lw 1.5 lc rgb blue

unset colorbox
set lmargin at screen 0.06
set rmargin at screen 0.895
set tmargin at screen 0.37
set bmargin at screen 0.083
set yrange [c_size_y/wave:0]
set ytics 1
set ylabel "z / shortest wave"
set title "Von Mises stress / mean pressure on the vertical cut through the dashed lines"
plot "stress_rough_cut.dat" matrix using (along($1, c_size_x)):(($2 + 0.5)/wave):3 with image, \
     "+" using 1:(depth/wave) with lines dt 2 lw 1.5 lc rgb blue
unset multiplot
