# untested.cmake has to find each of these offences: cmake -D ROOT=. -D SCRATCH=.. -P untested_offences.cmake
cmake_minimum_required(VERSION 3.20)

# With `text` at the end of `file`, new or not, the script must fail and say `expected`.
function(expect_offence file text expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  foreach(folder IN ITEMS src test)
    file(COPY "${ROOT}/${folder}/" DESTINATION "${SCRATCH}/${folder}")
  endforeach()
  file(APPEND "${SCRATCH}/${file}" "${text}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/untested.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "${file} was not found to say \"${expected}\":\n${output}")
  endif()
endfunction()

set(list test/unit/untested.txt)
expect_offence(src/core/model/fuge_planted.f90 "!\n"
  "src/core/model/fuge_planted.f90 has no test/unit/core/model/test_planted.pf and no line in test/unit/untested.txt\n")
expect_offence(src/f77/planted.f90 "!\n" "src/f77/planted.f90 has no test/unit/f77/test_planted.pf and no line")
expect_offence(src/sparse/fuge_planted.f90 "!\n" "src/sparse/fuge_planted.f90 has no test/unit/sparse/test_planted.pf")
# A test in the wrong folder counts for no module.
expect_offence(test/unit/files/text/test_certificate.pf "!\n"
  "test/unit/files/text/test_certificate.pf is named for a module that does not exist in its folder\n")
expect_offence(${list} "fuge_certificate: old\n"
  "untested.txt names fuge_certificate, which has test/unit/core/model/test_certificate.pf\n")
expect_offence(${list} "fuge_planted: gone\n" "untested.txt names fuge_planted, which does not exist\n")
expect_offence(${list} "fuge_c_dense: again\n" "untested.txt names fuge_c_dense twice\n")
expect_offence(${list} "fuge_planted:\n" "untested.txt gives no reason for fuge_planted\n")
expect_offence(${list} "fuge_planted\n" "untested.txt: not `module: reason`: fuge_planted\n")
expect_offence(${list} "fuge_planted: test/api/core/dense.c and test/api/planted.c\n"
  "untested.txt names test/api/planted.c for fuge_planted, which does not exist\n")
