# A wheel with a library that is there already, and an editable installation, each in an environment of its own:
# cmake -D BUILDER=python -D PYTHON=python -D SOURCE_DIR=.. -D LIBRARY_DIR=.. -D SCRATCH=.. -P wheel.cmake
# BUILDER has pip and scikit-build-core, PYTHON has numpy and scipy. No network is needed.
cmake_minimum_required(VERSION 3.20)

# Arguments without a semicolon.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} ended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
run("${BUILDER}" -m pip wheel --quiet --disable-pip-version-check --no-index --no-deps --no-build-isolation
  --wheel-dir "${SCRATCH}" --config-settings "build-dir=${SCRATCH}/build"
  --config-settings "cmake.define.FUGE_LIBRARY_DIR=${LIBRARY_DIR}" "${SOURCE_DIR}")
file(GLOB wheels "${SCRATCH}/*.whl")
list(LENGTH wheels count)
if(NOT count EQUAL 1 OR NOT wheels MATCHES "/fuge-[0-9.]+-py3-none-[^/]*[.]whl$")
  message(FATAL_ERROR "not one wheel for all versions of Python 3: ${wheels}")
endif()

set(ENV{PYTHONDONTWRITEBYTECODE} 1)
unset(ENV{FUGE_LIBRARY_DIR})
unset(ENV{PYTHONPATH})

# install(name wheel): into the environment `name`, which sees numpy and scipy where PYTHON has numpy.
function(install name wheel)
  run("${PYTHON}" -m venv --without-pip "${SCRATCH}/${name}")
  set(venv_python "${SCRATCH}/${name}/bin/python")
  run("${BUILDER}" -m pip --quiet --disable-pip-version-check --python "${venv_python}" install --no-index --no-deps
    "${wheel}")
  run("${venv_python}" -c "print(__import__('sysconfig').get_path('purelib'))")
  string(STRIP "${output}" site)
  run("${PYTHON}" -c "print(__import__('pathlib').Path(__import__('numpy').__file__).parents[1])")
  file(WRITE "${site}/numpy.pth" "${output}")
  set(venv_python "${venv_python}" PARENT_SCOPE)
endfunction()

# The Python files of the sources, with the library and the headers of the installation.
run("${BUILDER}" -c "
import os
from scikit_build_core.build import build_editable
os.chdir('${SOURCE_DIR}')
settings = {'build-dir': '${SCRATCH}/build_editable', 'cmake.define.FUGE_LIBRARY_DIR': '${LIBRARY_DIR}'}
build_editable('${SCRATCH}/wheel_editable', settings)")
file(GLOB editable "${SCRATCH}/wheel_editable/*.whl")
install(editable "${editable}")
run("${venv_python}" -c "
from fuge._library import HEADERS, __file__, _path
print(__file__, _path('fuge'), HEADERS.paths[0])")
if(NOT output MATCHES "^${SOURCE_DIR}/[^ ]* ${SCRATCH}/editable/[^ ]* ${SCRATCH}/editable/")
  message(FATAL_ERROR "the editable installation uses ${output}")
endif()

install(venv "${wheels}")
run("${venv_python}" -c "print(__import__('fuge').__file__)")
if(NOT output MATCHES "^${SCRATCH}/venv/")
  message(FATAL_ERROR "fuge is that of ${output}")
endif()
execute_process(COMMAND "${venv_python}" -m unittest test_headers test_solver test_operators
  WORKING_DIRECTORY "${SOURCE_DIR}/python/tests" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "its tests fail:\n${output}")
endif()
