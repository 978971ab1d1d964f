# The page on the architecture knows the source: cmake -D ROOT=.. -P names.cmake
#
# Each name in backticks of doc/architecture.md is a module, procedure, type or type-bound procedure of src/, and each
# folder of src/folders.txt has its line in the tree, which has no other.
cmake_minimum_required(VERSION 3.20)

file(READ "${ROOT}/doc/architecture.md" page)
string(REPLACE ";" "," page "${page}")
# The names that declarations in src/ give.
set(declared)
file(GLOB_RECURSE sources "${ROOT}/src/*.f90")
foreach(source IN LISTS sources)
  file(STRINGS "${source}" lines REGEX
    "^ *(((pure|elemental|impure|recursive) )*(subroutine|function|module) |(type|procedure|generic)[^!]*:: )[a-z]")
  string(REGEX REPLACE "([^;]*:: |[^;]*(subroutine|function|module) )([a-z_0-9]+)[^;]*" "\\3" lines "${lines}")
  list(APPEND declared ${lines})
endforeach()

set(offences)
string(REGEX MATCHALL "`[^`\n]+`" names "${page}")
list(REMOVE_DUPLICATES names)
list(REMOVE_ITEM names "`use`")
foreach(name IN LISTS names)
  string(REPLACE "`" "" name "${name}")
  if(NOT name MATCHES "^[a-z][a-z_0-9]*$")
    list(APPEND offences "${name} is not a name")
  elseif(NOT name IN_LIST declared)
    list(APPEND offences "${name} is not in src/")
  endif()
endforeach()

file(STRINGS "${ROOT}/src/folders.txt" folders REGEX "^[a-z]")
list(TRANSFORM folders REPLACE " *:.*" "")
string(REGEX MATCHALL "\n    [a-z_/0-9]+/  " lines "${page}")
list(TRANSFORM lines STRIP)
list(TRANSFORM lines REPLACE "/$" "")
foreach(folder IN LISTS folders)
  if(NOT folder IN_LIST lines)
    list(APPEND offences "the tree lacks ${folder}/")
  endif()
endforeach()
foreach(folder IN LISTS lines)
  if(NOT folder IN_LIST folders)
    list(APPEND offences "the tree has ${folder}/, which src/folders.txt lacks")
  endif()
endforeach()

if(offences)
  list(JOIN offences "\n  " offences)
  message(FATAL_ERROR "doc/architecture.md:\n  ${offences}")
endif()
list(LENGTH names count)
message(STATUS "${count} names are in src/")
