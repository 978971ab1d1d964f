!> The table of a measured surface: a line for each load.
module surface_table
  use contact_table, only: put_outcome
  use fuge_core, only: dp => fuge_dp, fuge_info, fuge_problem, fuge_proof, fuge_solution
  use fuge_files, only: fuge_surface
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
    !> Bounds of the errors of the approach, of all pressures and of all gaps, and cells whose state is proved.
    real(dp) :: approach_bound = 0.0_dp
    real(dp) :: pressure_bound = 0.0_dp
    real(dp) :: gap_bound = 0.0_dp
    integer :: proved = 0
  contains
    procedure, public :: take
  end type load_results

contains

  !> Bounds only if `proof` has any.
  subroutine take(self, surface, problem, solution, proof, info)
    class(load_results), intent(inout) :: self
    type(fuge_surface), intent(in) :: surface
    type(fuge_problem), intent(in) :: problem
    type(fuge_solution), intent(in) :: solution
    type(fuge_proof), intent(in) :: proof
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
    if (.not. allocated(proof%force_bound)) return
    self%approach_bound = proof%motion_bound(1)
    ! One unit in the last place more is not below the exact quotient.
    self%pressure_bound = nearest(maxval(proof%force_bound)/cell, 1.0_dp)
    self%gap_bound = maxval(proof%gap_bound)
    self%proved = count(proof%state_proved)
  end subroutine take

  !> On standard output if `path` is empty; `source` is the file of the surface. Error: FUGE_ERR_FILE.
  subroutine write_loads(path, source, settings, surface, results, note, info)
    character(len=*), intent(in) :: path, source, note
    type(surface_settings), intent(in) :: settings
    type(fuge_surface), intent(in) :: surface
    type(load_results), intent(in) :: results(:)
    type(fuge_info), intent(inout) :: info
    type(table) :: csv
    character(len=360) :: line
    character(len=:), allocatable :: columns
    integer :: k

    call csv%create(path, info)
    if (info%failed()) return
    call put_outcome(csv, info)
    if (len(note) > 0) call csv%put('# note: '//note)
    call put_surface(csv, source, settings, surface)
    columns = 'pressure,load,cells,area,fraction,approach,mean_gap,contact_pressure,largest_pressure,residual,status'
    if (settings%prove) columns = columns//',approach_bound,pressure_bound,gap_bound,proved'
    call csv%put(columns)
    do k = 1, size(results)
      associate (r => results(k))
        write (line, '(2(es24.16e3,","),i0,6(",",es24.16e3),",",es9.2e3,",",i0)') r%pressure, r%load, r%cells, r%area, &
          r%fraction, r%approach, r%mean_gap, r%contact_pressure, r%largest_pressure, r%residual, r%status
        if (settings%prove) write (line(len_trim(line) + 1:), '(3(",",es24.16e3),",",i0)') r%approach_bound, &
          r%pressure_bound, r%gap_bound, r%proved
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
