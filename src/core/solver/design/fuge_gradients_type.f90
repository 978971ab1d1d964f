!> How an objective changes with the data of a contact problem.
module fuge_gradients_type
  use fuge_kinds, only: dp
  implicit none
  private

  !> Partial derivatives of an objective J, a function of forces, gaps and motions, by the data of the problem; each in
  !> the unit of J over that of the datum. Those by numbers that follow from these: by a coefficient of the influence
  !> matrix, gap(i)*force(j); by one of the modes, -gap(i)*motion(j) - load(j)*force(i).
  type, public :: fuge_gradients
    !> dJ/dg, by the initial gaps, (n).
    real(dp), allocatable :: gap(:)
    !> dJ/dw, by the resultants; where a motion is prescribed, by the motion, (m).
    real(dp), allocatable :: load(:)
    !> By the compliances of springs at the points, (n); where there is none, by the first bit of one.
    real(dp), allocatable :: compliance(:)
    !> By the stiffnesses of the springs on the motions, (m); zero where prescribed.
    real(dp), allocatable :: motion_stiffness(:)
    !> By the play, (n); not zero at the upper stop, and where a tied point pulls. Allocated if the problem has a play.
    real(dp), allocatable :: gap_upper(:)
    !> By the limits of the forces, (n); not zero where a force has reached its limit only, by the first bit of one
    !> where it is zero. Allocated if the problem has them.
    real(dp), allocatable :: limit(:), limit_upper(:)
    !> e_star*dJ/de_star, in the unit of J: by the logarithm of the modulus to which all displacements by contact forces
    !> are inversely proportional.
    real(dp) :: log_modulus = 0.0_dp
    !> Is the point on the border between two states, so that J has a kink there, (n)? The gradients are those of the
    !> side on which `solution%state` is.
    logical, allocatable :: at_kink(:)
  end type fuge_gradients

end module fuge_gradients_type
