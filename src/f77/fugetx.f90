!> FUGETX: the general meaning of a status, cut or filled with blanks. Arguments in doc/legacy.md.
subroutine fugetx(info, text)
  use fuge_status, only: fuge_status_text
  implicit none
  integer, intent(in) :: info
  character(len=*), intent(out) :: text

  text = fuge_status_text(info)
end subroutine fugetx
