# cmake -DINCLUDE_DIR=include -DMPI_HEADER=fuge_mpi.h -DSOURCES=src -P header_matches.cmake
#
# Fails with the names where the C headers and the sources differ. Each of the components of SOURCES/components.txt
# has a header fuge_<component>.h. It declares the functions that the C files of the component define and the constants
# of its modules, no others, and includes headers of components that it may use. Its structs have reserved members, as
# doc/install.md promises. fuge.h includes all of them.
cmake_minimum_required(VERSION 3.20)

# result: what the files say, with ';' taken out
function(read_sources result)
  set(all "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" text)
    string(REPLACE ";" " " text "${text}")
    string(APPEND all "${text}\n")
  endforeach()
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

# The same for C, without comments.
function(read_c result)
  read_sources(all ${ARGN})
  string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" all "${all}")
  set(${result} "\n${all}" PARENT_SCOPE)
endfunction()

# result: sorted list of "NAME = number" in what `pattern` finds in `text`
function(find_numbers result text pattern)
  string(REGEX MATCHALL "${pattern}" found "${text}")
  list(TRANSFORM found REPLACE ".*(FUGE_[A-Z0-9_]+) *= *(-?[0-9]+).*" "\\1 = \\2")
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

# Two lists are the same; adds their length to `number_of_<what>`.
function(require_same what header in_header in_fortran)
  set(header_only ${in_header})
  list(REMOVE_ITEM header_only "" ${in_fortran})
  set(sources_only ${in_fortran})
  list(REMOVE_ITEM sources_only "" ${in_header})
  if(header_only OR sources_only)
    message(SEND_ERROR "${what} only in ${header}: ${header_only}\n${what} only in its sources: ${sources_only}")
  endif()
  list(LENGTH in_header number)
  list(LENGTH in_fortran number_in_fortran)
  if(NOT number EQUAL number_in_fortran)
    message(SEND_ERROR "${what}: ${number} in ${header}, ${number_in_fortran} in its sources")
  endif()
  math(EXPR number "${number_of_${what}} + ${number}")
  set(number_of_${what} ${number} PARENT_SCOPE)
endfunction()

# result: the headers of fuge that the header `text` includes
function(find_includes result text)
  string(REGEX MATCHALL "\n#include [\"<]fuge[a-z_]*[.]h[\">]" found "${text}")
  list(TRANSFORM found REPLACE ".*(fuge[a-z_]*[.]h).*" "\\1")
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

set(of_function "fuge_[a-z0-9_]+ *\\(")
set(of_binding "bind\\(c, *name *= *'fuge_[a-z0-9_]+'\\)")
set(of_constant "FUGE_[A-Z0-9_]+ *= *-?[0-9]+")
set(number_of_functions 0)
set(number_of_constants 0)

# These are those that the facade has.
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/uses.cmake")
fuge_read_uses("${SOURCES}/components.txt" uses_)
set(components ${uses_facade})

foreach(component IN LISTS components)
  set(name "fuge_${component}.h")
  if(NOT EXISTS "${INCLUDE_DIR}/${name}")
    message(SEND_ERROR "there is no ${name}")
    continue()
  endif()
  read_c(header "${INCLUDE_DIR}/${name}")
  fuge_component_folder(folder "${SOURCES}" "${component}")
  file(GLOB_RECURSE bindings "${SOURCES}/${folder}/fuge_c_*.f90")
  if(component STREQUAL "fe")
    # The library fuge_sparse has functions of bodies.
    file(GLOB sparse "${SOURCES}/sparse/fuge_c_*.f90")
    list(APPEND bindings ${sparse})
  endif()
  file(GLOB_RECURSE modules "${SOURCES}/${folder}/*.f90")
  read_sources(api ${bindings})
  read_sources(fortran ${modules})

  find_functions(in_header "${header}" "${of_function}")
  find_functions(in_fortran "${api}" "${of_binding}")
  require_same(functions ${name} "${in_header}" "${in_fortran}")

  find_numbers(in_header "${header}" "${of_constant}")
  find_numbers(in_fortran "${fortran}" "integer, parameter, public :: ${of_constant}")
  require_same(constants ${name} "${in_header}" "${in_fortran}")

  string(REPLACE ";" " " text "${header}")
  string(REGEX MATCHALL "struct fuge_[a-z_]+ {[^}]*}" structs "${text}")
  foreach(struct IN LISTS structs)
    if(NOT struct MATCHES " double reserved\\[")
      message(SEND_ERROR "${name}: a struct without reserved members: ${struct}")
    endif()
  endforeach()

  find_includes(included "${header}")
  foreach(other IN LISTS included)
    string(REGEX REPLACE "^fuge_(.*)[.]h$" "\\1" used "${other}")
    if(NOT used IN_LIST uses_${component})
      message(SEND_ERROR "${name} includes ${other}: ${component} may not use it")
    endif()
  endforeach()
endforeach()
if(number_of_functions EQUAL 0 OR number_of_constants EQUAL 0)
  message(SEND_ERROR "${number_of_functions} functions and ${number_of_constants} constants found in ${INCLUDE_DIR}")
endif()

# fuge.h has all, and nothing of its own; there is no other header.
set(wanted ${components})
list(TRANSFORM wanted REPLACE "(.+)" "fuge_\\1.h")
list(SORT wanted)
read_c(header "${INCLUDE_DIR}/fuge.h")
find_includes(included "${header}")
list(SORT included)
if(NOT included STREQUAL wanted)
  message(SEND_ERROR "fuge.h includes ${included}, not ${wanted}")
endif()
string(REGEX MATCHALL "${of_function}|${of_constant}" declared "${header}")
if(declared)
  message(SEND_ERROR "fuge.h declares ${declared}: that belongs to the header of a component")
endif()
file(GLOB found RELATIVE "${INCLUDE_DIR}" "${INCLUDE_DIR}/*")
list(REMOVE_ITEM found fuge.h ${wanted})
if(found)
  message(SEND_ERROR "no component has the header ${found}")
endif()

# The library fuge_mpi. Some of its functions are written in C, and declare there what they call in Fortran; those the
# linker compares.
file(GLOB bindings "${SOURCES}/mpi/fuge_c_*.f90")
file(GLOB_RECURSE c_files "${SOURCES}/mpi/*.c")
read_c(header "${MPI_HEADER}")
read_sources(api ${bindings})
read_c(c_text ${c_files})
find_functions(in_header "${header}" "${of_function}")
find_functions(in_fortran "${api}" "${of_binding}")
find_functions(in_c "${c_text}" "\nint ${of_function}")
list(REMOVE_ITEM in_header "" ${in_c})
list(REMOVE_ITEM in_fortran "" ${in_c})
require_same(functions fuge_mpi.h "${in_header}" "${in_fortran}")

file(GLOB headers "${INCLUDE_DIR}/*.h")
read_c(header ${headers})
read_sources(fortran "${SOURCES}/core/fuge_version_number.f90")
string(REGEX MATCHALL "#define FUGE_VERSION \"[^\"]+\"" in_header "${header}")
string(REGEX MATCH "FUGE_VERSION = '[^']+'" in_fortran "${fortran}")
string(REGEX REPLACE ".*'(.*)'" "#define FUGE_VERSION \"\\1\"" in_fortran "${in_fortran}")
if(NOT in_header STREQUAL in_fortran)
  message(SEND_ERROR "the headers have ${in_header}, Fortran ${in_fortran}")
endif()
message(STATUS "${number_of_functions} functions, ${number_of_constants} constants")
