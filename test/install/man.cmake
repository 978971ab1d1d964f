# The man page is well formed and its functions exist; test/doc/status_texts.cmake looks at its status codes.
# cmake -DPAGE=fuge.3 -DINCLUDE_DIR=include -DGROFF=groff -P man.cmake
# Without GROFF the form is not looked at.
cmake_minimum_required(VERSION 3.20)

if(GROFF)
  execute_process(COMMAND "${GROFF}" -man -ww -Tascii "${PAGE}"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0 OR NOT errors STREQUAL "")
    message(SEND_ERROR "groff (${status}): ${errors}")
  endif()
endif()

file(READ "${PAGE}" page)
set(headers "")
file(GLOB files "${INCLUDE_DIR}/*.h")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  string(APPEND headers "${text}")
endforeach()
foreach(text IN ITEMS page headers)
  string(REPLACE ";" " " ${text} "${${text}}")
endforeach()

string(REGEX MATCHALL "fuge_[a-z_]+ \\(" functions "${page}")
if(NOT functions)
  message(SEND_ERROR "no functions in the page")
endif()
foreach(function IN LISTS functions)
  string(REPLACE " (" "(" function "${function}")
  string(FIND "${headers}" "${function}" place)
  if(place EQUAL -1)
    message(SEND_ERROR "not in the headers: ${function})")
  endif()
endforeach()

string(REGEX MATCH "FUGE_VERSION \"[^\"]+\"" version "${headers}")
string(REGEX REPLACE ".*\"(.*)\"" "fuge \\1" version "${version}")
string(FIND "${page}" "\"${version}\"" place)
if(place EQUAL -1)
  message(SEND_ERROR "the page is not that of ${version}")
endif()
