# The installed program solves the paper's Tabelle 1, also after the whole tree has been moved.
# ctest sets PREFIX, BINDIR, KIND, SCRATCH and DATA.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

function(expect_table what program)
  run("${what}" "${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH --unset=DYLD_LIBRARY_PATH
    "${program}" --alpha "${DATA}/two_nodes_alpha.mtx" --gap "${DATA}/two_nodes_gap.mtx" --load 2)
  if(NOT output MATCHES "\n1, 2\\.0+E\\+000, 0\\.0+E\\+000,contact\n2, 0\\.0+E\\+000, 8\\.0+[0-9]E-001,open\n")
    message(FATAL_ERROR "${what} printed the wrong table: ${output}")
  endif()
endfunction()

expect_table("the program, ${KIND}" "${PREFIX}/${BINDIR}/fuge")
run("two blocks, ${KIND}" "${PREFIX}/${BINDIR}/fuge" "${DATA}/../blocks/job.txt")
string(REGEX MATCHALL ", (2\\.0000000000000[0-9]+|1\\.9999999999999[0-9]+)E\\+000, *0\\.0+E\\+000,contact\n" points "${output}")
list(LENGTH points points)
if(NOT points EQUAL 5)
  message(FATAL_ERROR "the pressure of the blocks is not uniform: ${output}")
endif()
run("version" "${PREFIX}/${BINDIR}/fuge" --version)
message(STATUS "${output}")
file(REMOVE_RECURSE "${SCRATCH}")
file(COPY "${PREFIX}/" DESTINATION "${SCRATCH}/moved")
expect_table("the program, ${KIND}, moved" "${SCRATCH}/moved/${BINDIR}/fuge")
