# status_texts.cmake has to find each of these changes: cmake -D ROOT=... -D SCRATCH=... -P status_texts_errors.cmake
cmake_minimum_required(VERSION 3.20)

# Replace `old` by `new` in a copy of `file`; the script must fail and say `expected`.
function(expect_error file old new expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  foreach(each IN ITEMS include/fuge_core.h doc/errors.md doc/man/fuge.3 src/core/base/fuge_status.f90)
    configure_file("${ROOT}/${each}" "${SCRATCH}/${each}" COPYONLY)
  endforeach()
  file(READ "${ROOT}/${file}" text)
  string(REPLACE "${old}" "${new}" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "${file} does not contain \"${old}\"")
  endif()
  file(WRITE "${SCRATCH}/${file}" "${changed}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/status_texts.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "\"${old}\" changed to \"${new}\" in ${file} was not found:\n${output}")
  endif()
endfunction()

expect_error(src/core/base/fuge_status.f90 "'unknown element'" "'unknown cell'"
  "doc/errors.md lacks: ### FUGE_ERR_ELEMENT .-6.")
expect_error(src/core/base/fuge_status.f90 "'unknown element'" "'unknown cell'" "fuge.3 lacks: .BR FUGE_ERR_ELEMENT")
expect_error(src/core/base/fuge_status.f90 "'unknown element'" "'unknown cell'"
  "fuge_core.h says of FUGE_ERR_ELEMENT = -6")
expect_error(src/core/base/fuge_status.f90 "    'unknown element', &\n" "" "35 codes, 34 texts")
expect_error(doc/errors.md "FUGE_ERR_WIDTH (-4)" "FUGE_ERR_WIDTH (-5)" "doc/errors.md lacks: ### FUGE_ERR_WIDTH .-4.")
expect_error(doc/errors.md "### FUGE_DONE" "### FUGE_NEW (6)\n\n*new*\n\n### FUGE_DONE" "36 headings for 35 codes")
expect_error(doc/man/fuge.3 "FUGE_ERR_WIDTH \" (\\-4)\"" "FUGE_ERR_WIDTH \" (\\-5)\""
  "fuge.3 lacks: .BR FUGE_ERR_WIDTH")
expect_error(doc/man/fuge.3 ".TP\n.BR FUGE_DONE" ".TP\n.BR FUGE_FINE \" (0)\"\ndone\n.TP\n.BR FUGE_DONE"
  "36 items for 35")
expect_error(include/fuge_core.h "/* done, but the residual is above" "/* the residual is above"
  "of FUGE_WARN_RESIDUAL = 1")
expect_error(include/fuge_core.h "FUGE_ERR_WIDTH = -4" "FUGE_ERR_WIDTH = -5" "of FUGE_ERR_WIDTH = -4 \"\"")
