# fuge_set_warnings(target): Fortran 2008 and C99 without a warning.
function(fuge_set_warnings target)
  set(gnu_fortran -std=f2008 -Wall -Wextra -pedantic -Wimplicit-interface -fimplicit-none)
  set(gnu_c -Wall -Wextra -pedantic)
  set(is_gnu_fortran "$<COMPILE_LANG_AND_ID:Fortran,GNU>")
  set(is_flang "$<COMPILE_LANG_AND_ID:Fortran,LLVMFlang>")
  set(is_c "$<COMPILE_LANG_AND_ID:C,GNU,Clang,AppleClang>")
  set(is_cxx "$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>")
  target_compile_options(${target} PRIVATE
    "$<${is_gnu_fortran}:${gnu_fortran}>" "$<${is_flang}:-pedantic>"
    "$<${is_c}:${gnu_c}>" "$<${is_cxx}:${gnu_c}>")
  if(FUGE_WERROR)
    target_compile_options(${target} PRIVATE
      "$<${is_gnu_fortran}:-Werror>" "$<${is_flang}:-Werror>" "$<${is_c}:-Werror>" "$<${is_cxx}:-Werror>")
  endif()
endfunction()

# fuge_limit_frames(target): no procedure takes more than 16 kB of the stack, because threads may have 128 kB of it, as
# those of musl have by default. Sanitizers make frames larger.
function(fuge_limit_frames target)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" configuration)
  if(FUGE_WERROR AND NOT "${CMAKE_Fortran_FLAGS} ${CMAKE_Fortran_FLAGS_${configuration}}" MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE
      "$<$<OR:$<COMPILE_LANG_AND_ID:Fortran,GNU>,$<COMPILE_LANG_AND_ID:C,GNU>>:-Wframe-larger-than=16384>")
  endif()
endfunction()

# fuge_set_legacy_warnings(target): FORTRAN 77 in fixed form, without interfaces.
function(fuge_set_legacy_warnings target)
  set(is_gnu_fortran "$<COMPILE_LANG_AND_ID:Fortran,GNU>")
  set(is_flang "$<COMPILE_LANG_AND_ID:Fortran,LLVMFlang>")
  target_compile_options(${target} PRIVATE "$<${is_gnu_fortran}:-std=legacy;-Wall;-Wextra>")
  if(FUGE_WERROR)
    target_compile_options(${target} PRIVATE "$<${is_gnu_fortran}:-Werror>" "$<${is_flang}:-Werror>")
  endif()
endfunction()
