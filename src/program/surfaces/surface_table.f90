!> The table of a measured surface: a line for each load.
module surface_table
  use contact_table, only: put_outcome
  use fuge, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_solution, fuge_surface
  use number_words, only: number_text, short_text
  use surface_file, only: rms_height, rms_slope
  use surface_options, only: surface_settings, BOUNDARY_NAMES, ELEMENT_NAMES, LEVEL_NAMES
  use text_table, only: table
  implicit none
  private

  public :: write_loads

  !> What one load gives.
  type, public :: load_results
    private
    !> Mean pressure on the whole surface.
    real(dp), public :: pressure = 0.0_dp
    real(dp) :: load = 0.0_dp
    !> Cells that touch, their area, and its share of the surface.
    integer :: cells = 0
    real(dp) :: area = 0.0_dp
    real(dp) :: fraction = 0.0_dp
    real(dp) :: approach = 0.0_dp
    real(dp) :: mean_gap = 0.0_dp
    !> Mean and largest pressure where it touches.
    real(dp) :: contact_pressure = 0.0_dp
    real(dp) :: largest_pressure = 0.0_dp
    real(dp) :: residual = 0.0_dp
    integer :: status = 0
  contains
    procedure, public :: take
  end type load_results

contains

  subroutine take(self, surface, problem, solution, info)
    class(load_results), intent(inout) :: self
    type(fuge_surface), intent(in) :: surface
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_info), intent(in) :: info
    real(dp) :: cell

    cell = surface%spacing_x*surface%spacing_y
    self%load = problem%resultant(1)
    self%pressure = self%load/(real(size(surface%height), dp)*cell)
    self%cells = info%contacts
    self%area = real(self%cells, dp)*cell
    self%fraction = real(self%cells, dp)/real(size(surface%height), dp)
    self%approach = solution%motion(1)
    self%mean_gap = sum(solution%gap)/real(size(surface%height), dp)
    ! A load that rounds to zero presses no cell.
    if (self%cells > 0) self%contact_pressure = self%load/self%area
    self%largest_pressure = maxval(solution%force)/cell
    self%residual = info%residual
    self%status = info%status
  end subroutine take

  !> On standard output if `path` is empty; `source` is the file of the surface. Error: FUGE_ERR_FILE.
  subroutine write_loads(path, source, settings, surface, results, note, info)
    character(len=*), intent(in) :: path, source, note
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(in) :: surface
    type(load_results), intent(in) :: results(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=240) :: line
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    call put_outcome(csv, info)
    if (len(note) > 0) call csv%put('# note: '//note)
    call put_surface(csv, source, settings, surface)
    call csv%put('pressure,load,cells,area,fraction,approach,mean_gap,contact_pressure,largest_pressure,' &
                 //'residual,status')
    do k = 1, size(results)
      associate (r => results(k))
        write (line, '(2(es24.16e3,","),i0,6(",",es24.16e3),",",es9.2e3,",",i0)') r%pressure, r%load, r%cells, r%area, &
          r%fraction, r%approach, r%mean_gap, r%contact_pressure, r%largest_pressure, r%residual, r%status
      end associate
      call csv%put(line)
    end do
    call csv%finish(info)
  end subroutine write_loads

  !> What was solved.
  subroutine put_surface(csv, source, settings, surface)
    type(table), intent(inout) :: csv
    character(len=*), intent(in) :: source
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(in) :: surface

    call csv%put('# surface: '//source//', '//number_text(size(surface%height, 1))//' x ' &
                 //number_text(size(surface%height, 2))//' heights, '//number_text(surface%filled)//' of them filled')
    call csv%put('# spacings: '//short_text(surface%spacing_x)//' and '//short_text(surface%spacing_y) &
                 //', rms height '//short_text(rms_height(surface))//', rms slope '//short_text(rms_slope(surface)) &
                 //', level: '//trim(LEVEL_NAMES(settings%level_name)))
    call csv%put('# e_star: '//short_text(settings%e_star)//', boundary: ' &
                 //trim(BOUNDARY_NAMES(settings%boundary_name))//', element: ' &
                 //trim(ELEMENT_NAMES(settings%element_name)))
  end subroutine put_surface

end module surface_table
