# cmake -DROOT=.. -DSCRATCH=.. -P demo.cmake
# script/demo with examples that only print: it ends well if all verdicts are right, and fails if a value is wrong, an
# example fails or has no verdict. Nothing is compiled, because cmake and gnuplot are replaced too.
cmake_minimum_required(VERSION 3.20)

file(REMOVE_RECURSE "${SCRATCH}")
foreach(name IN ITEMS script/demo examples/plots/page.awk README.md doc/theory_area.md)
  get_filename_component(folder "${SCRATCH}/${name}" DIRECTORY)
  file(COPY "${ROOT}/${name}" DESTINATION "${folder}")
endforeach()

function(write_command path)
  list(JOIN ARGN "\n" lines)
  file(WRITE "${SCRATCH}/${path}" "#!/bin/sh\n${lines}\n")
  file(CHMOD "${SCRATCH}/${path}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()

set(right "echo a table" "echo 'verdict: 2 of 2 as known, worst 1.0E-09'")
foreach(path IN ITEMS script/bootstrap bin/cmake bin/gnuplot)
  write_command(${path} "exit 0")
endforeach()
file(STRINGS "${ROOT}/script/demo" lines REGEX "\"\\$examples/[a-z_/]+\"")
foreach(line IN LISTS lines)
  string(REGEX REPLACE ".*\"\\$examples/([a-z_/]+)\".*" "\\1" name "${line}")
  write_command(build/demo/examples/${name} ${right})
endforeach()

# run(STATUS pattern): the script ends with this status and prints this.
function(run status pattern)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PATH=${SCRATCH}/bin:$ENV{PATH}" "${SCRATCH}/script/demo"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL status OR NOT output MATCHES "${pattern}")
    message(SEND_ERROR "script/demo ended with ${result}, not with ${status}, or did not print \"${pattern}\":\n"
      "${output}")
  endif()
  file(READ "${SCRATCH}/build/demo/output/index.html" page)
  if(NOT page MATCHES "<img src=\"ball.png\" width=\"800\" alt=\"[A-Z][^\"]+\">")
    message(SEND_ERROR "the page of script/demo has no picture with a caption")
  endif()
  if(status AND NOT page MATCHES "FAILED" OR NOT status AND page MATCHES "FAILED")
    message(SEND_ERROR "the page of script/demo does not tell what failed")
  endif()
endfunction()

run(0 "A ball and a barrel on a plane +2 of 2 as known, worst 1.0E-09 .*all [0-9]+ scenes give the known answers")
write_command(build/demo/examples/ball "echo 'verdict: 1 of 2 as known, worst 1.0E-01'")
run(1 "FAILED: 1 of 2 as known.*1 of [0-9]+ scenes FAILED")
write_command(build/demo/examples/ball ${right} "echo 'not so' >&2" "exit 1")
run(1 "FAILED: 2 of 2 as known.*1 of [0-9]+ scenes FAILED")
write_command(build/demo/examples/ball "echo a table")
run(1 "FAILED: a table.*1 of [0-9]+ scenes FAILED")
write_command(build/demo/examples/ball "echo a table" "echo 'ERROR STOP far from it' >&2" "exit 1")
run(1 "FAILED: ERROR STOP far from it")
