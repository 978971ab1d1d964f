!> Stresses in the bodies below their contacts: where do they yield first?
!>
!>     stress [cells [folder for its tables]]
!>
!> The largest shear stress in the plane, (sigma_1 - sigma_2)/2, is what photoelasticity makes visible: its level lines
!> are the fringes. Here they are those of the paper's punch under two loads, of a flat punch that a force tilts, and of
!> a ball. The largest stresses below a cylinder, a ball and a barrel are compared with the known ones. Last comes a
!> rough surface of `cells` x `cells`, a power of two, 256 unless given, with the stresses below it depth by depth.
!> For the pictures and for ParaView it writes stress_*.dat and stress_*.csv, stress_surface.vti and stress_body.vtr.
program stress
  use example_verdict, only: verdict
  use stress_areas, only: press_ball_and_barrel
  use stress_lines, only: press_cylinder, press_flat_punch, press_paper_punch
  use stress_rough, only: press_rough_surface
  implicit none

  call run()

contains

  subroutine run()
    type(verdict) :: known
    integer :: cells

    call read_cells(cells)
    call press_paper_punch(known)
    call press_flat_punch(known)
    call press_cylinder(known)
    call press_ball_and_barrel(known)
    call press_rough_surface(cells, known)
    call known%give('against known stresses')
  end subroutine run

  subroutine read_cells(cells)
    integer, intent(out) :: cells
    character(len=32) :: argument
    integer :: status

    cells = 256
    if (command_argument_count() < 1) return
    call get_command_argument(1, argument)
    read (argument, *, iostat=status) cells
    if (status /= 0) error stop 'usage: stress [cells [folder]]'
    if (cells < 64 .or. popcnt(cells) /= 1) error stop 'cells has to be a power of two, 64 or more'
  end subroutine read_cells

end program stress
