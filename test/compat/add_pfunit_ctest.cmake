# The stand-in's add_pfunit_ctest: the call is that of pFUnit, arguments outside the
# subset of README.md are refused.

# fuge_compat_add_program(<name> <a.pf>...): the test program, without a ctest.
function(fuge_compat_add_program name)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/fuge_compat/${name}")
  set(names "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exported_names.txt")
  set(sources)
  set(FUGE_COMPAT_USES)
  set(FUGE_COMPAT_CALLS)
  foreach(pf IN LISTS ARGN)
    get_filename_component(pf "${pf}" ABSOLUTE)
    get_filename_component(module "${pf}" NAME_WE)
    if(NOT pf MATCHES "\\.pf$")
      message(FATAL_ERROR "add_pfunit_ctest(${name}): ${pf} is not a .pf file")
    endif()
    list(LENGTH sources number)
    set(source "${generated}/${module}.F90")
    add_custom_command(
      OUTPUT "${source}"
      COMMAND fuge_compat_translate "${pf}" "${source}" "${names}"
      DEPENDS "${pf}" "${names}" fuge_compat_translate
      COMMENT "Translating ${module}.pf"
      VERBATIM)
    list(APPEND sources "${source}")
    string(APPEND FUGE_COMPAT_USES
      "    use ${module}, only: run_${number} => fuge_compat_run\n")
    string(APPEND FUGE_COMPAT_CALLS "    call run_${number}()\n")
  endforeach()
  configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/driver.f90.in" "${generated}/driver.f90" @ONLY)

  add_executable(${name} ${sources} "${generated}/driver.f90")
  # Modules of the same name in two test programs must not meet.
  set_target_properties(${name} PROPERTIES Fortran_MODULE_DIRECTORY "${generated}/modules")
  target_include_directories(${name} PRIVATE "${generated}/modules" "${CMAKE_CURRENT_SOURCE_DIR}")
  target_link_libraries(${name} fuge_compat_funit)
endfunction()

# add_pfunit_ctest(<name> TEST_SOURCES <a.pf>... [OTHER_SOURCES <file>...]
#                  [LINK_LIBRARIES <library>...] [LABELS <label>...])
function(add_pfunit_ctest name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "TEST_SOURCES;OTHER_SOURCES;LINK_LIBRARIES;LABELS")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "add_pfunit_ctest(${name}): cannot use: "
      "${arg_UNPARSED_ARGUMENTS} ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_TEST_SOURCES)
    message(FATAL_ERROR "add_pfunit_ctest(${name}): no TEST_SOURCES")
  endif()
  fuge_compat_add_program(${name} ${arg_TEST_SOURCES})
  if(arg_OTHER_SOURCES)
    target_sources(${name} PRIVATE ${arg_OTHER_SOURCES})
  endif()
  if(arg_LINK_LIBRARIES)
    # Without a keyword, as pFUnit does it: callers may then add more in the same way.
    target_link_libraries(${name} ${arg_LINK_LIBRARIES})
  endif()
  add_test(NAME ${name} COMMAND ${name})
  if(arg_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}")
  endif()
endfunction()
