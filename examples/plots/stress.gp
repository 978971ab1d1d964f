# Fringes of constant shear in the plane, as photoelasticity shows them: bright where the largest shear stress is a
# multiple of the fringe value; red: the contact, and the place of the largest value. Run in the folder of
# stress_punch_10.dat, stress_punch_30.dat, stress_tilt.dat and stress_ball.dat.
stats "stress_punch_10.dat" matrix name "punch_1" nooutput
stats "stress_punch_30.dat" matrix name "punch_2" nooutput
stats "stress_tilt.dat" matrix name "tilt" nooutput
stats "stress_ball.dat" matrix name "ball" nooutput
load system("dirname '".ARG0."'")."/style.gp"
eval picture("stress", 800, 560)
set multiplot
set palette defined (0 "#101418", 0.5 "#7d848a", 1 "#ffffff")
set cbrange [0:1]
unset colorbox
unset key
set border 15 lw 1 front
set tics out nomirror scale 0.6
set size ratio -1
set style textbox opaque noborder fillcolor rgb "#ffffff" margins 0.5, 0.3
set style fill solid noborder
set samples 481
bright(tau) = cos(pi*tau)**2
place(k, row) = panel(0.075 + 0.49*k, 0.50 + 0.49*k - 0.015, 0.575 - 0.495*row, 0.945 - 0.495*row)
# The centre of a pixel, from its numbers in its table: the picture is twice as wide as high.
across(k, n, width) = width*((k + 0.5)/n - 0.5)
down(k, n, width) = 0.5*width*(k + 0.5)/n

set label 9 \
  "Largest shear stress in the plane: bright at each step of the scale; × the largest one, orange the contact" \
  at screen 0.5, 0.965 center
# The paper's punch, in mm.
set xlabel "x [mm]" offset 0, 0.4
set ylabel "z [mm]" offset 1.5
set xrange [-1.2:1.2]
set yrange [1.2:-0.12]
set xtics 0.4
set ytics 0.4
set label 1 "33 cells" at graph 0.025, 0.06 left front boxed
set label 2 "without a grid" at graph 0.975, 0.06 right front boxed
do for [k=1:2] {
  eval place(k - 1, 0)
  if (k == 2) { unset label 9 }
  F = word("10 30", k)
  a = (F*1e3/(0.75*pi*1e6/(1 - 0.25**2)*0.05))**0.25
  punch(x) = abs(x) < a ? 0 : 0.05*(a**4 - x**4)
  nx = value(sprintf("punch_%d_size_x", k))
  nz = value(sprintf("punch_%d_size_y", k))
  x_max = across(value(sprintf("punch_%d_index_max_x", k)), nx, 2.4)
  z_max = down(value(sprintf("punch_%d_index_max_y", k)), nz, 2.4)
  set title sprintf("Punch, %s kN/mm: steps of 0.5, largest %.1f kN/mm^2", F, \
    value(sprintf("punch_%d_max", k))/1e3) offset 0, -0.5
  plot sprintf("stress_punch_%s.dat", F) matrix using (across($1, nx, 2.4)):(down($2, nz, 2.4)):(bright($3/500)) \
         with image, \
       "+" using 1:(punch($1)):(-0.12) with filledcurves fillcolor rgb solid, \
       "+" using (abs($1) <= a ? $1 : NaN):(0) with lines lw 3 lc rgb vermilion, \
       "+" using (abs(x_max)):(z_max) every ::0::0 with points pt 2 ps 0.8 lw 2 lc rgb vermilion, \
       "+" using (-abs(x_max)):(z_max) every ::0::0 with points pt 2 ps 0.8 lw 2 lc rgb vermilion, \
       "+" using (0):(0):(0):(1.2) every ::0::0 with vectors nohead dt 3 lw 1 lc rgb vermilion
}

# In units of the contact.
set xlabel "x / a"
set ylabel "z / a"
set xrange [-2:2]
set yrange [2:-0.2]
set xtics 1
set ytics 1
unset label 2
eval place(0, 1)
set title "Flat punch, F at a/4: steps of 0.03 F/a"
set label 1 "F" at 0.36, -0.1 left front textcolor rgb "black"
set arrow 1 from 0.25, -0.19 to 0.25, -0.01 front lw 2 lc rgb "black" size 0.06, 25 filled
plot "stress_tilt.dat" matrix using (across($1, tilt_size_x, 4)):(down($2, tilt_size_y, 4)):(bright($3/0.03)) \
       with image, \
     "+" using (abs($1) <= 1 ? $1 : NaN):(0):(-0.2) with filledcurves fillcolor rgb solid, \
     "+" using (abs($1) <= 1 ? $1 : NaN):(0) with lines lw 3 lc rgb vermilion
unset label 1
unset arrow 1

eval place(1, 1)
set title sprintf("Ball, plane y = 0: steps of 0.04, largest %.2f p_0", ball_max)
set label 1 "rectangles" at graph 0.025, 0.06 left front boxed
set label 2 "without a grid" at graph 0.975, 0.06 right front boxed
gap(x) = abs(x) < 1 ? 0 : -0.1*(x**2 - 1)
plot "stress_ball.dat" matrix using (across($1, ball_size_x, 4)):(down($2, ball_size_y, 4)):(bright($3/0.04)) \
       with image, \
     "+" using 1:(gap($1)):(-0.2) with filledcurves fillcolor rgb solid, \
     "+" using (abs($1) <= 1 ? $1 : NaN):(0) with lines lw 3 lc rgb vermilion, \
     "+" using (0):(down(ball_index_max_y, ball_size_y, 4)) every ::0::0 \
       with points pt 2 ps 0.8 lw 2 lc rgb vermilion, \
     "+" using (0):(0):(0):(2) every ::0::0 with vectors nohead dt 3 lw 1 lc rgb vermilion
unset multiplot
