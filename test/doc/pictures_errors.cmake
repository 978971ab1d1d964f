# pictures.cmake has to find each of these errors: cmake -D ROOT=.. -D SCRATCH=.. -P pictures_errors.cmake
cmake_minimum_required(VERSION 3.20)

file(REMOVE_RECURSE "${SCRATCH}")
file(GLOB pages "${ROOT}/*.md")
file(COPY ${pages} DESTINATION "${SCRATCH}")
file(COPY "${ROOT}/doc" DESTINATION "${SCRATCH}")
file(COPY "${ROOT}/examples/plots" DESTINATION "${SCRATCH}/examples")
file(COPY "${ROOT}/examples/calculix/pictures.py" DESTINATION "${SCRATCH}/examples/calculix")
file(GLOB plots "${ROOT}/bench/*.gp")
file(COPY ${plots} DESTINATION "${SCRATCH}/bench")

function(expect what expected)
  execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/pictures.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  string(FIND "${output}" "pictures: ${expected} " place)
  if(status EQUAL 0 OR place EQUAL -1)
    message(SEND_ERROR "${what} was not found:\n${output}")
  endif()
endfunction()

# With what matches `pattern` replaced by `new` in a file, the script must fail and say `expected` alone.
function(expect_error file pattern new expected)
  file(READ "${SCRATCH}/${file}" text)
  string(REGEX REPLACE "${pattern}" "${new}" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "${file} does not match \"${pattern}\"")
  endif()
  file(WRITE "${SCRATCH}/${file}" "${changed}")
  expect("\"${pattern}\" changed to \"${new}\" in ${file}" "${expected}")
  file(WRITE "${SCRATCH}/${file}" "${text}")
endfunction()

expect_error(doc/errata.md "!\\[[^]\n]*\\]\\(disc.png\\)" "![Two gaps](disc.png)"
  "doc/errata.md shows disc.png with fewer than five words of alternative text")
expect_error(doc/errata.md "\\(disc.png\\)\n\n[^#]*\n\n## " "(disc.png)\n\n## "
  "doc/errata.md has no sentence below disc.png")
expect_error(doc/errata.md "!(\\[[^]\n]*\\]\\(disc.png\\))" "\\1" "no page shows doc/disc.png")
expect_error(doc/errata.md "\\(disc.png\\)" "(disk.png)"
  "doc/errata.md shows disk.png, which is not there no page shows doc/disc.png")
expect_error(examples/plots/disc.gp "eval picture\\(\"disc\"" "eval picture(\"disk\""
  "no script makes doc/disc.png examples/plots/disc.gp does not begin disc.png by picture() of style.gp")
expect_error(examples/calculix/pictures.py "doc/calculix_two_bodies[.]png" "a picture"
  "no script makes doc/calculix_two_bodies.png")
expect_error(doc/conventions.svg "drawn by hand" "" "no script makes doc/conventions.svg")
file(WRITE "${SCRATCH}/doc/unlinked.csv" "1\n")
expect("A table" "no page links doc/unlinked.csv")
