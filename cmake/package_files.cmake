# The files of one Debian package, from an installation of the whole in STAGE: those whose paths match one of FILES and
# none of EXCEPT. PACKAGE, VERSION, MAINTAINER and SOURCE_DIR too are set by cmake/packages.cmake, CMAKE_INSTALL_PREFIX
# by CPack.
set(target "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")

function(matches_one result path)
  set(${result} FALSE PARENT_SCOPE)
  foreach(pattern IN LISTS ARGN)
    if(path MATCHES "${pattern}")
      set(${result} TRUE PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# As Debian wants it: without the time of day.
function(compress path)
  execute_process(COMMAND gzip -9nf "${path}" RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "gzip ${path} failed")
  endif()
endfunction()

file(GLOB_RECURSE paths RELATIVE "${STAGE}" "${STAGE}/*")
set(number 0)
foreach(path IN LISTS paths)
  matches_one(wanted "${path}" ${FILES})
  matches_one(taken "${path}" ${EXCEPT})
  if(NOT wanted OR taken)
    continue()
  endif()
  math(EXPR number "${number} + 1")
  get_filename_component(folder "${target}/${path}" DIRECTORY)
  file(COPY "${STAGE}/${path}" DESTINATION "${folder}")
  if(IS_SYMLINK "${target}/${path}")
    continue()
  endif()
  if(path MATCHES "^share/man/")
    compress("${target}/${path}")
  elseif(path MATCHES "^bin/|\\.so(\\.|$)")
    # The libraries are where the linker looks for them.
    file(RPATH_REMOVE FILE "${target}/${path}")
    if(path MATCHES "\\.so")
      file(CHMOD "${target}/${path}" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
    endif()
  endif()
endforeach()
if(number EQUAL 0)
  message(FATAL_ERROR "${PACKAGE}: no file of ${STAGE} matches ${FILES}")
endif()

set(documents "${target}/share/doc/${PACKAGE}")
file(READ "${SOURCE_DIR}/LICENSE" license)
string(REGEX REPLACE "^[^\n]*\n+Copyright \\(c\\) ([^\n]*)\n+" "" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" license "\n${license}")
string(STRIP "${license}" license)
file(STRINGS "${SOURCE_DIR}/LICENSE" owner REGEX "^Copyright")
string(REGEX REPLACE "^Copyright \\(c\\) " "" owner "${owner}")
file(WRITE "${documents}/copyright" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: fuge

Files: *
Copyright: ${owner}
License: BSD-3-Clause
Comment: ${LINKS}

License: BSD-3-Clause
 ${license}
")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${documents}/changelog" "fuge (${VERSION}) unstable; urgency=medium

  * Packages of version ${VERSION}, made by CPack.

 -- ${MAINTAINER}  ${date}
")
compress("${documents}/changelog")
