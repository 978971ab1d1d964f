!> What the options of the program say about a measured surface and its loads.
module surface_options
  use command_line, only: arguments, refuse
  use fuge_area, only: FUGE_PERIODIC_X, FUGE_PERIODIC_Y
  use fuge_core, only: dp => fuge_dp, fuge_combined_modulus, fuge_info, fuge_options, fuge_plane_modulus, FUGE_CENTRE, &
    FUGE_FREE, FUGE_MEAN, FUGE_PERIODIC, FUGE_PLANE_STRAIN
  use fuge_files, only: FUGE_LEVEL_MEAN, FUGE_LEVEL_PLANE
  implicit none
  private

  public :: take_settings

  !> Value of `level`: heights stay as they are.
  integer, parameter, public :: LEVEL_NONE = -1

  !> The words of --boundary, --element and --level; the first one is the default.
  character(len=10), parameter, public :: BOUNDARY_NAMES(4) = [character(len=10) :: &
    'periodic', 'free', 'periodic-x', 'periodic-y']
  character(len=10), parameter, public :: ELEMENT_NAMES(2) = [character(len=10) :: 'mean', 'centre']
  character(len=10), parameter, public :: LEVEL_NAMES(3) = [character(len=10) :: 'plane', 'mean', 'none']
  integer, parameter :: BOUNDARIES(4) = [FUGE_PERIODIC, FUGE_FREE, FUGE_PERIODIC_X, FUGE_PERIODIC_Y]
  integer, parameter :: ELEMENTS(2) = [FUGE_MEAN, FUGE_CENTRE]
  integer, parameter :: LEVELS(3) = [FUGE_LEVEL_PLANE, FUGE_LEVEL_MEAN, LEVEL_NONE]

  type, public :: surface_settings
    !> Of the solves.
    type(fuge_options) :: options
    !> Combined modulus of both bodies; force per length squared.
    real(dp) :: e_star = 0.0_dp
    !> Constants of the library, and their indices among the names above.
    integer :: boundary = BOUNDARIES(1), element = ELEMENTS(1), level = LEVELS(1)
    integer :: boundary_name = 1, element_name = 1, level_name = 1
    !> Points that were not measured are filled.
    logical :: fill = .false.
    !> Factors of the lengths along the surface, and of the heights.
    real(dp) :: scale = 1.0_dp, height_scale = 1.0_dp
    !> From point to point along x and y; not allocated where the file has them.
    real(dp), allocatable :: spacing(:)
    !> Mean pressures if `of_pressure`, else forces on the whole surface.
    real(dp), allocatable :: load(:)
    logical :: of_pressure = .false.
    !> Errors are bounded.
    logical :: prove = .false.
  end type surface_settings

contains

  !> Errors: FUGE_ERR_OPTION, FUGE_ERR_MODULUS.
  subroutine take_settings(given, settings, info)
    type(arguments), intent(in) :: given
    type(surface_settings), intent(inout) :: settings
    type(fuge_info), intent(inout) :: info

    settings%fill = given%has('fill')
    settings%prove = given%has('prove')
    call take_choice(given, 'boundary', BOUNDARY_NAMES, settings%boundary_name, info)
    call take_choice(given, 'element', ELEMENT_NAMES, settings%element_name, info)
    call take_choice(given, 'level', LEVEL_NAMES, settings%level_name, info)
    settings%boundary = BOUNDARIES(settings%boundary_name)
    settings%element = ELEMENTS(settings%element_name)
    settings%level = LEVELS(settings%level_name)
    call take_lengths(given, settings, info)
    call take_modulus(given, settings%e_star, info)
    settings%of_pressure = given%has('pressure')
    if (settings%of_pressure) then
      call take_positive(given, 'pressure', settings%load, info)
    else
      call take_positive(given, 'load', settings%load, info)
    end if
  end subroutine take_settings

  !> The number of the word among `names`; unchanged without the option.
  subroutine take_choice(given, option, names, choice, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: option, names(:)
    integer, intent(inout) :: choice
    type(fuge_info), intent(inout) :: info
    character(len=:), allocatable :: list
    integer :: at, k

    at = given%position(option)
    if (at == 0 .or. info%failed()) return
    do k = 1, size(names)
      if (given%settings(at)%value /= names(k)) cycle
      choice = k
      return
    end do
    list = trim(names(1))
    do k = 2, size(names)
      list = list//', '//trim(names(k))
    end do
    call refuse(given%settings(at)%source//': one of '//list//' is needed', info)
  end subroutine take_choice

  !> Spacings, and the factors that bring the unit of the file to that of the user.
  subroutine take_lengths(given, settings, info)
    type(arguments), intent(in) :: given
    type(surface_settings), intent(inout) :: settings
    type(fuge_info), intent(inout) :: info

    call take_factor(given, 'scale', settings%scale, info)
    settings%height_scale = settings%scale
    call take_factor(given, 'height-scale', settings%height_scale, info)
    if (.not. given%has('spacing')) return
    call take_positive(given, 'spacing', settings%spacing, info)
    if (info%failed()) return
    if (size(settings%spacing) == 1) settings%spacing = spread(settings%spacing(1), 1, 2)
    if (size(settings%spacing) > 2) call refuse(given%settings(given%position('spacing'))%source &
      //': one or two lengths are needed, along x and along y', info)
  end subroutine take_lengths

  subroutine take_factor(given, option, factor, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: option
    real(dp), intent(inout) :: factor
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: values(:)

    if (info%failed() .or. .not. given%has(option)) return
    call take_positive(given, option, values, info)
    if (info%failed()) return
    factor = values(1)
    if (size(values) > 1) call refuse(given%settings(given%position(option))%source//': one number is needed', info)
  end subroutine take_factor

  !> The combined modulus, by --modulus or by --young and --poisson of one elastic body or of both.
  subroutine take_modulus(given, e_star, info)
    type(arguments), intent(in) :: given
    real(dp), intent(inout) :: e_star
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: young(:), poisson(:)
    real(dp) :: e(2)
    integer :: k

    call take_factor(given, 'modulus', e_star, info)
    if (info%failed() .or. given%has('modulus')) return
    call take_positive(given, 'young', young, info)
    if (.not. info%failed()) call given%numbers(given%position('poisson'), poisson, info)
    if (info%failed()) return
    if (size(young) > 2 .or. size(poisson) /= size(young)) then
      call refuse('--young and --poisson need one number each, or two each for two elastic bodies', info)
      return
    end if
    e = 0.0_dp
    do k = 1, size(young)
      if (.not. info%failed()) call fuge_plane_modulus(young(k), poisson(k), FUGE_PLANE_STRAIN, e(k), info)
    end do
    if (info%failed()) return
    e_star = e(1)
    if (size(young) == 2) call fuge_combined_modulus(e(1), e(2), e_star, info)
  end subroutine take_modulus

  !> The numbers of an option that is there, all above 0.
  subroutine take_positive(given, option, values, info)
    type(arguments), intent(in) :: given
    character(len=*), intent(in) :: option
    real(dp), allocatable, intent(inout) :: values(:)
    type(fuge_info), intent(inout) :: info
    integer :: at

    if (info%failed()) return
    at = given%position(option)
    call given%numbers(at, values, info)
    if (info%failed()) return
    if (.not. all(values > 0.0_dp)) call refuse(given%settings(at)%source//': it has to be > 0', info)
  end subroutine take_positive

end module surface_options
