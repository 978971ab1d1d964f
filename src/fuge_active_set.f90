!> The fast engine for a dense matrix: block principal pivoting, with a way down the
!> energy where that does not get on.
!>
!> Solve the equations of a guessed contact set, let every point that violates a sign
!> change sides, repeat (J. J. Judice, F. M. Pires, Computers & Operations Research
!> 21, 1994). When the number of violations has not fallen for a while, go on with
!> pushing forces only, one point joining at a time: the primal active set method
!> (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23), in
!> which the energy falls with every point that joins, so that it ends.
module fuge_active_set
  use fuge_contact_factor, only: contact_factor
  use fuge_kinds, only: dp
  use fuge_monitor_type, only: fuge_monitor, tell_monitor
  use fuge_set_answer, only: solve_set, refine, add_deflection, violations, terms_of, largest_term, &
    motion_at_shallowest
  use fuge_step_back, only: step_back
  use fuge_status, only: FUGE_DONE, FUGE_ERR_ITERATION_LIMIT
  implicit none
  private

  public :: run_active_set, keep_first

  !> Violations below this part of the largest force, or of a length, are rounding.
  real(dp), parameter :: SIGN_TOLERANCE = 1.0e-14_dp
  !> Block changes without progress before single ones.
  integer, parameter, public :: PATIENCE = 3
  !> Violations below this part that are left after single changes are rounding too; a
  !> large spread of the pivots raises it.
  real(dp), parameter :: NOISE = 1.0e-11_dp
  real(dp), parameter :: NOISE_GROWTH = 1.0e-8_dp
  !> Spread of the pivots above which signs are judged after refinement only.
  real(dp), parameter :: ILL_CONDITIONED = 1.0e8_dp

contains

  !> From a guess to the contact set, its forces and gaps.
  !>
  !> `alpha` (at least n rows, n columns), `gap` (n), `load` > 0, `datum` the coefficient
  !> of alpha nearest to zero; `contact` (n) the guess, then the set, never empty;
  !> `factor` is that of the set on return; out: `force` (n), `gap_out` (n), `approach`.
  !> `iterations` counts the sets tried; `monitor` hears of each.
  !> Errors: FUGE_ERR_MEMORY, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT,
  !> FUGE_ERR_CANCELLED.
  subroutine run_active_set(alpha, datum, gap, load, limit, monitor, factor, contact, force, gap_out, approach, &
                            iterations, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, gap(:), load
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    logical, intent(inout) :: contact(:)
    real(dp), intent(out) :: force(:), gap_out(:), approach
    integer, intent(out) :: iterations, status
    real(dp) :: shape(size(gap)), terms(size(gap)), violation(size(gap)), motion, base
    logical :: wrong(size(gap)), careful, fresh
    integer :: fewest, patience_left

    base = minval(gap)
    shape = gap - base
    fewest = huge(fewest)
    patience_left = PATIENCE
    iterations = 0
    careful = .false.
    fresh = .true.
    do
      call factor%set(alpha, contact, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, shape, load, force, motion)
      careful = careful .or. factor%spread > ILL_CONDITIONED .or. factor%ridge > 0.0_dp
      if (careful) then
        ! Gaps are counted from where the bodies meet: one point far below the others
        ! would cost them digits.
        base = gap(minloc(abs(shape - motion), dim=1))
        shape = gap - base
        call solve_set(factor, datum, shape, load, force, motion)
        call refine(alpha, datum, shape, load, factor, factor%ridge, contact, force, motion)
      end if
      gap_out = shape - motion
      call add_deflection(alpha, datum, contact, force, gap_out)
      if (careful) then
        terms = terms_of(alpha, datum, contact, force)
      else
        terms = largest_term(alpha, datum, force)
      end if
      violation = violations(shape - motion, terms, contact, force, gap_out)
      if (fresh) then
        iterations = iterations + 1
        call tell_monitor(monitor, iterations, maxval(violation), count(contact), status)
        if (status /= FUGE_DONE) return
        fresh = .false.
      end if
      wrong = violation > SIGN_TOLERANCE
      if (.not. any(wrong)) then
        if (careful) exit
        ! Once more with care, before the set is believed.
        careful = .true.
        cycle
      end if
      ! What single changes have left is rounding; the certificate has the last word.
      if (patience_left < 0 .and. maxval(violation) < NOISE*max(1.0_dp, NOISE_GROWTH*factor%spread)) exit
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
      patience_left = patience_left - 1
      if (count(wrong) < fewest .and. patience_left >= 0) patience_left = PATIENCE
      fewest = min(fewest, count(wrong))
      careful = patience_left < PATIENCE
      if (patience_left < 0) then
        call descend(alpha, datum, shape, load, limit, monitor, factor, contact, force, iterations, status)
        if (status /= FUGE_DONE) return
      else
        contact = contact .neqv. wrong
        fresh = .true.
      end if
    end do
    if (factor%ridge > 0.0_dp) call refine(alpha, datum, shape, load, factor, 0.0_dp, contact, force, motion)
    force = max(force, 0.0_dp)
    motion = motion_at_shallowest(alpha, datum, shape, contact, force, motion)
    gap_out = shape - motion
    call add_deflection(alpha, datum, contact, force, gap_out)
    gap_out = max(gap_out, 0.0_dp)
    where (contact) gap_out = 0.0_dp
    approach = (motion + datum*load) + base
  end subroutine run_active_set

  !> Down the energy: from pushing forces towards the answer of their set as far as no
  !> force pulls, then the point with the most negative gap joins, until none has one.
  !> `force` (n) in: where to start; `contact` and `factor` out.
  subroutine descend(alpha, datum, shape, load, limit, monitor, factor, contact, force, iterations, status)
    real(dp), intent(in), contiguous :: alpha(:, :)
    real(dp), intent(in) :: datum, shape(:), load
    integer, intent(in) :: limit
    class(fuge_monitor), intent(inout) :: monitor
    type(contact_factor), intent(inout) :: factor
    logical, intent(inout) :: contact(:)
    real(dp), intent(inout) :: force(:)
    integer, intent(inout) :: iterations
    integer, intent(out) :: status
    real(dp) :: wanted(size(shape)), gap_out(size(shape)), terms(size(shape)), violation(size(shape)), motion
    logical :: barred(size(shape)), wrong(size(shape))
    integer :: newest

    force = max(force, 0.0_dp)
    force = force*(load/sum(force))
    contact = force > 0.0_dp
    barred = .false.
    newest = 0
    do
      call factor%set(alpha, contact, status)
      if (status /= FUGE_DONE) return
      call solve_set(factor, datum, shape, load, wanted, motion)
      call refine(alpha, datum, shape, load, factor, factor%ridge, contact, wanted, motion)
      iterations = iterations + 1
      if (any(contact .and. wanted <= 0.0_dp)) then
        call tell_monitor(monitor, iterations, maxval(max(-wanted, 0.0_dp))/maxval(abs(wanted)), count(contact), &
                          status)
        if (status /= FUGE_DONE) return
        call step_back(wanted, contact, force, newest, barred)
      else
        force = wanted
        if (newest > 0) barred = barred .and. barred(newest)
        gap_out = shape - motion
        call add_deflection(alpha, datum, contact, force, gap_out)
        terms = terms_of(alpha, datum, contact, force)
        violation = violations(shape - motion, terms, contact, force, gap_out)
        call tell_monitor(monitor, iterations, maxval(violation), count(contact), status)
        if (status /= FUGE_DONE) return
        wrong = violation > SIGN_TOLERANCE .and. .not. barred
        if (.not. any(wrong)) return
        newest = minloc(gap_out, dim=1, mask=wrong)
        contact(newest) = .true.
      end if
      if (iterations >= limit) then
        status = FUGE_ERR_ITERATION_LIMIT
        return
      end if
    end do
  end subroutine descend

  !> Only the true element of least index stays true.
  pure subroutine keep_first(mask)
    logical, intent(inout) :: mask(:)
    integer :: k

    do k = 1, size(mask)
      if (.not. mask(k)) cycle
      mask(k + 1:) = .false.
      return
    end do
  end subroutine keep_first

end module fuge_active_set
