C     A FORTRAN 77 finite element program calls fuge: no module, no
C     interface, arrays in COMMON, the stiffness matrix in LAPACK's band
C     storage.
C
C     A beam on two supports, length XL, sags under a uniform load onto
C     three rigid stops at its quarter points, all a distance CLEAR
C     below it.  Elements with cubic deflection are exact at the nodes,
C     and the stops are nodes, so that the reactions are known by hand:
C     with the beam's flexibilities between the stops
C
C                  ( 9 11  7)                               (57)
C         XL**3    (11 16 11),     deflection    P XL**4    (80)
C         ------   ( 7 11  9)      without stops ------- *  (57)
C         768 EI                                 6144 EI
C
C     first no stop carries, then the middle one alone, then all three.
C     With no clearance that is the beam on five supports, whose
C     reactions 8/7 and 13/14 of P XL/4 stand in every handbook.
C
C     N, mm.  Stops with an error if a number differs from the one by
C     hand.
      PROGRAM LEGFE
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      PARAMETER (NE=16, ND=2*(NE+1), KD=3, LDAB=KD+1, N=3)
      COMMON /BEAM/ XL, EI, CLEAR
      COMMON /STIFF/ AB(LDAB,ND), P(ND), UFIX(2), IFIX(2)
      COMMON /STOPS/ DN(N), ALPHA(N,N), B(N), IDOF(N)
      COMMON /TALLY/ WORST, NSAME
      XL = 8000.D0
      EI = 2.1D5*2.D7
      CLEAR = 5.D0
      NSAME = 0
      WORST = 0.D0
      CALL ASSEMB
      CALL CONDNS
      CALL TABLE
      WRITE (*, 100) NSAME, NSAME, WORST
  100 FORMAT (/, 'verdict: ', I2, ' of ', I2,
     $        ' as by hand, worst', 1PE8.1)
      END

C     Stiffness matrix, upper triangle by bands, and loads of a line
C     load of 1 N/mm.  Node I deflects by U(2*I-1), downwards positive,
C     and turns by U(2*I).
      SUBROUTINE ASSEMB
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      PARAMETER (NE=16, ND=2*(NE+1), KD=3, LDAB=KD+1)
      COMMON /BEAM/ XL, EI, CLEAR
      COMMON /STIFF/ AB(LDAB,ND), P(ND), UFIX(2), IFIX(2)
      DIMENSION S(4,4), Q(4)
      H = XL/NE
      CALL ELEMNT(H, EI, S, Q)
      DO 20 J = 1, ND
        P(J) = 0.D0
        DO 10 I = 1, LDAB
          AB(I,J) = 0.D0
   10   CONTINUE
   20 CONTINUE
      DO 50 L = 1, NE
        L0 = 2*(L - 1)
        DO 40 J = 1, 4
          P(L0+J) = P(L0+J) + Q(J)
          DO 30 I = 1, J
            AB(KD+1+I-J,L0+J) = AB(KD+1+I-J,L0+J) + S(I,J)
   30     CONTINUE
   40   CONTINUE
   50 CONTINUE
C     The supports at both ends.
      IFIX(1) = 1
      IFIX(2) = ND - 1
      UFIX(1) = 0.D0
      UFIX(2) = 0.D0
      END

C     One element of length H.
      SUBROUTINE ELEMNT(H, EI, S, Q)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(4,4), Q(4)
      C = EI/H**3
      S(1,1) = 12.D0*C
      S(1,2) = 6.D0*H*C
      S(1,3) = -12.D0*C
      S(1,4) = 6.D0*H*C
      S(2,2) = 4.D0*H*H*C
      S(2,3) = -6.D0*H*C
      S(2,4) = 2.D0*H*H*C
      S(3,3) = 12.D0*C
      S(3,4) = -6.D0*H*C
      S(4,4) = 4.D0*H*H*C
      Q(1) = H/2.D0
      Q(2) = H*H/12.D0
      Q(3) = H/2.D0
      Q(4) = -H*H/12.D0
      END

C     From the beam to its three stops.  They push it up, against the
C     positive sense of the deflections: DN = -1.  No rigid motions: the
C     supports hold the beam.
      SUBROUTINE CONDNS
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      PARAMETER (NE=16, ND=2*(NE+1), KD=3, LDAB=KD+1, N=3)
      EXTERNAL FUGECB
      COMMON /BEAM/ XL, EI, CLEAR
      COMMON /STIFF/ AB(LDAB,ND), P(ND), UFIX(2), IFIX(2)
      COMMON /STOPS/ DN(N), ALPHA(N,N), B(N), IDOF(N)
      CHARACTER*256 MSG
      DIMENSION Z(1,1), R(1,1), W(1), NHELD(1), IHAND(N,N)
      DATA IHAND /9, 11, 7, 11, 16, 11, 7, 11, 9/
      DO 10 I = 1, N
        IDOF(I) = 2*(1 + I*NE/4) - 1
        DN(I) = -1.D0
   10 CONTINUE
      CALL FUGECB('U', ND, KD, AB, LDAB, 2, IFIX, UFIX, P, 0, Z, 1,
     $            N, 1, IDOF, DN, ALPHA, N, B, R, 1, W, NHELD, MSG,
     $            INFO)
      IF (INFO .NE. 0) CALL QUIT('FUGECB', INFO, MSG)
      WRITE (*, 100)
      DO 20 I = 1, N
        WRITE (*, 110) (ALPHA(I,J)*768.D0*EI/XL**3, J = 1, N),
     $                 (IHAND(I,J), J = 1, N)
        DO 15 J = 1, N
          CALL SAME('ALPHA', ALPHA(I,J)*768.D0*EI/XL**3,
     $              DBLE(IHAND(I,J)), 16.D0)
   15   CONTINUE
   20 CONTINUE
  100 FORMAT (' Deflections at the stops by a force of 768 EI/L**3',
     $        ' at each of them, and by hand')
  110 FORMAT (3F10.5, 6X, 3I4)
      END

C     The load grows.  GAP is what is left of the clearance; the last
C     column is the deflection at an eighth of the span, from FUGERB.
      SUBROUTINE TABLE
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      PARAMETER (NE=16, ND=2*(NE+1), KD=3, LDAB=KD+1, N=3, NLOADS=6)
      EXTERNAL FUGEGX, FUGERB
      COMMON /BEAM/ XL, EI, CLEAR
      COMMON /STIFF/ AB(LDAB,ND), P(ND), UFIX(2), IFIX(2)
      COMMON /STOPS/ DN(N), ALPHA(N,N), B(N), IDOF(N)
      CHARACTER*256 MSG
      DIMENSION GAP(N), F(N), C(N), NSTOP(N), PLAY(N), PK(ND), U(ND)
      DIMENSION R(1,1), W(1), Q(1), NHELD(1), Z(1,1), XLOAD(NLOADS)
      DATA XLOAD /0.3D0, 1.D0, 3.D0, 6.D0, 12.D0, 24.D0/
      DATA NSTOP /N*1/
      WRITE (*, 100)
      DO 40 K = 1, NLOADS
        DO 10 I = 1, N
          GAP(I) = CLEAR + XLOAD(K)*B(I)
   10   CONTINUE
        CALL FUGEGX(N, 0, ALPHA, N, GAP, NSTOP, PLAY, R, 1, NHELD, W, Q,
     $              0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
        IF (INFO .NE. 0) CALL QUIT('FUGEGX', INFO, MSG)
        DO 20 I = 1, ND
          PK(I) = XLOAD(K)*P(I)
   20   CONTINUE
        CALL FUGERB('U', ND, KD, AB, LDAB, 2, IFIX, UFIX, PK, 0, Z, 1,
     $              N, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (INFO .NE. 0) CALL QUIT('FUGERB', INFO, MSG)
        CALL HAND(XLOAD(K), R1, R2, U8)
        UK = U(2*(1 + NE/8) - 1)
        WRITE (*, 110) XLOAD(K), F, R1, R2, C, UK
        TOTAL = XLOAD(K)*XL
        CALL SAME('F(1)', F(1), R1, TOTAL)
        CALL SAME('F(2)', F(2), R2, TOTAL)
        CALL SAME('F(3)', F(3), R1, TOTAL)
        CALL SAME('deflection', UK, U8, CLEAR)
        DO 30 I = 1, N
          CALL SAME('gap', CLEAR - U(IDOF(I)), C(I), CLEAR)
   30   CONTINUE
   40 CONTINUE
  100 FORMAT (/, '   load', 6X, 'reactions of the stops [N]', 13X,
     $        'by hand', 18X, 'gaps [mm]    at L/8', /,
     $        ' [N/mm]   quarter    middle   quarter   quarter',
     $        '    middle  quarter  middle quarter     [mm]')
  110 FORMAT (F7.1, 5F10.2, 1X, 3F8.4, F9.4)
      END

C     Reactions at the quarter points and in the middle, deflection at
C     XL/8, by hand.  D is the clearance as a load: the one under which
C     the middle of the beam without stops would sag by 80 CLEAR.
      SUBROUTINE HAND(P, R1, R2, U8)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      COMMON /BEAM/ XL, EI, CLEAR
      D = 6144.D0*CLEAR*EI/XL**4
      R1 = 0.D0
      R2 = 0.D0
      IF (32.D0*P .GT. 5.D0*D) THEN
        R1 = XL*(32.D0*P - 5.D0*D)/112.D0
        R2 = XL*(13.D0*P + 3.D0*D)/56.D0
      ELSE IF (80.D0*P .GT. D) THEN
        R2 = XL*(80.D0*P - D)/128.D0
      END IF
      X = XL/8.D0
      U8 = P*X*(XL**3 - 2.D0*XL*X**2 + X**3)/(24.D0*EI)
     $     - R1*(FLEX(X, XL/4.D0) + FLEX(X, 0.75D0*XL))
     $     - R2*FLEX(X, XL/2.D0)
      END

C     Deflection at X by a unit force at A, X .LE. A.
      DOUBLE PRECISION FUNCTION FLEX(X, A)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      COMMON /BEAM/ XL, EI, CLEAR
      BB = XL - A
      FLEX = BB*X*(XL**2 - BB**2 - X**2)/(6.D0*XL*EI)
      END

C     Equal to nine digits of SCALE?
      SUBROUTINE SAME(WHAT, GOT, WANTED, SCALE)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      CHARACTER*(*) WHAT
      COMMON /TALLY/ WORST, NSAME
      NSAME = NSAME + 1
      WORST = MAX(WORST, ABS(GOT - WANTED)/SCALE)
      IF (ABS(GOT - WANTED) .LE. 1.D-9*SCALE) RETURN
      WRITE (*, 100) WHAT, GOT, WANTED
      STOP 1
  100 FORMAT (1X, A, ' is ', 1PE23.15, ', by hand ', 1PE23.15)
      END

C     What went wrong, in words.
      SUBROUTINE QUIT(WHO, INFO, MSG)
      CHARACTER*(*) WHO, MSG
      CHARACTER*64 TEXT
      EXTERNAL FUGETX
      CALL FUGETX(INFO, TEXT)
      WRITE (*, 100) WHO, INFO, TEXT, MSG
      STOP 2
  100 FORMAT (1X, A, ': INFO =', I4, ', ', A, /, 1X, A)
      END
