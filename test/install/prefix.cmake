# Install a build into a scratch prefix, which is not the configured one.
# cmake -DBUILD_DIR=.. -DCONFIG=.. -DPREFIX=.. [-DSOURCE_DIR=.. -DSETTINGS=.. -DBUILT=.. -DMAKE_PROGRAM=..]
#   -P prefix.cmake
# With SOURCE_DIR the build is made first.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

if(SOURCE_DIR)
  prepare_compiling()
  run("configure" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${BUILD_DIR}" ${SETTINGS})
  run("build" ${compiling} "${CMAKE_COMMAND}" --build "${BUILD_DIR}" --config "${CONFIG}" --parallel 2)
endif()
file(REMOVE_RECURSE "${PREFIX}")
run("install" "${CMAKE_COMMAND}" -E env --unset=DESTDIR
  "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${PREFIX}")
