!> Small bodies for the corner cases that both engines must report alike: the same problem on a matrix, on products
!> alone, and on grids by FFT.
module corner_scenes
  use engine_scene_type, only: engine_scene
  use fuge_cell_elements, only: FUGE_MEAN, FUGE_FREE, FUGE_PERIODIC
  use fuge_halfplane_fft, only: fuge_halfplane_operator
  use fuge_halfspace_fft, only: fuge_halfspace_operator
  use fuge_halfspace_grid, only: FUGE_PERIODIC_X
  use fuge_kinds, only: dp
  use fuge_status, only: fuge_info
  use influence_matrices, only: matrix_of, products_only
  implicit none
  private

  public :: set_corner_body

  !> Points of each body: 6 x 2, where they are cells of an area.
  integer, parameter, public :: POINTS = 12, BODIES = 6
  integer, parameter :: ROW = 6

contains

  !> Body 1 .. BODIES; the gaps are a bowl that one of the points touches first.
  subroutine set_corner_body(number, scene)
    integer, intent(in) :: number
    type(engine_scene), intent(out) :: scene
    character(len=28), parameter :: NAMES(BODIES) = [character(len=28) :: 'matrix', 'products', 'half-plane FFT', &
      'half-space FFT', 'half-space FFT, periodic', 'half-space FFT, along x']
    integer :: k

    scene%number = number
    scene%body = NAMES(number)
    scene%part = [(merge(1, 2, 2*k <= POINTS), k=1, POINTS)]
    if (number == 3) then
      scene%x = [(real(2*k - 1 - POINTS, dp)/12.0_dp, k=1, POINTS)]
      scene%y = scene%x**2
    else
      scene%x = [(real(2*mod(k - 1, ROW) + 1 - ROW, dp)/6.0_dp, k=1, POINTS)]
      scene%y = [(real(merge(-1, 1, k <= ROW), dp)/6.0_dp, k=1, POINTS)]
    end if
    scene%problem%gap = 0.5_dp*(scene%x - 0.1_dp)**2 + 0.3_dp*(scene%y - 0.1_dp)**2
    select case (number)
    case (1, 2)
      call set_exponential(number == 2, scene)
    case (3)
      call set_halfplane(scene)
    case (4)
      call set_halfspace(FUGE_FREE, scene)
    case (5)
      call set_halfspace(FUGE_PERIODIC, scene)
    case default
      call set_halfspace(FUGE_PERIODIC_X, scene)
    end select
  end subroutine set_corner_body

  !> alpha falls exponentially with the distance.
  subroutine set_exponential(as_products, scene)
    logical, intent(in) :: as_products
    type(engine_scene), intent(inout) :: scene
    integer :: j

    allocate (scene%alpha(POINTS, POINTS))
    do j = 1, POINTS
      scene%alpha(:, j) = exp(-3.0_dp*sqrt((scene%x - scene%x(j))**2 + (scene%y - scene%y(j))**2))
    end do
    if (.not. as_products) return
    allocate (products_only :: scene%operator)
    select type (operator => scene%operator)
    type is (products_only)
      allocate (operator%matrix, source=scene%alpha)
    end select
  end subroutine set_exponential

  subroutine set_halfplane(scene)
    type(engine_scene), intent(inout) :: scene
    type(fuge_info) :: info

    allocate (fuge_halfplane_operator :: scene%operator)
    select type (operator => scene%operator)
    type is (fuge_halfplane_operator)
      call operator%set(POINTS, 2.0_dp/real(POINTS, dp), 1.0_dp, info, FUGE_MEAN, FUGE_FREE)
    end select
    scene%alpha = matrix_of(scene%operator)
  end subroutine set_halfplane

  subroutine set_halfspace(boundary, scene)
    integer, intent(in) :: boundary
    type(engine_scene), intent(inout) :: scene
    type(fuge_info) :: info

    allocate (fuge_halfspace_operator :: scene%operator)
    select type (operator => scene%operator)
    type is (fuge_halfspace_operator)
      call operator%set(ROW, POINTS/ROW, 1.0_dp/3.0_dp, 1.0_dp/3.0_dp, 1.0_dp, info, FUGE_MEAN, boundary)
    end select
    scene%alpha = matrix_of(scene%operator)
  end subroutine set_halfspace

end module corner_scenes
