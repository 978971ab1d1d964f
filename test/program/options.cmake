# The help, the man page and the table of options name the same ones, and the program knows each of them.
# cmake -DPROGRAM=fuge -DVERSION=.. -DPAGE=fuge.1 -DTABLE=option_table.f90 -DGROFF=groff -P options.cmake
# Without GROFF the form of the page is not looked at.
cmake_minimum_required(VERSION 3.20)

if(GROFF)
  execute_process(COMMAND "${GROFF}" -man -ww -Tascii "${PAGE}"
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
  if(NOT status EQUAL 0 OR NOT errors STREQUAL "")
    message(SEND_ERROR "groff (${status}): ${errors}")
  endif()
endif()

execute_process(COMMAND "${PROGRAM}" --help OUTPUT_VARIABLE help RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "--help: exit status ${status}")
endif()
string(REGEX MATCHALL "--[a-z][-a-z]+" in_help "${help}")
list(REMOVE_DUPLICATES in_help)
list(SORT in_help)

file(READ "${PAGE}" page)
if(NOT page MATCHES "\"fuge ${VERSION}\"")
  message(SEND_ERROR "the page is not that of fuge ${VERSION}")
endif()
string(REPLACE "\\-" "-" page "${page}")
# Where an option is described it begins a line of its own.
string(REGEX MATCHALL "\n\\.BI? --[a-z][-a-z]+" in_page "${page}")
list(TRANSFORM in_page REPLACE "\n.*--" "--")
list(REMOVE_DUPLICATES in_page)
list(SORT in_page)

file(READ "${TABLE}" table)
string(REGEX MATCH "OPTION_NAMES[^]]*]" table "${table}")
string(REGEX MATCHALL "'[a-z][-a-z]+'" in_table "${table}")
list(TRANSFORM in_table REPLACE "'" "")
list(TRANSFORM in_table PREPEND "--")
list(SORT in_table)

list(LENGTH in_table count)
if(count LESS 10 OR NOT "${in_help}" STREQUAL "${in_table}" OR NOT "${in_page}" STREQUAL "${in_table}")
  message(FATAL_ERROR "the options differ:\n  --help    ${in_help}\n  man page  ${in_page}\n  program   ${in_table}")
endif()
foreach(option IN LISTS in_help)
  execute_process(COMMAND "${PROGRAM}" ${option} OUTPUT_QUIET ERROR_VARIABLE errors)
  if(errors MATCHES "unknown option")
    message(SEND_ERROR "${errors}")
  endif()
endforeach()

string(REGEX MATCHALL "\n[^\n]*" lines "${help}")
foreach(line IN LISTS lines)
  string(LENGTH "${line}" length)
  if(length GREATER 97)
    message(SEND_ERROR "more than 96 columns: ${line}")
  endif()
endforeach()
message(STATUS "${count} options")
