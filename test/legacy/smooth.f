C     A smooth punch without a grid, whose profile is an EXTERNAL
C     subroutine; called without any interface.
      PROGRAM SMOOTH
      CALL ROLLER
      CALL TILTED
      CALL REFUSE
      CALL VERDCT
      END

C     A roller with the radius in COMMON. MODE 1 fails, 2 gives no slope.
      SUBROUTINE PARAB(N, X, GAP, SLOPE, IERR)
      INTEGER N, IERR, I
      DOUBLE PRECISION X(N), GAP(N), SLOPE(N), R
      INTEGER MODE
      COMMON /PUNCH/ R, MODE
      IF (MODE .EQ. 1) IERR = 42
      IF (MODE .EQ. 1) RETURN
      DO 10 I = 1, N
        GAP(I) = X(I)**2/(2.D0*R)
        IF (MODE .NE. 2) SLOPE(I) = X(I)/R
   10 CONTINUE
      END

C     Hertz, to twelve digits; places in the contact and outside.
      SUBROUTINE ROLLER
      INTEGER MODE, INFO
      DOUBLE PRECISION R, A, F0, X(4), P(4), C(4), XL, XR, V0, TILT,
     $                 EEND, EPRESS, RESID, T
      CHARACTER*256 MSG
      COMMON /PUNCH/ R, MODE
      EXTERNAL PARAB
      R = 50.D0
      MODE = 0
      F0 = 400.D0
      A = 2.D0*SQRT(F0*R/(4.D0*ATAN(1.D0)*1.D5))
      X(1) = 0.D0
      X(2) = 0.5D0*A
      X(3) = 1.5D0*A
      X(4) = 2.D0
      MSG = 'old'
      CALL FUGESP(PARAB, -2.D0, 2.D0, 1.D5, F0, 0, 0.D0, 4, X, P, C, XL,
     $            XR, V0, TILT, EEND, EPRESS, RESID, MSG, INFO)
      CALL STATUS('FUGESP', INFO, 0)
      CALL STATUS('FUGESP blank MSG', INDEX(MSG, 'old'), 0)
      CALL NUMBER('XLEFT', XL, -A, 1.D-12*A)
      CALL NUMBER('XRIGHT', XR, A, 1.D-12*A)
      CALL NUMBER('TILT', TILT, 0.D0, 0.D0)
      T = F0/(2.D0*ATAN(1.D0)*A)
      CALL NUMBER('P(1)', P(1), T, 1.D-12*T)
      CALL NUMBER('P(2)', P(2), T*SQRT(0.75D0), 1.D-12*T)
      CALL NUMBER('P(3)', P(3), 0.D0, 0.D0)
      CALL NUMBER('C(1)', C(1), 0.D0, 0.D0)
C     The gap beside the contact, in closed form.
      T = 1.5D0*SQRT(1.25D0) - LOG(1.5D0 + SQRT(1.25D0))
      CALL NUMBER('C(3)', C(3), T*A**2/(2.D0*R), 1.D-11*A**2/R)
      CALL NUMBER('EEND', EEND, 0.D0, 1.D-10)
      CALL NUMBER('EPRESS', EPRESS, 0.D0, 1.D-10)
      CALL NUMBER('RESID', RESID, 0.D0, 1.D-10)
C     No places, and no force: it touches.
      CALL FUGESP(PARAB, -2.D0, 2.D0, 1.D5, 0.D0, 0, 0.D0, 0, X, P, C,
     $            XL, XR, V0, TILT, EEND, EPRESS, RESID, MSG, INFO)
      CALL STATUS('no force', INFO, 0)
      CALL NUMBER('no force, XLEFT', XL, XR, 0.D0)
      END

C     A force beside the middle of a roller that may tilt: the same
C     contact under the force, which the tilt has moved there.
      SUBROUTINE TILTED
      INTEGER MODE, INFO
      DOUBLE PRECISION R, A, F0, X(1), P(1), C(1), XL, XR, V0, TILT,
     $                 EEND, EPRESS, RESID
      CHARACTER*256 MSG
      COMMON /PUNCH/ R, MODE
      EXTERNAL PARAB
      F0 = 400.D0
      A = 2.D0*SQRT(F0*R/(4.D0*ATAN(1.D0)*1.D5))
      X(1) = 0.25D0
      CALL FUGESP(PARAB, -2.D0, 2.D0, 1.D5, F0, 1, 0.25D0*F0, 1, X, P,
     $            C, XL, XR, V0, TILT, EEND, EPRESS, RESID, MSG, INFO)
      CALL STATUS('tilted', INFO, 0)
      CALL NUMBER('tilted, XLEFT', XL, 0.25D0 - A, 1.D-12)
      CALL NUMBER('tilted, XRIGHT', XR, 0.25D0 + A, 1.D-12)
      CALL NUMBER('tilted, TILT', TILT, 0.25D0/R, 1.D-12/R)
      CALL NUMBER('tilted, P', P(1), F0/(2.D0*ATAN(1.D0)*A), 1.D-8)
      END

C     Every refusal has a message and leaves the outputs alone.
      SUBROUTINE REFUSE
      INTEGER MODE, INFO, K, NX, IWANT(9)
      DOUBLE PRECISION R, F0, X(2), XMIN, XMAX, ESTAR, OUT(9)
      CHARACTER*256 MSG
      CHARACTER*14 PART(9)
      COMMON /PUNCH/ R, MODE
      EXTERNAL PARAB
      DATA IWANT /-17, -17, -4, -5, -10, -15, -1, -4, -4/
      DATA PART /'42', 'slope', 'lower', 'e_star', 'negative', 'end',
     $           'NX = -1', 'X(2) = 3', 'lower'/
      DO 20 K = 1, 9
        MODE = 0
        XMIN = -2.D0
        XMAX = 2.D0
        ESTAR = 1.D5
        F0 = 400.D0
        NX = 2
        X(1) = 0.D0
        X(2) = 1.D0
        IF (K .LE. 2) MODE = K
        IF (K .EQ. 3) XMIN = 2.D0
        IF (K .EQ. 4) ESTAR = 0.D0
        IF (K .EQ. 5) F0 = -1.D0
        IF (K .EQ. 6) F0 = 4.D4
        IF (K .EQ. 7) NX = -1
        IF (K .EQ. 8) X(2) = 3.D0
        IF (K .EQ. 9) XMAX = -2.D0
        DO 10 I = 1, 9
          OUT(I) = 77.D0
   10   CONTINUE
        CALL FUGESP(PARAB, XMIN, XMAX, ESTAR, F0, 0, 0.D0, NX, X, OUT,
     $    OUT(3), OUT(5), OUT(5), OUT(6), OUT(7), OUT(8), OUT(9),
     $    OUT(9), MSG, INFO)
        CALL STATUS('FUGESP '//PART(K), INFO, IWANT(K))
        CALL HASTXT('FUGESP', MSG, PART(K)(:INDEX(PART(K)//'  ',
     $    '  ')-1))
        DO 15 I = 1, 9
          CALL NUMBER('untouched', OUT(I), 77.D0, 0.D0)
   15   CONTINUE
   20 CONTINUE
      END
