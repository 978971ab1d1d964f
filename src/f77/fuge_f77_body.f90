!> Shared by the external procedures for FORTRAN 77: an elastic body from plain arrays, its
!> condensation, and the recovery of its displacements by a new factorisation.
module fuge_f77_body
  use fuge_body_type, only: fuge_body, check_body
  use fuge_condensation, only: fuge_condense, fuge_condensed, condense_to_recover
  use fuge_contact_normals, only: add_contact_forces, point_displacement
  use fuge_f77_problem, only: check_modes
  use fuge_input_checks, only: check_finite
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_problem_type, only: fuge_solution
  use fuge_status, only: fuge_info, report, require_memory, FUGE_ERR_SIZE, FUGE_ERR_MEMORY, FUGE_ERR_OPTION, &
    FUGE_ERR_NO_EQUILIBRIUM
  use fuge_stiffness_band, only: fuge_band_stiffness
  use fuge_stiffness_type, only: fuge_stiffness
  implicit none
  private

  public :: check_body_sizes, set_body, condense_band, recover_band, copy_condensed

  !> Forces whose work in a rigid mode is below this fraction of its terms are in equilibrium.
  real(dp), parameter :: BALANCED = 1.0e-8_dp

contains

  !> Refuse impossible sizes: FUGE_ERR_SIZE, and FUGE_ERR_MODES for more rigid modes than points.
  pure subroutine check_body_sizes(nd, nfix, m, ldz, n, nw, info)
    integer, intent(in) :: nd, nfix, m, ldz, n, nw
    type(fuge_info), intent(inout) :: info

    if (nd < 1) then
      call report(info, FUGE_ERR_SIZE, 'ND = '//text(nd)//': at least one degree of freedom is needed')
    else if (nfix < 0 .or. nfix > nd) then
      call report(info, FUGE_ERR_SIZE, 'NFIX = '//text(nfix)//' of '//text(nd)//' degrees of freedom cannot be fixed')
    else if (n < 1 .or. nw < 1) then
      call report(info, FUGE_ERR_SIZE, 'N = '//text(n)//', NW = '//text(nw)//': at least one contact point with one ' &
                  //'degree of freedom is needed')
    else
      call check_modes(n, m, n, info)
      if (.not. info%failed() .and. m > 0 .and. ldz < nd) call report(info, FUGE_ERR_SIZE, 'LDZ = '//text(ldz) &
        //' is less than ND = '//text(nd))
    end if
  end subroutine check_body_sizes

  !> Set a body: fixed degrees of freedom `fixed` with displacements `displacement`, external load
  !> `load` (nd), rigid modes `rigid_modes` (ldz, m), contact points `dof` and `normal` (nw, n).
  !> Error: FUGE_ERR_MEMORY.
  pure subroutine set_body(fixed, displacement, load, rigid_modes, dof, normal, body, info)
    integer, intent(in) :: fixed(:), dof(:, :)
    real(dp), intent(in) :: displacement(:), load(:), rigid_modes(:, :), normal(:, :)
    type(fuge_body), intent(inout) :: body
    type(fuge_info), intent(inout) :: info
    integer :: m, stat

    m = size(rigid_modes, 2)
    allocate (body%fixed(size(fixed)), body%displacement(size(displacement)), body%load(size(load)), &
              body%dof(size(dof, 1), size(dof, 2)), body%normal(size(dof, 1), size(dof, 2)), stat=stat)
    if (stat == 0 .and. m > 0) allocate (body%rigid_modes(size(load), m), stat=stat)
    call require_memory(stat, 'a copy of supports, load, rigid modes and contact points', info)
    if (stat /= 0) return
    body%fixed = fixed
    body%displacement = displacement
    body%load = load
    body%dof = dof
    body%normal = normal
    if (m > 0) body%rigid_modes = rigid_modes(:size(load), :)
  end subroutine set_body

  !> Condense a body with the triangle `uplo` of its stiffness matrix in LAPACK's band storage, `band` (ldab, nd), with
  !> `kd` diagonals beside the main one. Errors as `set_band` and `fuge_condense`.
  subroutine condense_band(uplo, kd, band, body, condensed, info)
    character(len=1), intent(in) :: uplo
    integer, intent(in) :: kd
    real(dp), intent(in), target :: band(:, :)
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(inout) :: condensed
    type(fuge_info), intent(out) :: info
    type(fuge_band_stiffness) :: stiffness

    call set_band(uplo, kd, band, stiffness, info)
    if (.not. info%failed()) call fuge_condense(stiffness, body, condensed, info)
  end subroutine condense_band

  !> Displacements `u` (nd) under the contact forces `force` (n) and motions `motion` (m), for a stiffness matrix in
  !> band storage as in `condense_band`. Errors as `set_band` and `recover_displacements`.
  subroutine recover_band(uplo, kd, band, body, force, motion, u, info)
    character(len=1), intent(in) :: uplo
    integer, intent(in) :: kd
    real(dp), intent(in), target :: band(:, :)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: force(:), motion(:)
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    type(fuge_band_stiffness) :: stiffness

    call set_band(uplo, kd, band, stiffness, info)
    if (.not. info%failed()) call recover_displacements(stiffness, body, force, motion, u, info)
  end subroutine recover_band

  !> Copy a condensed body to the caller's arrays: `alpha` (lda, n), `b` (n), `modes` (ldr, m),
  !> `resultant` (m). Modes that move no contact point are left out by `fuge_condense`, but have to
  !> keep their places here, with the motion prescribed: `marks` (m) is 1 for them, else 0.
  pure subroutine copy_condensed(body, condensed, alpha, b, modes, resultant, marks)
    type(fuge_body), intent(in) :: body
    type(fuge_condensed), intent(in) :: condensed
    real(dp), intent(inout) :: alpha(:, :), b(:), modes(:, :), resultant(:)
    integer, intent(inout) :: marks(:)
    integer :: i, j, kept, n

    n = size(b)
    alpha(:n, :) = condensed%alpha
    b = condensed%displacement
    kept = 0
    do j = 1, size(marks)
      do i = 1, n
        modes(i, j) = -point_displacement(body%dof(:, i), body%normal(:, i), body%rigid_modes(:, j))
      end do
      resultant(j) = dot_product(body%rigid_modes(:, j), body%load)
      marks(j) = 1
      if (kept == size(condensed%resultant)) cycle
      ! `fuge_condense` keeps the modes unchanged and in the same order.
      associate (next => condensed%modes(:, kept + 1))
        if (maxval(abs(modes(:n, j) - next)) > sqrt(epsilon(1.0_dp))*maxval(abs(next))) cycle
      end associate
      marks(j) = 0
      kept = kept + 1
      modes(:n, j) = condensed%modes(:, kept)
      resultant(j) = condensed%resultant(kept)
    end do
  end subroutine copy_condensed

  !> Set the stiffness from a band. Errors as `set` of `fuge_band_stiffness`, and FUGE_ERR_OPTION
  !> for another triangle.
  subroutine set_band(uplo, kd, band, stiffness, info)
    character(len=1), intent(in) :: uplo
    integer, intent(in) :: kd
    real(dp), intent(in), target :: band(:, :)
    type(fuge_band_stiffness), intent(inout) :: stiffness
    type(fuge_info), intent(out) :: info

    if (scan(uplo, 'UuLl') < 1) then
      call report(info, FUGE_ERR_OPTION, 'UPLO = '''//uplo//''': use U for the upper triangle, L for the lower one')
    else
      call stiffness%set(band, scan(uplo, 'Uu') > 0, info, kd)
    end if
  end subroutine set_band

  !> Displacements by a condensation without alpha and its n solves: the contact forces are known.
  !> Errors as `fuge_condense` and `check_equilibrium`.
  subroutine recover_displacements(stiffness, body, force, motion, u, info)
    class(fuge_stiffness), intent(in) :: stiffness
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: force(:), motion(:)
    real(dp), intent(inout) :: u(:)
    type(fuge_info), intent(out) :: info
    type(fuge_condensed) :: condensed
    type(fuge_solution) :: contact_only

    call check_body(body, size(u), info)
    if (.not. info%failed()) call check_equilibrium(body, force, motion, info)
    if (info%failed()) return
    call condense_to_recover(stiffness, body, condensed, info)
    if (info%failed()) return
    contact_only%force = force
    ! The motions are added below, including those that move no contact point.
    contact_only%motion = 0.0_dp*motion
    call condensed%recover(contact_only, u, info)
    if (.not. info%failed() .and. size(motion) > 0) u = u + matmul(body%rigid_modes, motion)
  end subroutine recover_displacements

  !> Refuse forces and motions that are not finite (FUGE_ERR_NOT_FINITE), and contact forces that
  !> are not in equilibrium with the load in a rigid mode (FUGE_ERR_NO_EQUILIBRIUM).
  pure subroutine check_equilibrium(body, force, motion, info)
    type(fuge_body), intent(in) :: body
    real(dp), intent(in) :: force(:), motion(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: contact_load(:)
    real(dp) :: work, magnitude
    integer :: j, stat

    call check_finite(force, 'F', info)
    if (.not. info%failed()) call check_finite(motion, 'Q', info)
    if (info%failed() .or. size(motion) < 1) return
    allocate (contact_load(size(body%load)), stat=stat)
    if (stat /= 0) then
      call report(info, FUGE_ERR_MEMORY, 'no memory to check the equilibrium')
      return
    end if
    contact_load = 0.0_dp
    call add_contact_forces(body, force, contact_load)
    do j = 1, size(motion)
      work = dot_product(body%rigid_modes(:, j), body%load + contact_load)
      magnitude = dot_product(abs(body%rigid_modes(:, j)), abs(body%load) + abs(contact_load))
      if (abs(work) > BALANCED*magnitude) then
        call report(info, FUGE_ERR_NO_EQUILIBRIUM, 'load and contact forces are not in equilibrium in rigid mode ' &
                    //text(j)//': use the forces of the problem with the resultants W, or fix a degree of freedom')
        return
      end if
    end do
  end subroutine check_equilibrium

end module fuge_f77_body
