# take_built.sh takes an object only where the compiler would make the same: not with other flags, with another module
# in use, from an older build, or for a source that the build does not have.
# ctest sets SCRATCH.
cmake_minimum_required(VERSION 3.20)

# expect(what who VARIABLE=value ..): `who`, the build or the compiler, gives the object of b.f90, whose modules in use
# are those in the folder `modules`.
function(expect what who)
  file(WRITE "${SCRATCH}/here/b.o" "")
  execute_process(WORKING_DIRECTORY "${SCRATCH}/here" RESULT_VARIABLE status
    COMMAND "${CMAKE_COMMAND}" -E env "BUILT=${SCRATCH}/built" "SOURCE_DIR=${SCRATCH}/source" "FLAGS= -O3" ${ARGN}
      "${CMAKE_CURRENT_LIST_DIR}/take_built.sh" "${SCRATCH}/compiler" -O3 -fPIC -Werror -Jmodules -I "${SCRATCH}"
      -c ../source/src/base/b.f90 -o b.o)
  file(READ "${SCRATCH}/here/b.o" object)
  if(status OR NOT object STREQUAL "of the ${who}\n")
    message(SEND_ERROR "${what}: the object is '${object}', not that of the ${who}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
file(WRITE "${SCRATCH}/source/src/base/b.f90"
  "module b\n  use, intrinsic :: iso_c_binding, only: c_int\n  use a, only: x\nend module b\n")
file(WRITE "${SCRATCH}/compiler" "#!/bin/sh\necho 'of the compiler' > b.o\n")
file(CHMOD "${SCRATCH}/compiler" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
file(WRITE "${SCRATCH}/here/modules/a.mod" "a")
file(WRITE "${SCRATCH}/built/modules/a.mod" "a")
file(WRITE "${SCRATCH}/built/modules/b.mod" "b")
execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 1)
file(WRITE "${SCRATCH}/built/src/CMakeFiles/fuge.dir/base/b.f90.o" "of the build\n")

expect("all the same" build)
file(READ "${SCRATCH}/here/modules/b.mod" module)
if(NOT module STREQUAL "b")
  message(SEND_ERROR "the module is '${module}', not that of the build")
endif()
expect("other flags" compiler "FLAGS= -O2")
expect("no build" compiler BUILT=)
expect("a source that is not there" compiler "SOURCE_DIR=${SCRATCH}/none")
file(WRITE "${SCRATCH}/here/modules/a.mod" "another a")
expect("another module in use" compiler)
file(REMOVE "${SCRATCH}/here/modules/a.mod")
expect("a module in use that is missing" compiler)
file(WRITE "${SCRATCH}/here/modules/a.mod" "a")
file(REMOVE "${SCRATCH}/built/modules/b.mod")
expect("a module that the build lacks" compiler)
file(WRITE "${SCRATCH}/built/modules/b.mod" "b")
expect("all the same again" build)
execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 1)
file(TOUCH "${SCRATCH}/source/src/base/b.f90")
expect("a newer source" compiler)
