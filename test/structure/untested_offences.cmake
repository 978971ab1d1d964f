# untested.cmake has to find each of these offences: cmake -D ROOT=. -D SCRATCH=.. -P untested_offences.cmake
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")
foreach(folder IN ITEMS src test)
  file(COPY "${ROOT}/${folder}/" DESTINATION "${SCRATCH}/${folder}")
endforeach()

plant(src/core/problem/fuge_planted.f90 "!\n"
  "src/core/problem/fuge_planted.f90 has no test/unit/core/problem/test_planted.pf and no line in \
test/unit/untested.txt\n")
plant(src/f77/planted.f90 "!\n" "src/f77/planted.f90 has no test/unit/f77/test_planted.pf and no line")
plant(src/sparse/fuge_planted.f90 "!\n" "src/sparse/fuge_planted.f90 has no test/unit/sparse/test_planted.pf")
# A test in the wrong folder counts for no module.
plant(test/unit/files/text/test_certificate.pf "!\n"
  "test/unit/files/text/test_certificate.pf is named for a module that does not exist in its folder\n")
set(list test/unit/untested.txt)
plant(${list} "fuge_certificate: old\n"
  "untested.txt names fuge_certificate, which has test/unit/core/problem/certificate/test_certificate.pf\n")
plant(${list} "fuge_gone: gone\n" "untested.txt names fuge_gone, which does not exist\n")
plant(${list} "fuge_c_path: again\n" "untested.txt names fuge_c_path twice\n")
plant(${list} "fuge_silent:\n" "untested.txt gives no reason for fuge_silent\n")
plant(${list} "fuge_bare\n" "untested.txt: not `module: reason`: fuge_bare\n")
plant(${list} "fuge_elsewhere: test/api/core/dense.c and test/api/planted.c\n"
  "untested.txt names test/api/planted.c for fuge_elsewhere, which does not exist\n")
expect_offences(untested.cmake -DROOT=${SCRATCH})
