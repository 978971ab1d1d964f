!> The spectra of a line of cells that ranks share, and products with them.
module fuge_line_kernel
  use fuge_cell_elements, only: FUGE_PERIODIC
  use fuge_halfplane_line, only: halfplane_line
  use fuge_kinds, only: dp
  use fuge_line_numbers, only: line_numbers
  use fuge_line_transform, only: line_transform
  use fuge_rank_communicator, only: rank_communicator
  use fuge_status, only: fuge_info, require_memory
  implicit none
  private

  public :: compute_kernels

  !> The spectrum of an even kernel, of the waves of this rank.
  type, public :: line_kernel
    !> Transforms are twisted: what has gone once round the circle is imaginary, and is dropped.
    logical :: twisted = .false.
    !> (m, own waves): of the wave k + n l in row l + 1 of the column for k, divided by the length.
    real(dp), allocatable :: spectrum(:, :)
  contains
    procedure :: convolve
  end type line_kernel

contains

  !> y = the convolution of x with the kernel; both the cells of this rank. With `softening` >= 0 each number s of the
  !> spectrum becomes s/(1 + softening s): to the inverse of the kernel is added `softening`. All ranks of the
  !> transform's group call it.
  subroutine convolve(self, transform, x, y, softening)
    class(line_kernel), intent(in) :: self
    type(line_transform), intent(in) :: transform
    real(dp), intent(in) :: x(:)
    real(dp), intent(inout) :: y(:)
    real(dp), intent(in), optional :: softening
    real(dp) :: scaled

    scaled = 0.0_dp
    if (present(softening)) scaled = softening*real(transform%rows, dp)*real(transform%columns, dp)
    call transform%columns_from_cells(x)
    call transform%waves_from_columns(self%twisted)
    call transform%multiply_waves(self%spectrum, scaled)
    call transform%columns_from_waves(self%twisted)
    call transform%cells_from_columns(y)
  end subroutine convolve

  !> The spectra of A and of the preconditioner, as those of fuge_halfplane_spectra; `datum` as there. All ranks of
  !> `group`, that of the transform, call it. Error, on all of them: FUGE_ERR_MEMORY.
  subroutine compute_kernels(line, group, transform, influence, inverse, datum, info)
    type(halfplane_line), intent(in) :: line
    type(rank_communicator), intent(in) :: group
    type(line_transform), intent(in) :: transform
    type(line_kernel), intent(inout) :: influence, inverse
    real(dp), intent(inout) :: datum
    type(fuge_info), intent(inout) :: info
    type(line_numbers) :: numbers
    integer :: k, l, length, stat, wave

    length = transform%rows*transform%columns
    call numbers%prepare(line, length, stat)
    if (stat == 0) allocate (inverse%spectrum(transform%columns, transform%own_waves), &
                            influence%spectrum(transform%columns, transform%own_waves), stat=stat)
    call require_memory(stat, 'the spectra of', line%cells, 'cells', info)
    call group%agree(info)
    if (stat /= 0 .or. info%failed()) return
    do k = 1, transform%own_waves
      do l = 1, transform%columns
        wave = transform%first_wave + k - 1 + transform%rows*(l - 1)
        inverse%spectrum(l, k) = numbers%inverse_of_wave(min(wave, length - wave))
      end do
    end do
    influence%twisted = line%boundary /= FUGE_PERIODIC
    if (influence%twisted) then
      call compute_free(numbers, group, transform, influence%spectrum, datum)
    else
      influence%spectrum = (1.0_dp/real(length, dp))**2/inverse%spectrum
      if (transform%first_wave == 0 .and. transform%own_waves > 0 .and. .not. line%body%has_rigid_base()) &
        influence%spectrum(1, 1) = 0.0_dp
    end if
  end subroutine compute_kernels

  !> The spectrum of a free surface: with a_j = a_(-j) the influence of cells j apart, the number k is the sum of
  !> a_j cos(2 pi j (k + 1/4)/N), |j| < N, twice the real part of what a twisted transform makes of a_0 .. a_(N-1), less
  !> a_0.
  subroutine compute_free(numbers, group, transform, spectrum, datum)
    type(line_numbers), intent(in) :: numbers
    type(rank_communicator), intent(in) :: group
    type(line_transform), intent(in) :: transform
    real(dp), intent(inout), contiguous :: spectrum(:, :)
    real(dp), intent(inout) :: datum
    real(dp) :: column(transform%rows), factor, length, mean(1)
    integer :: j, k

    length = real(transform%rows, dp)*real(transform%columns, dp)
    mean = 0.0_dp
    do j = 1, transform%own_columns
      column = [(numbers%at_distance(transform%first_column + j - 1 + transform%columns*k), k=0, transform%rows - 1)]
      call transform%set_columns(j, column)
      mean = mean + sum(column)
    end do
    call group%add(mean)
    ! The mean over the circle of 2 N cells, as fuge_halfplane_spectra has it.
    mean = (2.0_dp*mean - numbers%at_distance(0) &
            + numbers%at_distance(transform%rows*transform%columns))/(2.0_dp*length)
    call numbers%split(mean(1), factor, datum)
    do j = 1, transform%own_columns
      call transform%get_column(j, column)
      call transform%set_columns(j, factor*(column - mean(1)))
    end do
    call transform%waves_from_columns(.true.)
    call transform%transform_waves(spectrum)
    spectrum = (2.0_dp*spectrum - factor*(numbers%at_distance(0) - mean(1)))/length
  end subroutine compute_free

end module fuge_line_kernel
