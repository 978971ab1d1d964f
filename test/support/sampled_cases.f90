!> Which of many alike cases a test tries.
module sampled_cases
  implicit none
  private

  public :: is_sampled

contains

  !> Is case `number`, from 1, to be tried? All are; or every s-th, where the environment variable FUGE_SAMPLE is s, as
  !> `script/test` sets it to be quick.
  function is_sampled(number)
    integer, intent(in) :: number
    logical :: is_sampled
    character(len=8) :: value
    integer :: status, step

    call get_environment_variable('FUGE_SAMPLE', value, status=status)
    if (status == 0) read (value, *, iostat=status) step
    if (status /= 0) step = 1
    is_sampled = modulo(number, max(step, 1)) == 0
  end function is_sampled

end module sampled_cases
