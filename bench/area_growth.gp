# Time and memory of contacts on an area over the number of cells along a side, from area_growth.csv:
#   gnuplot -e "kind='png'" area_growth.gp
set datafile separator ','
set datafile missing NaN
if (!exists('kind')) kind = 'png'
if (kind eq 'svg') {
  set terminal svg size 900,420 font 'sans,12' background '#ffffff'
} else {
  set terminal pngcairo size 1800,840 font 'sans,22' linewidth 2
}
set output 'area_growth.'.kind
set linetype 1 lc rgb '#009e73' lw 2.2 pt 9 ps 1.2
set linetype 2 lc rgb '#0072b2' lw 2 pt 7 ps 1.0
set linetype 3 lc rgb '#56b4e9' lw 2 pt 5 ps 1.0
set linetype 4 lc rgb '#d55e00' lw 1.4 pt 13 ps 1.3 dt (6,3)
set linetype 5 lc rgb '#d55e00' lw 1.4 pt 12 ps 1.3
set linetype 6 lc rgb '#a00000' lw 1.4 pt 3 ps 1.1 dt (3,2)
set linetype 7 lc rgb '#8c564b' lw 1.4 pt 11 ps 1.2
names = 'fuge_sphere fuge_light_area fuge_heavy_area aspher_sphere aspher_nested_sphere tamaas_sphere '. \
  'contactmechanics_sphere'
array title[7] = ['fuge: sphere', 'fuge: rough, light', 'fuge: rough, heavy', 'ASPHER: sphere', \
  'ASPHER, nested grids: sphere', 'Tamaas: sphere', 'ContactMechanics: sphere']
of(curve, column) = strcol(1) eq curve ? column : NaN
set logscale xy
set format y '10^{%L}'
set grid lc rgb '#dddddd' lw 0.5
set tics nomirror scale 0.5
set border 3
set xlabel 'cells along a side'
set xtics ('64' 64, '256' 256, '1024' 1024, '4096' 4096)
set xrange [50:5500]
set key top left Left reverse samplen 2.5
set multiplot layout 1,2
set title 'operator and first solve: time, s'
set yrange [1e-3:1e5]
plot for [c = 1:7] 'area_growth.csv' using 2:(of(word(names, c), $3)) with linespoints lt c title title[c]
set title 'memory, MB'
set yrange [1:1e4]
unset key
plot for [c = 1:7] 'area_growth.csv' using 2:(of(word(names, c), $4/1e6)) with linespoints lt c
unset multiplot
