# A table of the program for the blocks of blocks.f90 is that of the library.
# cmake -DPROGRAM=.. -DBLOCKS=.. -DARGUMENTS=a|b|.. -DNAME=.. -DDIMENSIONS=2|3 -DCASE=patch|corner -P this
cmake_minimum_required(VERSION 3.20)

string(REPLACE "|" ";" arguments "${ARGUMENTS}")
file(REMOVE "${NAME}.csv" "${NAME}.vtu")
execute_process(COMMAND "${PROGRAM}" ${arguments} --output "${NAME}.csv" --field "${NAME}.vtu" --verbose
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(NOT status EQUAL 0 OR NOT output STREQUAL "" OR errors MATCHES "warning" OR NOT errors MATCHES " s  done\n$")
  message(FATAL_ERROR "exit status ${status}, output \"${output}\", messages \"${errors}\"")
endif()
execute_process(COMMAND "${BLOCKS}" check "${NAME}.csv" ${DIMENSIONS} ${CASE} RESULT_VARIABLE status
  OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
message(STATUS "${output}")
file(READ "${NAME}.vtu" head LIMIT 3000)
foreach(name IN ITEMS displacement pressure contact_force body)
  if(NOT head MATCHES "Name=\"${name}\"")
    message(SEND_ERROR "${NAME}.vtu has no ${name}")
  endif()
endforeach()
