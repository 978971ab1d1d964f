!> The contact problem of one grid as the iteration solves it, and the same problem on a coarser grid.
!>
!> Most problems have one translation, free or prescribed, and one-sided contact everywhere: what else a scene has is
!> allocated only where it has it.
module fuge_contact_scene
  use fuge_equilibrium, only: find_equilibrium
  use fuge_kinds, only: dp
  use fuge_shared_rows, only: shared_rows
  use fuge_shared_transfer, only: restrict_rows
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: coarser_scene

  !> c = gap + A f - modes q, modes^T f = load, between the stops 0 <= c <= play. Gaps, plays and forces are divided by
  !> a load. Points that are excluded have the gap OUT_OF_REACH.
  type, public :: contact_scene
    !> Initial gaps less their datum or the displacements by prescribed motions, (n).
    real(dp), allocatable :: gap(:)
    !> No translation with the resultant 1 is free.
    logical :: prescribed = .false.
    !> Play, (n), huge where one-sided; not allocated: one-sided everywhere.
    real(dp), allocatable :: play(:)
    !> Limits of the forces at both stops, (n), huge where there is none; not allocated: none. Then `play` is allocated.
    real(dp), allocatable :: limit(:), limit_upper(:)
    !> Points that take no part in the contact, (n); not allocated: none.
    logical, allocatable :: excluded(:)
    !> Free rigid modes (n, m) and their resultants (m), with `prescribed`; not allocated: none.
    real(dp), allocatable :: modes(:, :), load(:)
    !> Forces at few points that are in equilibrium with `load`, (n).
    real(dp), allocatable :: balance(:)
    !> The modes contain a translation, which absorbs the operator's datum.
    logical :: absorbs_datum = .false.
    !> Which rows of the grid each rank has, where several share the points.
    type(shared_rows) :: rows = shared_rows()
  contains
    procedure :: points
    procedure :: is_simple
    procedure :: fits_window
    procedure :: is_unloaded
    procedure :: is_tied
    procedure :: has_limits
    procedure :: find_range
    procedure :: limited_force
    procedure :: tied_points
    procedure :: counts_datum
    procedure :: rounding_force
  end type contact_scene

  !> The gap of excluded points: no displacement closes it.
  real(dp), parameter, public :: OUT_OF_REACH = 0.01_dp*huge(1.0_dp)
  !> Displacements below this fraction of the gaps are rounding.
  real(dp), parameter :: NO_LENGTH = 1.0e-14_dp
  !> A mode whose means over the cells are below this fraction of it varies within cells only: what is left of it may be
  !> rounding, which would count as a mode like any other.
  real(dp), parameter :: LEFT_OF_MODE = 0.1_dp

contains

  !> Number of points, of all ranks.
  pure function points(self) result(n)
    class(contact_scene), intent(in) :: self
    integer :: n

    n = self%rows%points(size(self%gap))
  end function points

  !> One translation, free or prescribed, and one-sided contact at all points?
  pure function is_simple(self)
    class(contact_scene), intent(in) :: self
    logical :: is_simple

    is_simple = .not. (allocated(self%modes) .or. allocated(self%play) .or. allocated(self%excluded))
  end function is_simple

  !> One translation and one-sided contact at all points, whatever the limits of forces? Then a window of its points has
  !> such a scene too.
  pure function fits_window(self)
    class(contact_scene), intent(in) :: self
    logical :: fits_window

    fits_window = .not. (allocated(self%modes) .or. allocated(self%excluded))
    if (fits_window .and. allocated(self%play)) fits_window = all(self%play >= huge(1.0_dp))
  end function fits_window

  !> Are there modes, and no resultants in them? Then forces only balance each other.
  pure function is_unloaded(self)
    class(contact_scene), intent(in) :: self
    logical :: is_unloaded

    is_unloaded = allocated(self%modes)
    if (is_unloaded) is_unloaded = .not. any(abs(self%load) > 0.0_dp)
  end function is_unloaded

  !> Does the gap of point `k` stay zero, whatever its force?
  pure function is_tied(self, k)
    class(contact_scene), intent(in) :: self
    integer, intent(in) :: k
    logical :: is_tied

    is_tied = .false.
    if (.not. allocated(self%play)) return
    is_tied = self%play(k) <= 0.0_dp
    if (allocated(self%excluded)) is_tied = is_tied .and. .not. self%excluded(k)
  end function is_tied

  !> Do forces have limits?
  pure function has_limits(self)
    class(contact_scene), intent(in) :: self
    logical :: has_limits

    has_limits = allocated(self%limit)
  end function has_limits

  !> The least and the largest force of point `k` at its lower stop, or `at_upper`; huge without a limit.
  pure subroutine find_range(self, k, at_upper, least, most)
    class(contact_scene), intent(in) :: self
    integer, intent(in) :: k
    logical, intent(in) :: at_upper
    real(dp), intent(out) :: least, most

    logical :: tied

    tied = self%is_tied(k)
    least = merge(-huge(least), 0.0_dp, at_upper .or. tied)
    most = merge(0.0_dp, huge(most), at_upper .and. .not. tied)
    if (.not. allocated(self%limit)) return
    least = max(least, -self%limit_upper(k))
    most = min(most, self%limit(k))
  end subroutine find_range

  !> The force of point `k` at its limit of the lower stop, `sense` = 1, or of the upper one, -1.
  pure function limited_force(self, k, sense) result(force)
    class(contact_scene), intent(in) :: self
    integer, intent(in) :: k, sense
    real(dp) :: force

    force = self%limit(k)
    if (sense < 0) force = -self%limit_upper(k)
  end function limited_force

  !> Points that are tied, (n).
  pure function tied_points(self) result(tied)
    class(contact_scene), intent(in) :: self
    logical :: tied(size(self%gap))
    integer :: k

    do k = 1, size(tied)
      tied(k) = self%is_tied(k)
    end do
  end function tied_points

  !> Do displacements include those by the operator's datum? Only where no free motion absorbs them.
  pure function counts_datum(self)
    class(contact_scene), intent(in) :: self
    logical :: counts_datum

    counts_datum = self%prescribed .and. .not. self%absorbs_datum
  end function counts_datum

  !> Forces up to this one are rounding: 0 if there is a load to compare them with; without one, the largest force that
  !> displaces nothing beside the gaps, where forces of size 1 displace by `softness`.
  function rounding_force(self, softness) result(rounding)
    class(contact_scene), intent(in) :: self
    real(dp), intent(in) :: softness
    real(dp) :: rounding
    real(dp) :: length

    rounding = 0.0_dp
    if (.not. self%is_unloaded()) return
    rounding = tiny(rounding)
    length = maxval(abs(self%gap), mask=self%gap < OUT_OF_REACH)
    if (allocated(self%play)) length = max(length, maxval(self%play, mask=self%play < huge(length) &
                                                          .and. self%gap < OUT_OF_REACH))
    length = self%rows%largest(length)
    if (.not. length > 0.0_dp) then
      ! Without lengths there are no forces.
      rounding = huge(rounding)
    else if (softness > 0.0_dp) then
      rounding = max(rounding, NO_LENGTH*(length/softness))
    end if
  end function rounding_force

  !> The scene on the grid whose cells are 2**level times as wide as those of `finest`, with means over the points of
  !> a cell that take part. `possible` is false if no forces there carry the resultants. `rows`: those of the coarse
  !> grid, where ranks share them. Error: FUGE_ERR_MEMORY.
  subroutine coarser_scene(scene, finest, level, coarse, possible, info, rows)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: finest(2), level
    type(contact_scene), intent(out) :: coarse
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    type(shared_rows), intent(in), optional :: rows
    real(dp), allocatable :: share(:)

    possible = .true.
    coarse%prescribed = scene%prescribed
    coarse%absorbs_datum = scene%absorbs_datum
    if (present(rows)) coarse%rows = rows
    if (scene%is_simple()) then
      call restrict_rows(scene%rows, coarse%rows, finest, level, scene%gap, coarse%gap, info)
      return
    end if
    if (allocated(scene%excluded)) call restrict_share(scene, coarse%rows, finest, level, share, info)
    if (.not. info%failed()) call restrict_means(scene, coarse%rows, scene%gap, finest, level, share, coarse%gap, info)
    if (.not. (allocated(share) .or. info%failed())) call set_whole_cells(scene, size(coarse%gap), share, info)
    if (.not. info%failed()) call restrict_play(scene, finest, level, share, coarse, info)
    if (.not. info%failed()) call restrict_limits(scene, finest, level, share, coarse, info)
    if (.not. info%failed()) call restrict_modes(scene, finest, level, share, coarse, info)
    if (info%failed()) return
    if (allocated(scene%excluded)) then
      coarse%excluded = .not. share > 0.0_dp
      where (coarse%excluded) coarse%gap = OUT_OF_REACH
    end if
    if (allocated(coarse%modes)) call find_balance(coarse, possible, info)
  end subroutine coarser_scene

  !> `share`: the fraction of the points of each coarse cell that take part.
  subroutine restrict_share(scene, rows, finest, level, share, info)
    type(contact_scene), intent(in) :: scene
    type(shared_rows), intent(in) :: rows
    integer, intent(in) :: finest(2), level
    real(dp), allocatable, intent(out) :: share(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: taking_part(:)
    integer :: stat

    allocate (taking_part(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the means of', size(scene%gap), 'cells', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    taking_part = merge(0.0_dp, 1.0_dp, scene%excluded)
    call restrict_rows(scene%rows, rows, finest, level, taking_part, share, info)
  end subroutine restrict_share

  !> `share`: all points of the `cells` of a coarser grid take part. Error: FUGE_ERR_MEMORY.
  subroutine set_whole_cells(scene, cells, share, info)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: cells
    real(dp), allocatable, intent(out) :: share(:)
    type(fuge_info), intent(inout) :: info
    integer :: stat

    allocate (share(cells), stat=stat)
    call require_memory(stat, 'the means of', cells, 'cells', info)
    call scene%rows%agree(info)
    if (stat == 0) share = 1.0_dp
  end subroutine set_whole_cells

  !> `coarse`: the means of `values` (n) over the points that take part, 0 in cells without any; `share`, where points
  !> are excluded, of those. Error: FUGE_ERR_MEMORY.
  subroutine restrict_means(scene, rows, values, finest, level, share, coarse, info)
    type(contact_scene), intent(in) :: scene
    type(shared_rows), intent(in) :: rows
    real(dp), intent(in), contiguous :: values(:)
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), allocatable :: share(:)
    real(dp), allocatable, intent(out) :: coarse(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: taking_part(:)
    integer :: stat

    if (allocated(scene%excluded)) then
      allocate (taking_part(size(values)), stat=stat)
      call require_memory(stat, 'the means of', size(values), 'cells', info)
      call scene%rows%agree(info)
      if (stat /= 0 .or. info%failed()) return
      taking_part = merge(0.0_dp, values, scene%excluded)
      call restrict_rows(scene%rows, rows, finest, level, taking_part, coarse, info)
      if (.not. info%failed()) where (share > 0.0_dp) coarse = coarse/share
    else
      call restrict_rows(scene%rows, rows, finest, level, values, coarse, info)
    end if
  end subroutine restrict_means

  !> The mean play where all points of a cell have an upper stop, else huge. Error: FUGE_ERR_MEMORY.
  subroutine restrict_play(scene, finest, level, share, coarse, info)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), allocatable :: share(:)
    type(contact_scene), intent(inout) :: coarse
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: endless(:), play(:)
    integer :: stat

    if (.not. allocated(scene%play)) return
    if (scene%rows%everywhere(all(scene%play >= huge(1.0_dp)))) then
      allocate (coarse%play(size(share)), stat=stat)
      call require_memory(stat, 'the play of', size(share), 'cells', info)
      call scene%rows%agree(info)
      if (stat == 0) coarse%play = huge(1.0_dp)
      return
    end if
    allocate (play(size(scene%play)), stat=stat)
    call require_memory(stat, 'the play of', size(scene%play), 'cells', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    play = merge(1.0_dp, 0.0_dp, scene%play >= huge(1.0_dp))
    call restrict_means(scene, coarse%rows, play, finest, level, share, endless, info)
    if (info%failed()) return
    play = merge(0.0_dp, scene%play, scene%play >= huge(1.0_dp))
    call restrict_means(scene, coarse%rows, play, finest, level, share, coarse%play, info)
    if (.not. info%failed()) where (endless > 0.0_dp) coarse%play = huge(1.0_dp)
  end subroutine restrict_play

  !> The sums of the limits over the cells of a coarser one, whose force is the sum of theirs. Error: FUGE_ERR_MEMORY.
  subroutine restrict_limits(scene, finest, level, share, coarse, info)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), allocatable :: share(:)
    type(contact_scene), intent(inout) :: coarse
    type(fuge_info), intent(inout) :: info

    if (.not. scene%has_limits()) return
    call sum_of_limits(scene, scene%limit, finest, level, share, coarse, coarse%limit, info)
    if (.not. info%failed()) call sum_of_limits(scene, scene%limit_upper, finest, level, share, coarse, &
                                                coarse%limit_upper, info)
  end subroutine restrict_limits

  !> `sums` of the limits over the points of each coarse cell that take part, huge where one of them has none. Error:
  !> FUGE_ERR_MEMORY.
  subroutine sum_of_limits(scene, limit, finest, level, share, coarse, sums, info)
    type(contact_scene), intent(in) :: scene
    real(dp), intent(in), contiguous :: limit(:)
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), allocatable :: share(:)
    type(contact_scene), intent(in) :: coarse
    real(dp), allocatable, intent(out) :: sums(:)
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: endless(:), values(:)
    integer :: stat

    if (scene%rows%everywhere(all(limit >= huge(1.0_dp)))) then
      allocate (sums(size(share)), stat=stat)
      call require_memory(stat, 'the limits of', size(share), 'cells', info)
      call scene%rows%agree(info)
      if (stat == 0) sums = huge(1.0_dp)
      return
    end if
    allocate (values(size(limit)), stat=stat)
    call require_memory(stat, 'the limits of', size(limit), 'cells', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    values = merge(1.0_dp, 0.0_dp, limit >= huge(1.0_dp))
    call restrict_means(scene, coarse%rows, values, finest, level, share, endless, info)
    if (info%failed()) return
    values = merge(0.0_dp, limit, limit >= huge(1.0_dp))
    call restrict_means(scene, coarse%rows, values, finest, level, share, sums, info)
    if (info%failed()) return
    sums = sums*share*real(product(min(2**level, finest)), dp)
    where (endless > 0.0_dp) sums = huge(1.0_dp)
  end subroutine sum_of_limits

  !> The mean displacement of each cell by a motion, none where the motion is one within cells, and the same resultants.
  subroutine restrict_modes(scene, finest, level, share, coarse, info)
    type(contact_scene), intent(in) :: scene
    integer, intent(in) :: finest(2), level
    real(dp), intent(in), allocatable :: share(:)
    type(contact_scene), intent(inout) :: coarse
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: mode(:)
    real(dp) :: sizes(2)
    integer :: j, stat

    if (.not. allocated(scene%modes)) return
    allocate (coarse%modes(size(share), size(scene%load)), coarse%load(size(scene%load)), coarse%balance(size(share)), &
              stat=stat)
    call require_memory(stat, 'the modes of', size(share), 'cells', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    coarse%load = scene%load
    do j = 1, size(scene%load)
      call restrict_means(scene, coarse%rows, scene%modes(:, j), finest, level, share, mode, info)
      if (info%failed()) return
      sizes = [maxval(abs(scene%modes(:, j))), maxval(abs(mode))]
      call scene%rows%raise(sizes)
      coarse%modes(:, j) = merge(mode, 0.0_dp, sizes(2) > LEFT_OF_MODE*sizes(1))
    end do
  end subroutine restrict_modes

  !> Forces in equilibrium with the resultants; `possible` if there are any. Error: FUGE_ERR_MEMORY.
  subroutine find_balance(scene, possible, info)
    type(contact_scene), intent(inout) :: scene
    logical, intent(out) :: possible
    type(fuge_info), intent(inout) :: info
    real(dp) :: remainder(size(scene%load))
    real(dp), allocatable :: least(:), most(:)
    integer :: stat

    possible = .false.
    allocate (least(size(scene%gap)), most(size(scene%gap)), stat=stat)
    call require_memory(stat, 'the equilibrium of', size(scene%gap), 'cells', info)
    call scene%rows%agree(info)
    if (stat /= 0 .or. info%failed()) return
    least = 0.0_dp
    most = huge(1.0_dp)
    if (allocated(scene%play)) least = merge(-huge(1.0_dp), 0.0_dp, scene%play < huge(1.0_dp))
    if (scene%has_limits()) then
      least = max(least, -scene%limit_upper)
      most = scene%limit
    end if
    if (allocated(scene%excluded)) then
      least = merge(0.0_dp, least, scene%excluded)
      most = merge(0.0_dp, most, scene%excluded)
    end if
    call find_equilibrium(scene%modes, scene%load, least, most, scene%balance, remainder, &
                          sharing=scene%rows%point_space)
    possible = .not. any(abs(remainder) > 0.0_dp)
  end subroutine find_balance

end module fuge_contact_scene
