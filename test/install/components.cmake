# find_package tells which of the components that it is asked for are not there, why, and which are.
# ctest sets PREFIX, KIND, SCRATCH, GENERATOR and MAKE_PROGRAM.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

# The call with these components fails with a message that matches `expected`.
function(expect_refusal prefix components expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/components" -B "${SCRATCH}" -G "${GENERATOR}"
      "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_PREFIX_PATH=${prefix}" "-DCOMPONENTS=${components}"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "COMPONENTS ${components} is not refused with \"${expected}\":\n${output}")
  endif()
endfunction()

expect_refusal("${PREFIX}" nonsense "there is no component nonsense. Components of this copy: [a-z, ]*${KIND}")
expect_refusal("${PREFIX}" "${KIND};nonsense" "there is no component nonsense")
expect_refusal("${PREFIX}" "static;shared"
  "not installed here as a static library|static and shared exclude each other")

# A copy without the optional parts.
file(REMOVE_RECURSE "${SCRATCH}_prefix")
file(COPY "${PREFIX}/" DESTINATION "${SCRATCH}_prefix")
file(GLOB_RECURSE config "${SCRATCH}_prefix/*/fuge-config.cmake")
get_filename_component(folder "${config}" DIRECTORY)
file(GLOB targets "${folder}/fuge-sparse-*" "${folder}/fuge-mpi-*")
file(REMOVE ${targets})
file(WRITE "${folder}/fuge-${KIND}-features.cmake"
  "set(fuge_WITH_FFTW OFF)\nset(fuge_COMPONENTS core elastic halfplane halfspace rings layers fe)\n")
foreach(component IN ITEMS fft=FFTW sparse=CHOLMOD mpi=MPI punches=punches)
  string(REGEX MATCH "^(.*)=(.*)$" component "${component}")
  expect_refusal("${SCRATCH}_prefix" ${CMAKE_MATCH_1}
    "was built without ${CMAKE_MATCH_2} .* this copy: core, elastic, halfplane, halfspace, rings, layers, fe, \
${KIND}\\.")
endforeach()
file(WRITE "${folder}/fuge-${KIND}-features.cmake" "set(fuge_WITH_FFTW OFF)\nset(fuge_COMPONENTS core)\n")
expect_refusal("${SCRATCH}_prefix" sparse "was built without fe .FUGE_COMPONENTS., which sparse needs")
expect_refusal("${SCRATCH}_prefix" mpi "was built without layers .FUGE_COMPONENTS., which mpi needs")
file(REMOVE_RECURSE "${SCRATCH}_prefix")
