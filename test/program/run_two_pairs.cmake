# Two pairs: the pressure is uniform in both, E/10 = 2.4.
# cmake -DPROGRAM=.. -DARGUMENTS=a|b|.. -P this
cmake_minimum_required(VERSION 3.20)

string(REPLACE "|" ";" arguments "${ARGUMENTS}")
execute_process(COMMAND "${PROGRAM}" ${arguments} RESULT_VARIABLE status OUTPUT_VARIABLE table ERROR_VARIABLE errors)
if(NOT status EQUAL 0 OR NOT errors STREQUAL "")
  message(FATAL_ERROR "exit status ${status}, message \"${errors}\"")
endif()
foreach(pair IN ITEMS 1 2)
  string(REGEX MATCHALL "\n${pair},upper,[^\n]*" lines "${table}")
  list(LENGTH lines count)
  list(FILTER lines EXCLUDE REGEX ", (2\\.400000000000[0-9]+|2\\.399999999999[0-9]+)E\\+000, *-?0\\.0+E\\+000,contact$")
  if(NOT count EQUAL 5 OR lines)
    message(SEND_ERROR "pair ${pair}: ${count} points, other pressures: ${lines}")
  endif()
endforeach()
