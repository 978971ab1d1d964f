!> The spectra of a line of cells on a half-plane: those of its influence matrix and of its preconditioner.
module fuge_halfplane_spectra
  use fuge_cell_elements, only: FUGE_PERIODIC
  use fuge_compensated_sums, only: compensated_sum
  use fuge_convolution, only: convolution_kernel, transform_padded
  use fuge_halfplane_line, only: halfplane_line
  use fuge_kinds, only: dp
  use fuge_line_numbers, only: line_numbers
  use fuge_line_plan, only: line_plan
  use fuge_number_text, only: text
  use fuge_point_chunks, only: chunked_pass
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: compute_line_spectra

  !> Fills `values`, of the numbers 0, 1, .., with the eigenvalues of the preconditioner, or with the influence at
  !> distances. Threads share it, because each number takes long.
  type, extends(chunked_pass) :: fill_pass
    type(line_numbers), pointer :: numbers => null()
    logical :: waves = .true.
    real(dp), pointer, contiguous :: values(:) => null()
  contains
    procedure :: do_chunk => fill_chunk
  end type fill_pass

contains

  subroutine fill_chunk(self, k, first, last)
    class(fill_pass), intent(inout) :: self
    integer, intent(in) :: k, first, last
    integer :: i

    if (k < 1) return
    do i = first, last
      if (self%waves) then
        self%values(i) = self%numbers%inverse_of_wave(i - 1)
      else
        self%values(i) = self%numbers%at_distance(i - 1)
      end if
    end do
  end subroutine fill_chunk

  !> The `values` (n) of the pass.
  subroutine fill(numbers, waves, values)
    type(line_numbers), intent(in), target :: numbers
    logical, intent(in) :: waves
    real(dp), intent(out), contiguous, target :: values(:)
    type(fill_pass) :: pass

    pass%numbers => numbers
    pass%waves = waves
    pass%values => values
    call pass%run(size(values), 0)
  end subroutine fill

  !> The eigenvalues of A and of the preconditioner, for products by `plan`; `datum`, what is subtracted from all
  !> coefficients, length per force. Error: FUGE_ERR_MEMORY.
  subroutine compute_line_spectra(line, plan, influence, inverse, datum, info)
    type(halfplane_line), intent(in) :: line
    type(line_plan), intent(in) :: plan
    type(convolution_kernel), intent(inout) :: influence, inverse
    real(dp), intent(inout) :: datum
    type(fuge_info), intent(inout) :: info
    real(dp), allocatable :: inverse_spectrum(:)
    type(line_numbers), target :: numbers
    integer :: length, status

    length = plan%length
    call numbers%prepare(line, length, status)
    if (status == 0) allocate (inverse_spectrum(0:length/2), stat=status)
    if (status == 0) then
      call fill(numbers, .true., inverse_spectrum)
      call inverse%set_cyclic(length, inverse_spectrum, status)
    end if
    if (status == FUGE_DONE .and. line%boundary == FUGE_PERIODIC) then
      inverse_spectrum = (1.0_dp/real(length, dp))**2/inverse_spectrum
      if (.not. line%body%has_rigid_base()) inverse_spectrum(0) = 0.0_dp
      call influence%set_cyclic(length, inverse_spectrum, status)
    else if (status == FUGE_DONE) then
      deallocate (inverse_spectrum)
      call compute_free_spectrum(numbers, plan, influence, datum, status)
    end if
    if (status /= FUGE_DONE) call report(info, FUGE_ERR_MEMORY, 'out of memory: n = '//text(line%cells)//' needs ' &
                                         //text(48.0_dp*real(line%cells, dp))//' bytes')
  end subroutine compute_line_spectra

  !> The eigenvalues for a free surface, on a circle so long that the distance of any two cells is not
  !> shorter the other way round: ln of the distance the shorter way.
  !>
  !> The datum is the mean over the circle. Without it the eigenvalue of the constant, the sum of
  !> all coefficients, would be the largest by far, and so would its rounding error.
  subroutine compute_free_spectrum(numbers, plan, influence, datum, status)
    type(line_numbers), intent(in), target :: numbers
    type(line_plan), intent(in) :: plan
    type(convolution_kernel), intent(inout) :: influence
    real(dp), intent(inout) :: datum
    integer, intent(out) :: status
    real(dp), allocatable :: coefficient(:), even(:), odd(:)
    real(dp) :: factor, mean
    integer :: half

    half = plan%length
    allocate (coefficient(0:half), even(0:half/2), odd(half/2), stat=status)
    if (status /= 0) return
    call fill(numbers, .false., coefficient)
    mean = (coefficient(0) + coefficient(half) + 2.0_dp*compensated_sum(coefficient(1:half - 1)))/real(2*half, dp)
    call numbers%split(mean, factor, datum)
    coefficient = factor*(coefficient - mean)
    call transform_padded(plan, coefficient, even, odd, status)
    if (status /= FUGE_DONE) return
    even(0) = 0.0_dp
    call influence%set_padded(half, even, odd, status)
  end subroutine compute_free_spectrum

end module fuge_halfplane_spectra
