# facade.cmake has to find each of these offences: cmake -D ROOT=. -D SCRATCH=.. -P facade_offences.cmake
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")
file(COPY "${ROOT}/test/unit/topics/test_facade.pf" DESTINATION "${SCRATCH}/test/unit/topics")

plant(test/unit/core/base/test_planted.pf "  use fuge, dp => fuge_dp\n"
  "test/unit/core/base/test_planted.pf uses fuge\n")
plant(test/support/planted.f90 "  use fuge\n" "test/support/planted.f90 uses fuge\n")
plant(test/hard/planted.f90 "    use :: fuge ! all\n" "test/hard/planted.f90 uses fuge\n")
expect_offences(facade.cmake -DROOT=${SCRATCH})
