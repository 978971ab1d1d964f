# budget.cmake has to find each of these offences: cmake -D SOURCES=src -D SCRATCH=.. -P budget_offences.cmake
cmake_minimum_required(VERSION 3.20)

include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")
file(COPY "${SOURCES}/" DESTINATION "${SCRATCH}")
string(REPEAT "! A line too many.\n" 100000 lines)
plant(core/base/fuge_planted.f90 "${lines}" "core has [0-9]+ lines, more than [0-9]+\n")
string(REPEAT "  use fuge_kinds, only: fuge_dp\n" 1000 names)
plant(fe/fuge_fe.f90 "${names}" "fe has [0-9]+ public names, more than [0-9]+\n")
plant(components.txt "district 1 :\n" "components.txt gives district 1 numbers, not lines and names\n")
expect_offences(budget.cmake -DSOURCES=${SCRATCH})
