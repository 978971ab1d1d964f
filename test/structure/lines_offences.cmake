# lines.cmake has to find each of these offences, and nothing that is exempt:
# cmake -D SCRATCH=.. -P lines_offences.cmake
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")

string(REPEAT "x" 121 wide)
plant(src/wide.f90 "! ${wide}\n")
plant(test/unit/test_wide.pf "  @assertTrue(${wide})\n")
plant(doc/table.md "| ${wide} |\n\n![${wide}](a.png)\n\n```text\n[${wide}; ]\n```\n")
string(REPEAT "é" 120 accents)
plant(doc/accents.md "${accents}\n")
execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/lines.cmake"
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(SEND_ERROR "what is exempt is not accepted:\n${output}")
endif()

plant(CMakeLists.txt "# ${wide}\n" "CMakeLists.txt: # xxx")
plant(script/wide "${wide}\n" "script/wide: xxx")
plant(test/unit/test_wide.pf "a = [${wide}; 1]\n" "test/unit/test_wide.pf: a = _xxx")
plant(doc/wide.md "- ${wide}\n\n```c\n${wide}\n```\n" "doc/wide.md: - xxx" "doc/wide.md: xxx")
expect_offences(lines.cmake -DROOT=${SCRATCH})
