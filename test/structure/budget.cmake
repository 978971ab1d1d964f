# How large the components may be: cmake -D SOURCES=src -P budget.cmake
#
# Each row of SOURCES/components.txt has the lines of source that the component may have and the public names of its
# module. What is above fails. To raise a number needs, in the same commit, a new row of README's table or of
# doc/index.md, or something else that leaves.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/uses.cmake")

get_filename_component(SOURCES "${SOURCES}" REALPATH)
set(offences)
fuge_read_uses("${SOURCES}/components.txt" may_)
foreach(component IN LISTS names)
  list(LENGTH budget_${component} numbers)
  if(NOT numbers EQUAL 2)
    list(APPEND offences "components.txt gives ${component} ${numbers} numbers, not lines and names")
    continue()
  endif()
  list(GET budget_${component} 0 most_lines)
  list(GET budget_${component} 1 most_names)
  fuge_component_folder(folder "${SOURCES}" "${component}")

  set(lines 0)
  file(GLOB_RECURSE files "${SOURCES}/${folder}/*.f90" "${SOURCES}/${folder}/*.c" "${SOURCES}/${folder}/*.h"
    "${SOURCES}/${folder}/*.inc")
  foreach(file IN LISTS files)
    file(READ "${file}" text)
    string(REGEX REPLACE "[^\n]" "" text "${text}")
    string(LENGTH "${text}" count)
    math(EXPR lines "${lines} + ${count}")
  endforeach()
  if(lines GREATER most_lines)
    list(APPEND offences "${component} has ${lines} lines, more than ${most_lines}")
  endif()

  set(count 0)
  if(EXISTS "${SOURCES}/${folder}/fuge_${component}.f90")
    file(READ "${SOURCES}/${folder}/fuge_${component}.f90" text)
    string(REGEX REPLACE "&[ \t]*\n *" "" text "${text}")
    string(REGEX MATCHALL "use [a-z_0-9]+, only: [^\n]+" uses "${text}")
    foreach(use IN LISTS uses)
      string(REGEX MATCHALL "fuge_[a-z_0-9]+|FUGE_[A-Z_0-9]+" public "${use}")
      list(LENGTH public found)
      # The first is the module.
      math(EXPR count "${count} + ${found} - 1")
    endforeach()
  endif()
  if(count GREATER most_names)
    list(APPEND offences "${component} has ${count} public names, more than ${most_names}")
  endif()
  message(STATUS "${component}: ${lines} lines, ${count} names")
endforeach()

if(offences)
  list(JOIN offences "\n  " offences)
  message(FATAL_ERROR "The budget is exceeded:\n  ${offences}")
endif()
