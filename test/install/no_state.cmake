# The library has no variables that all threads would share, but for constants that the compiler does not
# mark as such, the locks, and under them the number that tells matrices apart and what is prepared for forks. The team
# of each thread, `current`, is not shared: it is thread-local, which nm does not show.
# cmake -DNM=nm -DARCHIVE=libfuge.a -P no_state.cmake
#
# gfortran makes such variables of `save`, of local variables with a value to begin with, and of the length
# of a function's result that is `character(len=:), allocatable` (slen). It puts the tables of `select case` with words
# (jumptable.97.1) beside them, and without optimisation constant array constructors (A.65.0).
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(constants "__fuge_.*_MOD___(vtab|def_init)_.*" "__fuge_c_general_MOD_(k|meanings|version)"
  "(A|jumptable)\\.[0-9]+\\.[0-9]+")
set(thread_local "current")
set(locks "locks|last_stamp|fork_once|registered(\\.[0-9]+)?")

run("nm" "${NM}" "${ARCHIVE}")
string(REGEX MATCHALL "[0-9a-f]+ [bBdDC] [^\n]+" variables "${output}")
list(TRANSFORM variables REPLACE ".* " "")
list(JOIN constants "|" allowed)
list(FILTER variables EXCLUDE REGEX "^(${allowed}|${locks}|${thread_local})$")
if(variables)
  list(JOIN variables " " variables)
  message(FATAL_ERROR "threads share these variables: ${variables}")
endif()
