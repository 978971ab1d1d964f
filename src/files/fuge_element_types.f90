!> The types of elements of Abaqus and CalculiX, such as C3D20R and CPE4: their families and numbers of nodes.
module fuge_element_types
  implicit none
  private

  public :: nodes_of_type, split_type, upper_case

  !> Families of types: unknown, others whose number of nodes is known, elements of a plane, solids, and shells with
  !> membranes and rigid faces.
  integer, parameter, public :: FAMILY_UNKNOWN = 0, FAMILY_OTHER = 1, FAMILY_PLANE = 2, FAMILY_SOLID = 3, &
    FAMILY_SHELL = 4

contains

  !> The family of a type in upper case, and the number of its nodes, 0 if the type is unknown.
  pure subroutine split_type(element_type, family, nodes)
    character(len=*), intent(in) :: element_type
    integer, intent(out) :: family, nodes
    character(len=3), parameter :: NAMES(8) = ['C3D', 'CPS', 'CPE', 'CAX', 'M3D', 'T3D', 'T2D', 'R3D']
    integer, parameter :: FAMILIES(8) = [FAMILY_SOLID, FAMILY_PLANE, FAMILY_PLANE, FAMILY_PLANE, FAMILY_SHELL, &
                                         FAMILY_OTHER, FAMILY_OTHER, FAMILY_SHELL]
    integer :: k, begin

    family = FAMILY_UNKNOWN
    begin = 4
    do k = 1, size(NAMES)
      if (index(element_type, NAMES(k)) == 1) family = FAMILIES(k)
    end do
    if (family == FAMILY_UNKNOWN .and. element_type(1:1) == 'S' .and. scan(element_type, '3468') == 2) then
      family = FAMILY_SHELL
      begin = 2
    end if
    nodes = 0
    if (family /= FAMILY_UNKNOWN) nodes = leading_number(element_type(begin:))
    ! The number of nodes of some types varies.
    if (nodes == 27 .or. index(element_type, 'V') > 0) nodes = 0
    if (nodes == 0) family = FAMILY_UNKNOWN
  end subroutine split_type

  !> The whole number at the beginning of a text, of one or two digits; 0 if there is none.
  pure function leading_number(text) result(number)
    character(len=*), intent(in) :: text
    integer :: number
    integer :: digits, k

    number = 0
    digits = verify(text//' ', '0123456789') - 1
    if (digits > 2) return
    do k = 1, digits
      number = 10*number + iachar(text(k:k)) - iachar('0')
    end do
  end function leading_number

  !> Number of nodes of an element; 0 if the type does not say.
  pure function nodes_of_type(element_type) result(nodes)
    character(len=*), intent(in) :: element_type
    integer :: nodes
    integer :: family

    call split_type(element_type, family, nodes)
  end function nodes_of_type

  !> The text with its letters in upper case.
  pure function upper_case(string) result(upper)
    character(len=*), intent(in) :: string
    character(len=len(string)) :: upper
    integer :: k

    upper = string
    do k = 1, len(string)
      if (string(k:k) >= 'a' .and. string(k:k) <= 'z') upper(k:k) = achar(iachar(string(k:k)) - 32)
    end do
  end function upper_case

end module fuge_element_types
