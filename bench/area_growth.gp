# Time and memory of contacts on an area over the number of cells along a side, from area_growth.csv: area_growth.png.
# Run in the folder of the table.
load system("dirname '".ARG0."'")."/curves.gp"
eval picture("area_growth", 800, 470)
# fuge's curves by problem, those of other codes as in the other pictures.
set linetype 16 lc rgb green lw 2 pt 9 ps 0.75
set linetype 17 lc rgb blue lw 2 pt 7 ps 0.6
set linetype 18 lc rgb purple lw 2 pt 13 ps 0.8
names = 'fuge_sphere fuge_light_area fuge_heavy_area aspher_nested_sphere aspher_sphere tamaas_sphere '. \
  'contactmechanics_sphere'
array kind[7] = [16, 17, 18, 12, 13, 11, 14]
array title[7] = ['fuge: sphere', 'fuge: rough surface, light load', 'fuge: rough surface, heavy load', \
  'ASPHER, nested grids: sphere', 'ASPHER: sphere', 'Tamaas: sphere', 'ContactMechanics: sphere']
of(curve, column) = strcol(1) eq curve ? column : NaN
set logscale xy
set format y '10^{%L}'
set xlabel 'cells along a side' offset 0, 0.3
set xtics ('64' 64, '256' 256, '1024' 1024, '4096' 4096)
set xrange [50:5500]
set ytics 10
set mytics 1
set multiplot
eval panel(0.09, 0.485, 0.345, 0.92)
set title 'Time of operator and first solve' offset 0, -0.3
set ylabel 'time [s]' offset 0.5
set yrange [1e-3:2e2]
set key at screen 0.5, 0.02 center bottom maxrows 4 width 1
plot for [c = 1:7] 'area_growth.csv' using 2:(of(word(names, c), $3)) with linespoints lt kind[c] title title[c]
eval panel(0.585, 0.98, 0.345, 0.92)
set title 'Memory'
set ylabel 'memory [MB]'
set yrange [1:5e3]
unset key
plot for [c = 1:7] 'area_growth.csv' using 2:(of(word(names, c), $4/1e6)) with linespoints lt kind[c]
unset multiplot
