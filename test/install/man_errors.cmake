# man.cmake has to find each of these changes of the page.
cmake_minimum_required(VERSION 3.20)

# Replace `old` by `new` in a copy of the page; the script must fail and name `expected`.
function(expect_error old new expected)
  file(READ "${PAGE}" text)
  string(REPLACE "${old}" "${new}" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "the page does not contain \"${old}\"")
  endif()
  file(WRITE "${SCRATCH}/fuge.3" "${changed}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -DPAGE=${SCRATCH}/fuge.3 -DINCLUDE_DIR=${INCLUDE_DIR} -DGROFF=${GROFF}
      -P "${CMAKE_CURRENT_LIST_DIR}/man.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "\"${old}\" changed to \"${new}\" was not found:\n${output}")
  endif()
endfunction()

expect_error("fuge_contact_edges (" "fuge_find_edges (" "not in the headers: fuge_find_edges")
expect_error("\"fuge 0." "\"fuge 9." "the page is not that of")
if(GROFF)
  expect_error(".SH RETURN VALUE" ".XX RETURN VALUE" "groff")
endif()
