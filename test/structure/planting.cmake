# How the tests of this folder plant offences: all in one copy of the sources, in SCRATCH, so each has files
# and rows of its own. Then the script must say what each of them is.
file(REMOVE_RECURSE "${SCRATCH}")
set(expected)

# With `text` at the end of a file, new or not, the script must say what follows.
function(plant file text)
  file(APPEND "${SCRATCH}/${file}" "${text}")
  set(expected ${expected} ${ARGN} PARENT_SCOPE)
endfunction()

# The same with the line `new` instead of `old`.
function(plant_instead file old new)
  file(READ "${SCRATCH}/${file}" text)
  string(REPLACE "\n${old}\n" "\n${new}\n" planted "${text}")
  if(planted STREQUAL text)
    message(SEND_ERROR "${file} has no line \"${old}\"")
  endif()
  file(WRITE "${SCRATCH}/${file}" "${planted}")
  set(expected ${expected} ${ARGN} PARENT_SCOPE)
endfunction()

# Run a script, with these options, on the copy: it must fail and say all that is expected.
function(expect_offences script)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" ${ARGN} -P "${CMAKE_CURRENT_LIST_DIR}/${script}"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0)
    message(SEND_ERROR "${script} has not failed")
  endif()
  foreach(text IN LISTS expected)
    if(NOT output MATCHES "${text}")
      message(SEND_ERROR "${script} does not say \"${text}\":\n${output}")
    endif()
  endforeach()
  list(LENGTH expected count)
  message(STATUS "${count} offences are found")
endfunction()
