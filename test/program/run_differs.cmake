# An option has an effect on the table.
# cmake -DPROGRAM=.. -DARGUMENTS=a|b|.. "-DOPTION=--x|value" -P this
cmake_minimum_required(VERSION 3.20)

string(REPLACE "|" ";" arguments "${ARGUMENTS}")
string(REPLACE "|" ";" option "${OPTION}")
foreach(table IN ITEMS without with)
  set(more)
  if(table STREQUAL "with")
    set(more ${option})
  endif()
  execute_process(COMMAND "${PROGRAM}" ${arguments} ${more} RESULT_VARIABLE status OUTPUT_VARIABLE ${table}
    ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${errors}")
  endif()
endforeach()
if(with STREQUAL without)
  message(FATAL_ERROR "the same table with ${option}:\n${with}")
endif()
