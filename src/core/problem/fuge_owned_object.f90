!> An object that one variable owns: a bitwise copy of the variable does not.
!>
!> Everyone who compiles a line that uses a type reads the types of its components, but not what extends them: a type
!> with an owner has the types that its procedures need in a submodule.
module fuge_owned_object
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_null_ptr, c_ptr
  implicit none
  private

  !> Extend it by the type of the object.
  type, abstract, public :: owned_object
  end type owned_object

  !> Refers to an object, and frees it if it is this variable that took it.
  type, public :: object_owner
    class(owned_object), pointer :: object => null()
    !> Address of the variable that owns the object.
    type(c_ptr), private :: owner = c_null_ptr
  contains
    procedure :: take
    procedure :: has_lent_to
    procedure :: move_from
    procedure :: clear
    final :: finish
  end type object_owner

contains

  !> Own `object` from now on.
  subroutine take(self, object)
    class(object_owner), intent(inout), target :: self
    class(owned_object), pointer, intent(in) :: object

    call self%clear()
    self%object => object
    self%owner = c_loc(self%owner)
  end subroutine take

  !> Is there an object that this variable owns?
  function owns(self)
    class(object_owner), intent(in), target :: self
    logical :: owns

    owns = .false.
    if (c_associated(self%owner)) owns = c_associated(self%owner, c_loc(self%owner))
  end function owns

  !> Is `copy` a bitwise copy of this variable, which refers to the object that this one owns?
  function has_lent_to(self, copy)
    class(object_owner), intent(inout) :: self
    class(object_owner), intent(in) :: copy
    logical :: has_lent_to

    has_lent_to = owns(self) .and. associated(self%object, copy%object)
  end function has_lent_to

  !> Take the object of `source`, which has none afterwards; none if `source` does not own it.
  subroutine move_from(self, source)
    class(object_owner), intent(inout) :: self, source

    call self%clear()
    if (.not. owns(source)) return
    call self%take(source%object)
    nullify (source%object)
    source%owner = c_null_ptr
  end subroutine move_from

  !> Free the object if this variable owns it, and refer to none.
  subroutine clear(self)
    class(object_owner), intent(inout) :: self

    if (owns(self)) deallocate (self%object)
    nullify (self%object)
    self%owner = c_null_ptr
  end subroutine clear

  impure elemental subroutine finish(self)
    type(object_owner), intent(inout) :: self

    call self%clear()
  end subroutine finish

end module fuge_owned_object
