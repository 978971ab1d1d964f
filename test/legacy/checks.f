C     Counted checks for the programs that call fuge as a FORTRAN 77
C     code does: no module, no interface, everything by address.

C     A number: equal to WANTED within TOL.
      SUBROUTINE NUMBER(WHAT, GOT, WANTED, TOL)
      CHARACTER*(*) WHAT
      DOUBLE PRECISION GOT, WANTED, TOL
      INTEGER NFAIL, NDONE
      COMMON /COUNTS/ NFAIL, NDONE
      NDONE = NDONE + 1
      IF (ABS(GOT - WANTED) .LE. TOL) RETURN
      NFAIL = NFAIL + 1
      WRITE (*, 100) WHAT, GOT, WANTED
  100 FORMAT (1X, A, ': ', 1PE24.16, ', expected ', 1PE24.16)
      END

C     A status.
      SUBROUTINE STATUS(WHAT, INFO, IWANT)
      CHARACTER*(*) WHAT
      INTEGER INFO, IWANT
      INTEGER NFAIL, NDONE
      COMMON /COUNTS/ NFAIL, NDONE
      NDONE = NDONE + 1
      IF (INFO .EQ. IWANT) RETURN
      NFAIL = NFAIL + 1
      WRITE (*, 100) WHAT, INFO, IWANT
  100 FORMAT (1X, A, ': INFO = ', I6, ', expected ', I6)
      END

C     A text that contains PART.
      SUBROUTINE HASTXT(WHAT, TEXT, PART)
      CHARACTER*(*) WHAT, TEXT, PART
      INTEGER NFAIL, NDONE
      COMMON /COUNTS/ NFAIL, NDONE
      NDONE = NDONE + 1
      IF (INDEX(TEXT, PART) .GT. 0) RETURN
      NFAIL = NFAIL + 1
      WRITE (*, 100) WHAT, TEXT, PART
  100 FORMAT (1X, A, ': "', A, '" has no "', A, '"')
      END

C     The end: a count, and a stop if anything failed.
      SUBROUTINE VERDCT
      INTEGER NFAIL, NDONE
      COMMON /COUNTS/ NFAIL, NDONE
      WRITE (*, 100) NDONE, NFAIL
  100 FORMAT (1X, I4, ' checks, ', I4, ' failed')
      IF (NDONE .EQ. 0 .OR. NFAIL .GT. 0) STOP 1
      END

      BLOCK DATA
      INTEGER NFAIL, NDONE
      COMMON /COUNTS/ NFAIL, NDONE
      DATA NFAIL, NDONE /0, 0/
      END
