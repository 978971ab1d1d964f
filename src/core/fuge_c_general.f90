!> C bindings, sections "status" and "options and report": version, status texts, default options.
module fuge_c_general
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char, c_ptr, c_loc, c_associated, c_f_pointer
  use fuge_c_types, only: c_options
  use fuge_options_type, only: fuge_options
  use fuge_status, only: LOWEST_STATUS, HIGHEST_STATUS, STATUS_MEANINGS
  use fuge_version_number, only: FUGE_VERSION
  implicit none
  private

  integer :: k
  ! C gets pointers to these; never changed, though no parameter, which can have no address.
  character(kind=c_char, len=72), target :: meanings(LOWEST_STATUS:HIGHEST_STATUS + 1) = &
    [character(len=72) :: (trim(STATUS_MEANINGS(k))//c_null_char, k=LOWEST_STATUS, HIGHEST_STATUS), &
     'unknown status'//c_null_char]
  character(kind=c_char, len=16), target :: version = FUGE_VERSION//c_null_char

contains

  function c_version() bind(c, name='fuge_version') result(string)
    type(c_ptr) :: string

    string = c_loc(version(1:1))
  end function c_version

  function c_status_text(status) bind(c, name='fuge_status_text') result(string)
    integer(c_int), intent(in), value :: status
    type(c_ptr) :: string

    if (status < LOWEST_STATUS .or. status > HIGHEST_STATUS) then
      string = c_loc(meanings(HIGHEST_STATUS + 1)(1:1))
    else
      string = c_loc(meanings(status)(1:1))
    end if
  end function c_status_text

  !> The defaults of `fuge_options`; NULL is left alone.
  subroutine c_default_options(destination) bind(c, name='fuge_default_options')
    type(c_ptr), intent(in), value :: destination
    type(c_options), pointer :: options
    type(fuge_options) :: defaults

    if (.not. c_associated(destination)) return
    call c_f_pointer(destination, options)
    options%method = int(defaults%method, c_int)
    options%pivot_rule = int(defaults%pivot_rule, c_int)
    options%max_iterations = int(defaults%max_iterations, c_int)
    options%keep_history = merge(1_c_int, 0_c_int, defaults%keep_history)
    options%threads = int(defaults%threads, c_int)
    options%tolerance = defaults%tolerance
    options%reserved_int = 0
    options%reserved = 0
  end subroutine c_default_options

end module fuge_c_general
