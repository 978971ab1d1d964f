# The style of all pictures: size, letters, colours and marks. Every other script loads this one first.
#
# eval picture("name", width, height): begin name.png, with the size in pixels of a page. The file has twice as many
# for sharp screens; letters have 13 pixels on the page, exponents 11.
picture(name, width, height) = sprintf('set output "%s.png"; set terminal pngcairo size %d,%d font "sans,10" ' \
  .'fontscale 2 linewidth 2 pointscale 2 enhanced background "#ffffff"', name, 2*width, 2*height)
# eval panel(left, right, bottom, top): the place of the next plot, fractions of the picture.
panel(left, right, bottom, top) = sprintf('set lmargin at screen %g; set rmargin at screen %g; ' \
  .'set bmargin at screen %g; set tmargin at screen %g', left, right, bottom, top)

# Colours that colour-blind readers can tell apart (M. Okabe and K. Ito), and three more for many curves.
black = "#000000"
blue = "#0072b2"
green = "#009e73"
orange = "#e69f00"
purple = "#cc79a7"
sky = "#56b4e9"
vermilion = "#d55e00"
brown = "#8c564b"
grey = "#777777"
wine = "#882255"
# Bodies, and the lines of their meshes.
solid = "#d5d8dc"
mesh = "#6f8090"

# Line styles by what they show. Marks differ as well as colours; fuge's are full.
KNOWN = 1
FUGE = 2
FUGE_TOO = 3
FUGE_THIRD = 4
OTHER = 5
OTHER_TOO = 6
OTHER_THIRD = 7
set style line KNOWN lc rgb "#999999" lw 2.5
set style line FUGE lc rgb blue lw 1.5 pt 7 ps 0.7
set style line FUGE_TOO lc rgb green lw 1.5 pt 9 ps 0.8
set style line FUGE_THIRD lc rgb vermilion lw 1.5 pt 13 ps 0.8
set style line OTHER lc rgb vermilion lw 1.2 pt 6 ps 0.8
set style line OTHER_TOO lc rgb green lw 1.2 pt 4 ps 0.8
set style line OTHER_THIRD lc rgb purple lw 1.2 pt 8 ps 0.9

# Pressures and stresses: darker is more, in grey too.
pressures = 'set palette defined (0 "#fff7ec", 0.25 "#fdd49e", 0.5 "#fc8d59", 0.75 "#d7301f", 1 "#5a0000")'

set border 3 lw 1
set tics nomirror scale 0.6
set key Left reverse samplen 1.8 spacing 1.1

# eval gridlines: draw the grid of the next plot, whose place, ranges and tics are set. Its own grid would have a hole
# where the legend is, wider than its text.
text_colour(colour) = sprintf('set title tc rgb "%s"; set xlabel tc rgb "%s"; set ylabel tc rgb "%s"; ', \
  colour, colour, colour).sprintf('set xtics tc rgb "%s"; set ytics tc rgb "%s"; ', colour, colour)
gridlines = 'set grid xtics ytics lt 1 lw 0.6 lc rgb "#e2e2e2"; unset key; '.text_colour("#ff000000") \
  .'plot NaN notitle; '.text_colour("#000000").'unset grid; set key on'
