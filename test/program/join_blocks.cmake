# Both blocks in one mesh and one matrix: both.inp and both.mtx from those of lower and upper.
cmake_minimum_required(VERSION 3.20)

file(READ lower.inp lower)
file(READ upper.inp upper)
# Names of the upper block that the lower one has too.
string(REPLACE "NSET=" "NSET=UPPER_" upper "${upper}")
string(REPLACE "NAME=FACE" "NAME=BELOW" upper "${upper}")
file(WRITE both.inp "${lower}${upper}")
file(READ lower_abaqus.mtx lower)
file(READ upper_abaqus.mtx upper)
file(WRITE both.mtx "${lower}${upper}")
