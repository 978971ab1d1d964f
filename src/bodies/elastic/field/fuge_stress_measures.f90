!> Scalars of a stress: principal stresses, von Mises and Tresca stress, mean stress.
!>
!> A tensor is a column xx, yy, zz, yz, xz, xy; tension is positive. Von Mises and Tresca stress come from differences
!> of components and not from principal stresses or invariants, so that a large hydrostatic part costs no digits.
!> Numbers are scaled by powers of two: whatever the unit, no square leaves the range of double precision.
module fuge_stress_measures
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use fuge_elastic_moduli, only: check_poisson, FUGE_PLANE_STRAIN, FUGE_PLANE_STRESS
  use fuge_input_checks, only: is_finite_everywhere
  use fuge_kinds, only: dp
  use fuge_number_text, only: text
  use fuge_status, only: fuge_info, report, FUGE_ERR_OPTION
  use fuge_stress_checks, only: check_result
  implicit none
  private

  public :: fuge_halfplane_tensor, fuge_round_tensor, fuge_principal_stresses
  public :: fuge_von_mises, fuge_tresca, fuge_mean_stress

  !> Components of a tensor, of a stress in a plane, and of one about an axis.
  integer, parameter :: SIX = 6, IN_PLANE = 3, ABOUT_AXIS = 4
  !> Sweeps of Jacobi's method; four are enough for 3 by 3.
  integer, parameter :: MOST_SWEEPS = 10

  !> A tensor as unit*(mean + size*deviator); `unit` is a power of two, the largest component of the `deviator` is 1 or
  !> all of them are 0.
  type :: split_tensor
    real(dp) :: unit = 1.0_dp, mean = 0.0_dp, size = 0.0_dp
    real(dp) :: deviator(SIX) = 0.0_dp
  end type split_tensor

contains

  !> Tensors from the stresses in a plane: `stress` (3, points) xx, zz, xz, as from `fuge_halfplane_stress`.
  !>
  !> `plane_state` FUGE_PLANE_STRAIN: yy = `poisson` (xx + zz); FUGE_PLANE_STRESS: yy = 0. `poisson` of the body, in
  !> (-1, 0.5], also in plane stress. Out: `tensor` (6, points) xx, yy, zz, yz, xz, xy, in the unit of `stress`. NaN and
  !> infinity are passed on. Errors, `tensor` untouched: FUGE_ERR_SIZE; FUGE_ERR_OPTION for `plane_state`;
  !> FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE for `poisson`.
  pure subroutine fuge_halfplane_tensor(stress, plane_state, poisson, tensor, info)
    real(dp), intent(in) :: stress(:, :), poisson
    integer, intent(in) :: plane_state
    real(dp), intent(inout) :: tensor(:, :)
    type(fuge_info), intent(out) :: info
    real(dp) :: across
    integer :: k

    call check_result(shape(stress), 'stress', IN_PLANE, size(stress, 2), info)
    call check_result(shape(tensor), 'tensor', SIX, size(stress, 2), info)
    call check_plane(plane_state, poisson, info)
    if (info%failed()) return
    across = 0.0_dp
    if (plane_state == FUGE_PLANE_STRAIN) across = poisson
    do k = 1, size(stress, 2)
      tensor(:, k) = [stress(1, k), 0.0_dp, stress(2, k), 0.0_dp, stress(3, k), 0.0_dp]
      ! Product by product, because the sum may overflow.
      if (plane_state == FUGE_PLANE_STRAIN) tensor(2, k) = across*stress(1, k) + across*stress(2, k)
    end do
  end subroutine fuge_halfplane_tensor

  !> Tensors from the stresses about an axis: `stress` (4, points) rr, tt, zz, rz, as from `fuge_ring_stress`.
  !>
  !> Out: `tensor` (6, points) xx, yy, zz, yz, xz, xy at the points of the x-axis, where x is the radius and y the
  !> circumference. NaN and infinity are passed on. Error, `tensor` untouched: FUGE_ERR_SIZE.
  pure subroutine fuge_round_tensor(stress, tensor, info)
    real(dp), intent(in) :: stress(:, :)
    real(dp), intent(inout) :: tensor(:, :)
    type(fuge_info), intent(out) :: info
    integer :: k

    call check_result(shape(stress), 'stress', ABOUT_AXIS, size(stress, 2), info)
    call check_result(shape(tensor), 'tensor', SIX, size(stress, 2), info)
    if (info%failed()) return
    do k = 1, size(stress, 2)
      tensor(:, k) = [stress(1:3, k), 0.0_dp, stress(4, k), 0.0_dp]
    end do
  end subroutine fuge_round_tensor

  !> The principal stresses of each tensor, largest first, tension positive.
  !>
  !> `tensor` (6, points) xx, yy, zz, yz, xz, xy; out: `principal` (3, points) in the same unit, by Jacobi's method
  !> (G. H. Golub and C. F. Van Loan, Matrix Computations, section 8.5) to rounding of the largest one, or, without
  !> shear stress, exact. Three NaN where a component is NaN or infinite.
  !> Error, `principal` untouched: FUGE_ERR_SIZE.
  pure subroutine fuge_principal_stresses(tensor, principal, info)
    real(dp), intent(in) :: tensor(:, :)
    real(dp), intent(inout) :: principal(:, :)
    type(fuge_info), intent(out) :: info
    integer :: k

    call check_result(shape(tensor), 'tensor', SIX, size(tensor, 2), info)
    call check_result(shape(principal), 'principal', 3, size(tensor, 2), info)
    if (info%failed()) return
    do k = 1, size(tensor, 2)
      principal(:, k) = principal_of(tensor(:, k))
    end do
  end subroutine fuge_principal_stresses

  !> The von Mises stress of each tensor, sqrt(3 J_2): in simple tension, the stress.
  !>
  !> `tensor` (6, points) xx, yy, zz, yz, xz, xy; the result (points) is in its unit, with the relative error of a few
  !> roundings, also beside a large hydrostatic stress. NaN where a component is NaN or infinite, and everywhere unless
  !> there are six rows.
  pure function fuge_von_mises(tensor) result(value)
    real(dp), intent(in) :: tensor(:, :)
    real(dp) :: value(size(tensor, 2))
    integer :: k

    do k = 1, size(tensor, 2)
      value(k) = von_mises_of(tensor(:, k))
    end do
  end function fuge_von_mises

  !> The Tresca stress of each tensor, the largest principal stress minus the smallest one: twice the largest shear
  !> stress; in simple tension, the stress.
  !>
  !> `tensor` (6, points) xx, yy, zz, yz, xz, xy; the result (points) is in its unit, with the relative error of a few
  !> roundings, also where principal stresses nearly coincide. NaN where a component is NaN or infinite, and everywhere
  !> unless there are six rows.
  pure function fuge_tresca(tensor) result(value)
    real(dp), intent(in) :: tensor(:, :)
    real(dp) :: value(size(tensor, 2))
    integer :: k

    do k = 1, size(tensor, 2)
      value(k) = tresca_of(tensor(:, k))
    end do
  end function fuge_tresca

  !> The mean stress of each tensor, (xx + yy + zz)/3: minus the pressure.
  !>
  !> `tensor` (6, points) xx, yy, zz, yz, xz, xy; the result (points) is in its unit. NaN where a component is NaN or
  !> infinite, and everywhere unless there are six rows.
  pure function fuge_mean_stress(tensor) result(value)
    real(dp), intent(in) :: tensor(:, :)
    real(dp) :: value(size(tensor, 2))
    type(split_tensor) :: split
    integer :: k

    do k = 1, size(tensor, 2)
      value(k) = ieee_value(1.0_dp, ieee_quiet_nan)
      if (.not. is_tensor(tensor(:, k))) cycle
      split = split_of(tensor(:, k))
      value(k) = split%unit*split%mean
    end do
  end function fuge_mean_stress

  !> Refuse an unknown `plane_state` (FUGE_ERR_OPTION) and Poisson's ratios out of range (FUGE_ERR_MODULUS,
  !> FUGE_ERR_NOT_FINITE), unless an error is known already.
  pure subroutine check_plane(plane_state, poisson, info)
    integer, intent(in) :: plane_state
    real(dp), intent(in) :: poisson
    type(fuge_info), intent(inout) :: info

    if (info%failed()) return
    call check_poisson(poisson, info)
    if (info%failed()) return
    if (all(plane_state /= [FUGE_PLANE_STRAIN, FUGE_PLANE_STRESS])) call report(info, FUGE_ERR_OPTION, &
      'plane_state = '//text(plane_state)//' is unknown: use FUGE_PLANE_STRAIN or FUGE_PLANE_STRESS')
  end subroutine check_plane

  pure function von_mises_of(tensor) result(value)
    real(dp), intent(in) :: tensor(:)
    real(dp) :: value
    real(dp) :: t(SIX), difference(3), size_here, unit

    value = ieee_value(1.0_dp, ieee_quiet_nan)
    if (.not. is_tensor(tensor)) return
    unit = unit_of(tensor)
    t = tensor/unit
    difference = [t(1) - t(2), t(2) - t(3), t(3) - t(1)]
    size_here = max(maxval(abs(difference)), maxval(abs(t(4:6))))
    value = 0.0_dp
    if (size_here > 0.0_dp) value = unit*(size_here*sqrt(0.5_dp*sum((difference/size_here)**2) &
                                                         + 3.0_dp*sum((t(4:6)/size_here)**2)))
  end function von_mises_of

  pure function tresca_of(tensor) result(value)
    real(dp), intent(in) :: tensor(:)
    real(dp) :: value
    real(dp) :: eigenvalue(3)
    type(split_tensor) :: split

    value = ieee_value(1.0_dp, ieee_quiet_nan)
    if (.not. is_tensor(tensor)) return
    split = split_of(tensor)
    eigenvalue = eigenvalues(split%deviator)
    value = split%unit*(split%size*(maxval(eigenvalue) - minval(eigenvalue)))
  end function tresca_of

  pure function principal_of(tensor) result(principal)
    real(dp), intent(in) :: tensor(:)
    real(dp) :: principal(3)
    type(split_tensor) :: split

    principal = ieee_value(1.0_dp, ieee_quiet_nan)
    if (.not. is_tensor(tensor)) return
    if (maxval(abs(tensor(4:6))) > 0.0_dp) then
      split = split_of(tensor)
      principal = descending(split%unit*(split%mean + split%size*eigenvalues(split%deviator)))
    else
      principal = descending(tensor(1:3))
    end if
  end function principal_of

  !> Six numbers that are finite?
  pure function is_tensor(tensor)
    real(dp), intent(in) :: tensor(:)
    logical :: is_tensor
    real(dp) :: t(SIX)

    is_tensor = size(tensor) == SIX
    if (.not. is_tensor) return
    t = tensor
    is_tensor = is_finite_everywhere(t)
  end function is_tensor

  !> The power of two by which a tensor is divided; no component is then above 2.
  pure function unit_of(tensor) result(unit)
    real(dp), intent(in) :: tensor(SIX)
    real(dp) :: unit
    real(dp) :: largest

    largest = maxval(abs(tensor))
    unit = 1.0_dp
    if (largest > 0.0_dp) unit = scale(1.0_dp, min(exponent(largest), maxexponent(largest) - 1))
  end function unit_of

  pure function split_of(tensor) result(split)
    real(dp), intent(in) :: tensor(SIX)
    type(split_tensor) :: split
    real(dp) :: t(SIX), deviator(SIX)

    split%unit = unit_of(tensor)
    t = tensor/split%unit
    split%mean = (t(1) + t(2) + t(3))/3.0_dp
    deviator = [((t(1) - t(2)) + (t(1) - t(3)))/3.0_dp, ((t(2) - t(1)) + (t(2) - t(3)))/3.0_dp, &
                ((t(3) - t(1)) + (t(3) - t(2)))/3.0_dp, t(4:6)]
    split%size = maxval(abs(deviator))
    if (split%size > 0.0_dp) split%deviator = deviator/split%size
  end function split_of

  !> The eigenvalues of a symmetric matrix of components xx, yy, zz, yz, xz, xy up to 1, by cyclic rotations.
  !>
  !> A closed form with the invariants has half of the digits where two eigenvalues nearly coincide.
  pure function eigenvalues(component) result(eigenvalue)
    real(dp), intent(in) :: component(SIX)
    real(dp) :: eigenvalue(3)
    real(dp) :: a(SIX)
    integer :: sweep

    a = component
    do sweep = 1, MOST_SWEEPS
      if (maxval(abs(a(4:6))) <= 0.01_dp*epsilon(a)) exit
      call rotate(a(1), a(2), a(6), a(4), a(5))
      call rotate(a(2), a(3), a(4), a(5), a(6))
      call rotate(a(3), a(1), a(5), a(6), a(4))
    end do
    eigenvalue = a(1:3)
  end function eigenvalues

  !> One rotation about axis r, which turns the component `pq` to 0: `pp`, `qq` and the components `qr` and `rp` with
  !> the third axis change.
  pure subroutine rotate(pp, qq, pq, qr, rp)
    real(dp), intent(inout) :: pp, qq, pq, qr, rp
    real(dp) :: cosine, sine, tangent, half, old

    if (.not. abs(pq) > 0.0_dp) return
    half = 0.5_dp*(qq - pp)
    tangent = pq/(abs(half) + hypot(half, pq))
    if (half < 0.0_dp) tangent = -tangent
    cosine = 1.0_dp/sqrt(1.0_dp + tangent**2)
    sine = tangent*cosine
    pp = pp - tangent*pq
    qq = qq + tangent*pq
    pq = 0.0_dp
    old = rp
    rp = cosine*old - sine*qr
    qr = sine*old + cosine*qr
  end subroutine rotate

  pure function descending(three) result(sorted)
    real(dp), intent(in) :: three(3)
    real(dp) :: sorted(3)
    real(dp) :: low, high

    low = min(three(1), three(2))
    high = max(three(1), three(2))
    sorted = [max(high, three(3)), max(low, min(high, three(3))), min(low, three(3))]
  end function descending

end module fuge_stress_measures
