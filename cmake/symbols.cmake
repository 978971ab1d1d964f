# fuge_limit_symbols(target): a shared library exports its interface and nothing else.
#
# These are the C names, the modules (gfortran: __fuge_.., flang: _QMfuge..) with the tables of procedures and
# the default values of their types, and the documented external names. A linker without version scripts exports
# everything.
include(CheckLinkerFlag)

set(FUGE_SYMBOLS "fuge_*" "__fuge_*" "_QMfuge*")
if(EXISTS "${PROJECT_SOURCE_DIR}/cmake/external_names.txt")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cmake/external_names.txt)
  file(STRINGS cmake/external_names.txt external_names REGEX "^[a-z]")
  # gfortran and flang append an underscore to the name of an external procedure.
  list(TRANSFORM external_names APPEND "_")
  list(APPEND FUGE_SYMBOLS ${external_names})
endif()

set(fuge_version_script "${PROJECT_BINARY_DIR}/symbols.map")
list(JOIN FUGE_SYMBOLS ";\n    " global_symbols)
file(CONFIGURE OUTPUT "${fuge_version_script}"
  CONTENT "{\n  global:\n    @global_symbols@;\n  local:\n    *;\n};\n" @ONLY)
# Not as LINKER:.., which CMake 3.25 does not translate for flang.
check_linker_flag(Fortran "-Wl,--version-script=${fuge_version_script}" FUGE_HAS_VERSION_SCRIPT)

function(fuge_limit_symbols target)
  set_target_properties(${target} PROPERTIES C_VISIBILITY_PRESET hidden)
  # gfortran inlines no procedure of a submodule in position-independent code without this, because a program might
  # replace it: every small function there is a call.
  target_compile_options(${target} PRIVATE "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fno-semantic-interposition>")
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND FUGE_HAS_VERSION_SCRIPT)
    target_link_options(${target} PRIVATE "-Wl,--version-script=${fuge_version_script}")
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${fuge_version_script}")
  endif()
endfunction()
