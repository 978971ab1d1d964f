# cmake -DHEADER=include/fuge.h -DSOURCES=src -P header_matches.cmake
# Fails with the names where the header, with those beside it, and the Fortran sources differ.
cmake_minimum_required(VERSION 3.20)

# Numbers that are not for C.
set(fortran_only FUGE_MESSAGE_LENGTH)

# result: what the files say, with ';' and comments of C taken out
function(read_sources result)
  set(all "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" text)
    string(REPLACE ";" " " text "${text}")
    string(APPEND all "${text}\n")
  endforeach()
  string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" all "${all}")
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

# result: sorted list of "NAME = number" in what `pattern` finds in `text`
function(find_numbers result text pattern)
  string(REGEX MATCHALL "${pattern}" found "${text}")
  list(TRANSFORM found REPLACE ".*(FUGE_[A-Z0-9_]+) *= *(-?[0-9]+).*" "\\1 = \\2")
  list(FILTER found EXCLUDE REGEX "^(${fortran_only}) ")
  list(SORT found)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# result: sorted list of the function names in what `pattern` finds in `text`
function(find_functions result text pattern)
  string(REGEX MATCHALL "${pattern}" found "${text}")
  list(TRANSFORM found REPLACE ".*(fuge_[a-z0-9_]+).*" "\\1")
  list(SORT found)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

function(require_same what in_header in_fortran)
  if("${in_header}" STREQUAL "" OR "${in_fortran}" STREQUAL "")
    message(SEND_ERROR "no ${what} found: header \"${in_header}\", Fortran \"${in_fortran}\"")
  endif()
  set(header_only ${in_header})
  list(REMOVE_ITEM header_only ${in_fortran})
  set(sources_only ${in_fortran})
  list(REMOVE_ITEM sources_only ${in_header})
  if(header_only OR sources_only)
    message(SEND_ERROR "${what} only in the header: ${header_only}\n${what} only in Fortran: ${sources_only}")
  endif()
  list(LENGTH in_header number)
  list(LENGTH in_fortran number_in_fortran)
  if(NOT number EQUAL number_in_fortran)
    message(SEND_ERROR "${what}: ${number} in the header, ${number_in_fortran} in Fortran")
  endif()
  message(STATUS "${what}: ${number}")
endfunction()

file(GLOB_RECURSE modules "${SOURCES}/*.f90")
file(GLOB bindings "${SOURCES}/c/*.f90" "${SOURCES}/../sparse/fuge_c_*.f90")
get_filename_component(folder "${HEADER}" DIRECTORY)
file(GLOB headers "${folder}/*.h")
read_sources(header ${headers})
read_sources(fortran ${modules})
read_sources(api ${bindings})

find_numbers(in_header "${header}" "FUGE_[A-Z0-9_]+ *= *-?[0-9]+")
find_numbers(in_fortran "${fortran}" "integer, parameter, public :: FUGE_[A-Z0-9_]+ *= *-?[0-9]+")
require_same("constants" "${in_header}" "${in_fortran}")

find_functions(in_header "${header}" "fuge_[a-z0-9_]+ *\\(")
find_functions(in_fortran "${api}" "bind\\(c, *name *= *'fuge_[a-z0-9_]+'\\)")
require_same("functions" "${in_header}" "${in_fortran}")

string(REGEX MATCH "#define FUGE_VERSION \"[^\"]+\"" in_header "${header}")
string(REGEX MATCH "FUGE_VERSION = '[^']+'" in_fortran "${fortran}")
string(REGEX REPLACE ".*\"(.*)\"" "\\1" in_header "${in_header}")
string(REGEX REPLACE ".*'(.*)'" "\\1" in_fortran "${in_fortran}")
require_same("version" "${in_header}" "${in_fortran}")
