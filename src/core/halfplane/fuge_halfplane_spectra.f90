!> The spectra of a line of cells on a half-plane: those of its influence matrix and of its preconditioner.
module fuge_halfplane_spectra
  use fuge_constants, only: PI
  use fuge_convolution, only: convolution_kernel, transform_padded
  use fuge_halfplane_line, only: halfplane_line, inverse_eigenvalue, log_of_distance, FUGE_PERIODIC
  use fuge_kinds, only: dp
  use fuge_line_plan, only: line_plan
  use fuge_number_text, only: text
  use fuge_point_chunks, only: chunked_pass
  use fuge_status, only: fuge_info, report, FUGE_DONE, FUGE_ERR_MEMORY
  implicit none
  private

  public :: compute_line_spectra, free_factor

  !> Fills `values`, of the numbers 0, 1, .., with the eigenvalues of the preconditioner on a circle of `length` cells,
  !> or without a length with the logarithms of distances. Threads share it, because each number takes long.
  type, extends(chunked_pass) :: fill_pass
    type(halfplane_line) :: line
    integer :: length = 0
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
      if (self%length > 0) then
        self%values(i) = inverse_eigenvalue(self%line, self%length, i - 1)
      else
        self%values(i) = log_of_distance(self%line, i - 1)
      end if
    end do
  end subroutine fill_chunk

  !> The `values` (n) of the pass.
  subroutine fill(line, length, values)
    type(halfplane_line), intent(in) :: line
    integer, intent(in) :: length
    real(dp), intent(out), contiguous, target :: values(:)
    type(fill_pass) :: pass

    pass%line = line
    pass%length = length
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
    integer :: length, status

    length = plan%length
    allocate (inverse_spectrum(0:length/2), stat=status)
    if (status == 0) then
      call fill(line, length, inverse_spectrum)
      call inverse%set_cyclic(length, inverse_spectrum, status)
    end if
    if (status == FUGE_DONE .and. line%boundary == FUGE_PERIODIC) then
      inverse_spectrum = (1.0_dp/real(length, dp))**2/inverse_spectrum
      inverse_spectrum(0) = 0.0_dp
      call influence%set_cyclic(length, inverse_spectrum, status)
    else if (status == FUGE_DONE) then
      deallocate (inverse_spectrum)
      call compute_free_spectrum(line, plan, influence, datum, status)
    end if
    if (status /= FUGE_DONE) call report(info, FUGE_ERR_MEMORY, 'out of memory: n = '//text(line%cells)//' needs ' &
                                         //text(48.0_dp*real(line%cells, dp))//' bytes')
  end subroutine compute_line_spectra

  !> The eigenvalues for a free surface, on a circle so long that the distance of any two cells is not
  !> shorter the other way round: ln of the distance the shorter way.
  !>
  !> The datum is the mean over the circle. Without it the eigenvalue of the constant, the sum of
  !> all coefficients, would be the largest by far, and so would its rounding error.
  subroutine compute_free_spectrum(line, plan, influence, datum, status)
    type(halfplane_line), intent(in) :: line
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
    call fill(line, 0, coefficient)
    mean = (coefficient(0) + coefficient(half) + 2.0_dp*sum(coefficient(1:half - 1)))/real(2*half, dp)
    call free_factor(line, mean, factor, datum)
    coefficient = factor*(coefficient - mean)
    call transform_padded(plan, coefficient, even, odd, status)
    if (status /= FUGE_DONE) return
    even(0) = 0.0_dp
    call influence%set_padded(half, even, odd, status)
  end subroutine compute_free_spectrum

  !> Coefficients of a free surface are `factor` times ln of the distance less its `mean`, which makes this `datum`.
  pure subroutine free_factor(line, mean, factor, datum)
    type(halfplane_line), intent(in) :: line
    real(dp), intent(in) :: mean
    real(dp), intent(out) :: factor, datum

    factor = -2.0_dp/(PI*line%e_star)
    ! In units of the spacing, as the coefficients: the D of the matrix is 2 n.
    datum = factor*(mean - log(2.0_dp*real(line%cells, dp)))
  end subroutine free_factor

end module fuge_halfplane_spectra
