# A program prints what a page says: cmake -D PROGRAM=... [-D ARGUMENT=...] -D EXPECTED=file -P prints.cmake
cmake_minimum_required(VERSION 3.20)

execute_process(COMMAND "${PROGRAM}" ${ARGUMENT} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "it ended with ${status} after\n${printed}")
endif()
file(READ "${EXPECTED}" expected)
foreach(text IN ITEMS printed expected)
  string(REGEX REPLACE "[ \t\r]+\n" "\n" ${text} "${${text}}")
endforeach()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "it prints\n${printed}\nand not\n${expected}")
endif()
