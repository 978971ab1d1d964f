# cmake -DROOT=<project> -P names_match.cmake
# Fails where the external procedures of src/f77, the list of their names in
# cmake/external_names.txt and the sections of doc/legacy.md differ.
cmake_minimum_required(VERSION 3.20)

# result: sorted list of the procedures in what `pattern` finds in `text`
function(find_names result text pattern)
  string(REPLACE ";" " " text "${text}")
  string(REGEX MATCHALL "\n${pattern}" found "\n${text}")
  list(TRANSFORM found TOLOWER)
  list(TRANSFORM found REPLACE ".*(fuge[a-z][a-z]).*" "\\1")
  list(SORT found)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

set(sources "")
file(GLOB files "${ROOT}/src/f77/*.f90")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  string(APPEND sources "${text}\n")
endforeach()
file(READ "${ROOT}/cmake/external_names.txt" list)
file(READ "${ROOT}/doc/legacy.md" manual)

find_names(in_sources "${sources}" "subroutine fuge[a-z][a-z] ?\\(")
find_names(in_list "${list}" "fuge[a-z][a-z]")
find_names(in_manual "${manual}" "## FUGE[A-Z][A-Z]")
foreach(other IN ITEMS in_list in_manual)
  if("${in_sources}" STREQUAL "" OR NOT "${in_sources}" STREQUAL "${${other}}")
    message(SEND_ERROR "src/f77 has ${in_sources}, but ${other}: ${${other}}")
  endif()
endforeach()
message(STATUS "external procedures: ${in_sources}")
