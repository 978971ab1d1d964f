# A project of its own finds the copy in PREFIX with find_package.
# ctest sets PREFIX, KIND, LANGUAGE, COMPILER, SCRATCH, CONFIG, GENERATOR and MAKE_PROGRAM.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

string(TOLOWER "${LANGUAGE}" folder)
set(what "${LANGUAGE} by find_package, ${KIND}")
file(REMOVE_RECURSE "${SCRATCH}")
run("${what}: configure" "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/${folder}" -B "${SCRATCH}"
  -G "${GENERATOR}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_PREFIX_PATH=${PREFIX}" -DKIND=${KIND}
  -DCMAKE_BUILD_TYPE=${CONFIG} "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${SCRATCH}/$<0:>"
  -DCMAKE_${LANGUAGE}_COMPILER=${COMPILER})
run("${what}: build" "${CMAKE_COMMAND}" --build "${SCRATCH}" --config "${CONFIG}")
expect_answer("${what}" "${SCRATCH}/consumer")
if(EXISTS "${SCRATCH}/types")
  run("${what}: all types" "${SCRATCH}/types")
  message(STATUS "${what}: ${output}")
endif()
