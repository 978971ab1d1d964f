!> What nearly every test needs: pFUnit, kinds of numbers, infinity and NaN, statuses with their report, numbers in
!> messages, and expectations of several values at once.
module testing
  use, intrinsic :: iso_fortran_env, only: int64
  use expectations, only: unexpected
  use funit
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_CALLBACK, FUGE_ERR_CALL_ORDER, FUGE_ERR_CANCELLED, &
    FUGE_ERR_DOF, FUGE_ERR_ELEMENT, FUGE_ERR_FILE, FUGE_ERR_GAP, FUGE_ERR_GRID, FUGE_ERR_ITERATION_LIMIT, &
    FUGE_ERR_LAW, FUGE_ERR_MEMORY, FUGE_ERR_MESH, FUGE_ERR_MODES, FUGE_ERR_MODULUS, FUGE_ERR_NOT_DEFINITE, &
    FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_NO_EQUILIBRIUM, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW, &
    FUGE_ERR_POINTER, FUGE_ERR_SIZE, FUGE_ERR_UNSUPPORTED, FUGE_ERR_WIDTH, FUGE_WARN_ACCURACY, FUGE_WARN_CASES, &
    FUGE_WARN_ILL_CONDITIONED, FUGE_WARN_KINK, FUGE_WARN_NOT_PROVED, FUGE_WARN_NOT_UNIQUE, FUGE_WARN_NO_CONTACT, &
    FUGE_WARN_PAIRS, FUGE_WARN_RESIDUAL, FUGE_WARN_UNREACHABLE
  use special_numbers, only: infinity, nan
  implicit none
  public

end module testing
