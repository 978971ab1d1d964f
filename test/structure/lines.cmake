# No line is longer than 120 characters: cmake -D ROOT=. -P lines.cmake
#
# Exempt is what a tool or a format holds on one line: assertions of pFUnit, JSON and notebooks, tables of numbers,
# lists of one line an entry, and in Markdown tables, pictures, and what a program prints. fortitude looks at src/.
# Characters outside ASCII are not counted.
cmake_minimum_required(VERSION 3.20)

get_filename_component(ROOT "${ROOT}" REALPATH)
set(kinds "[.](c|cff|cmake|cpp|css|f|f90|gp|h|in|inc|md|pf|py|sh|toml|yaml)$|CMakeLists[.]txt$|^script/|^[.]ci/")
file(GLOB files LIST_DIRECTORIES FALSE RELATIVE "${ROOT}" "${ROOT}/*")
foreach(folder IN ITEMS .ci bench cmake doc examples include packages python script test)
  file(GLOB_RECURSE found LIST_DIRECTORIES FALSE RELATIVE "${ROOT}" "${ROOT}/${folder}/*")
  list(APPEND files ${found})
endforeach()
list(FILTER files INCLUDE REGEX "${kinds}")
# Lines of pFUnit as wide as they come, for the stand-in.
list(FILTER files EXCLUDE REGEX "^test/compat/selftest/|^examples/data/|/build/|/__pycache__/")

string(REPEAT "[^\n]" 120 widest)
set(offences)
foreach(name IN LISTS files)
  file(READ "${ROOT}/${name}" text)
  string(REGEX REPLACE "[^\n -~]" "" text "\n${text}")
  # Lists of CMake are divided by semicolons, and brackets hold them together.
  string(REGEX REPLACE "[][;]" "_" text "${text}")
  set(begin "[^\n]")
  if(name MATCHES "[.]md$")
    string(REGEX REPLACE "\n```text\n[^`]*\n```" "\n" text "${text}")
    set(begin " ? ? ?[^ |!\n]")
  elseif(name MATCHES "[.]pf$")
    string(REGEX REPLACE "\n *@assert[^\n]*" "\n" text "${text}")
  endif()
  string(REGEX MATCHALL "\n${begin}${widest}[^\n]*" lines "${text}")
  foreach(line IN LISTS lines)
    string(SUBSTRING "${line}" 1 60 line)
    list(APPEND offences "${name}: ${line} ..")
  endforeach()
endforeach()

if(offences)
  list(JOIN offences "\n  " offences)
  message(FATAL_ERROR "These lines are longer than 120 characters:\n  ${offences}")
endif()
list(LENGTH files count)
message(STATUS "no line of ${count} files is longer than 120 characters")
