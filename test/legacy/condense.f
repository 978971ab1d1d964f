C     The external procedures that condense and recover, called without
C     any interface: springs in a row, answers by hand.
      PROGRAM CONDNS
      CALL HELD
      CALL FLOATS
      CALL SLIDES
      CALL PAIR
      CALL BEAM
      CALL REFUSE
      CALL VERDCT
      END

C     Three nodes in a row, two springs of stiffness 2, in full storage
C     and in bands of both triangles. What is 9.D99 is not to be read.
      SUBROUTINE SPRING(S, UP, LOW)
      DOUBLE PRECISION S(4,3), UP(3,3), LOW(2,3)
      INTEGER I, J
      DO 20 J = 1, 3
        DO 10 I = 1, 4
          S(I,J) = 0.D0
          IF (I .EQ. J) S(I,J) = 2.D0
          IF (I .EQ. 2 .AND. J .EQ. 2) S(I,J) = 4.D0
          IF (ABS(I - J) .EQ. 1) S(I,J) = -2.D0
          IF (I .EQ. 4) S(I,J) = 9.D99
   10   CONTINUE
        UP(1,J) = -2.D0
        UP(2,J) = S(J,J)
        UP(3,J) = 9.D99
        LOW(1,J) = S(J,J)
        LOW(2,J) = -2.D0
   20 CONTINUE
      UP(1,1) = 9.D99
      LOW(2,3) = 9.D99
      END

C     Node 1 is moved by 0.5, node 3 loaded by 3, both towards the stops
C     before nodes 2 and 3, which push back: DN = -1.
      SUBROUTINE HELD
      DOUBLE PRECISION S(4,3), UP(3,3), LOW(2,3), P(3), DN(1,2)
      DOUBLE PRECISION ALPHA(3,2), B(2), F(2), U(3), Q(1), RESID, EPS
      DOUBLE PRECISION R(1,1), W(1), Z(1,1), UFIX(1)
      INTEGER IFIX(1), IDOF(1,2), NHELD(1), INFO, K
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-14)
      DATA IFIX /1/
      DATA UFIX /0.5D0/
      DATA IDOF /2, 3/
      DATA DN /-1.D0, -1.D0/
      DATA P /0.D0, 0.D0, 3.D0/
      DATA F /1.D0, 2.D0/
      CALL SPRING(S, UP, LOW)
      DO 10 K = 1, 3
        MSG = 'old'
        ALPHA(3,1) = 7.D0
        IF (K .EQ. 1) CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 1,
     $    2, 1, IDOF, DN, ALPHA, 3, B, R, 1, W, NHELD,
     $    MSG, INFO)
        IF (K .EQ. 2) CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, ALPHA, 3, B, R, 1, W, NHELD,
     $    MSG, INFO)
        IF (K .EQ. 3) CALL FUGECB('l', 3, 1, LOW, 2, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, ALPHA, 3, B, R, 1, W, NHELD,
     $    MSG, INFO)
        CALL STATUS('FUGEC', INFO, 0)
        CALL STATUS('FUGEC blank MSG', INDEX(MSG, 'old'), 0)
        CALL NUMBER('ALPHA(1,1)', ALPHA(1,1), 0.5D0, EPS)
        CALL NUMBER('ALPHA(2,1)', ALPHA(2,1), 0.5D0, EPS)
        CALL NUMBER('ALPHA(1,2)', ALPHA(1,2), 0.5D0, EPS)
        CALL NUMBER('ALPHA(2,2)', ALPHA(2,2), 1.D0, EPS)
        CALL NUMBER('ALPHA padding', ALPHA(3,1), 7.D0, 0.D0)
        CALL NUMBER('B(1)', B(1), -2.D0, 4*EPS)
        CALL NUMBER('B(2)', B(2), -3.5D0, 4*EPS)
C       With 1 and 2 on the stops the springs carry 0 and 1.
        IF (K .EQ. 1) CALL FUGERD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 1,
     $    2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (K .EQ. 2) CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (K .EQ. 3) CALL FUGERB('L', 3, 1, LOW, 2, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        CALL STATUS('FUGER', INFO, 0)
        CALL NUMBER('U(1)', U(1), 0.5D0, 0.D0)
        CALL NUMBER('U(2)', U(2), 0.5D0, 4*EPS)
        CALL NUMBER('U(3)', U(3), 1.D0, 4*EPS)
        CALL NUMBER('RESID', RESID, 0.D0, EPS)
   10 CONTINUE
      END

C     Nothing holds the row; node 1 is loaded by 4 and drives it against
C     stops before node 3, at once, and before node 1, at 1. Then the
C     springs are shortened by 1 and carry 1: F = (3, 1), U = (1, .5, 0).
      SUBROUTINE FLOATS
      DOUBLE PRECISION S(4,3), UP(3,3), LOW(2,3), P(3), DN(1,2), Z(4,1)
      DOUBLE PRECISION ALPHA(2,2), B(2), GAP(2), F(2), C(2), U(3), Q(1)
      DOUBLE PRECISION R(3,1), W(1), PLAY(2), UFIX(1), RESID, EPS
      INTEGER IFIX(1), IDOF(1,2), NSTOP(2), NHELD(1), INFO, K
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-14)
      DATA IDOF /1, 3/
      DATA DN /-1.D0, -1.D0/
      DATA P /4.D0, 0.D0, 0.D0/
      DATA Z /1.D0, 1.D0, 1.D0, 9.D99/
      DATA NSTOP /1, 1/
      CALL SPRING(S, UP, LOW)
      DO 10 K = 1, 2
        R(3,1) = 7.D0
        IF (K .EQ. 1) CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, 1, Z, 4,
     $    2, 1, IDOF, DN, ALPHA, 2, B, R, 3, W, NHELD,
     $    MSG, INFO)
        IF (K .EQ. 2) CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, ALPHA, 2, B, R, 3, W, NHELD,
     $    MSG, INFO)
        CALL STATUS('FUGEC floats', INFO, 0)
        CALL NUMBER('R(1)', R(1,1), 1.D0, 0.D0)
        CALL NUMBER('R(2)', R(2,1), 1.D0, 0.D0)
        CALL NUMBER('R padding', R(3,1), 7.D0, 0.D0)
        CALL NUMBER('W', W(1), 4.D0, 0.D0)
        CALL STATUS('NHELD', NHELD(1), 0)
        GAP(1) = 1.D0 + B(1)
        GAP(2) = B(2)
        CALL FUGEGV(2, 1, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, W, F, C, Q,
     $              INFO)
        CALL STATUS('FUGEGV floats', INFO, 0)
        CALL NUMBER('F(1) floats', F(1), 3.D0, 16*EPS)
        CALL NUMBER('F(2) floats', F(2), 1.D0, 16*EPS)
        IF (K .EQ. 1) CALL FUGERD(3, S, 4, 0, IFIX, UFIX, P, 1, Z, 4,
     $    2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (K .EQ. 2) CALL FUGERB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        CALL STATUS('FUGER floats', INFO, 0)
        CALL NUMBER('U(1) floats', U(1), 1.D0, 16*EPS)
        CALL NUMBER('U(2) floats', U(2), 0.5D0, 16*EPS)
        CALL NUMBER('U(3) floats', U(3), 0.D0, 16*EPS)
   10 CONTINUE
C     Forces that do not balance the load.
      F(1) = 0.D0
      U(1) = 7.D0
      CALL FUGERD(3, S, 4, 0, IFIX, UFIX, P, 1, Z, 4, 2, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD out of balance', INFO, -10)
      CALL HASTXT('FUGERD out of balance', MSG, 'rigid mode 1')
      CALL NUMBER('FUGERD out of balance, U', U(1), 7.D0, 0.D0)
C     It does float.
      CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, 0, Z, 4, 2, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD without motions', INFO, -9)
      END

C     A square frame with diagonals, on stops 0.25 below its two lower
C     nodes: they feel that it sinks and turns, not that it slides. Loads
C     of 3 and 1 on the upper nodes go down to the lower ones.
      SUBROUTINE SLIDES
      DOUBLE PRECISION S(8,8), P(8), Z(8,3), X(2,4), DN(1,3), UFIX(1)
      DOUBLE PRECISION ALPHA(3,3), B(3), R(3,3), W(3), GAP(3), PLAY(3)
      DOUBLE PRECISION F(3), C(3), Q(3), U(8), RESID, D, EPS
      INTEGER IFIX(1), IDOF(1,3), NSTOP(3), NHELD(3), NCON, NITER, INFO
      INTEGER I, J, K, L
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-13)
      DATA X /0.D0, 0.D0,  1.D0, 0.D0,  1.D0, 1.D0,  0.D0, 1.D0/
      DATA IDOF /2, 4, 6/
      DATA DN /3*1.D0/
      DATA NSTOP /3*1/
      DATA S /64*0.D0/
      DATA P /5*0.D0, -3.D0, 0.D0, -1.D0/
      DO 40 I = 1, 3
        DO 30 J = I + 1, 4
          D = (X(1,I) - X(1,J))**2 + (X(2,I) - X(2,J))**2
          DO 20 K = 1, 2
            DO 10 L = 1, 2
              CALL ADDBAR(S, I, J, K, L, (X(K,I) - X(K,J))
     $                    *(X(L,I) - X(L,J))/D)
   10       CONTINUE
   20     CONTINUE
   30   CONTINUE
   40 CONTINUE
      CALL FUGERM(2, 4, X, Z, 8, INFO)
      CALL STATUS('FUGERM', INFO, 0)
      CALL NUMBER('FUGERM Z(1,1)', Z(1,1), 1.D0, 0.D0)
      CALL NUMBER('FUGERM Z(2,1)', Z(2,1), 0.D0, 0.D0)
      CALL NUMBER('FUGERM Z(2,2)', Z(2,2), 1.D0, 0.D0)
      CALL NUMBER('FUGERM Z(3,3)', Z(3,3), 0.5D0, 0.D0)
      CALL NUMBER('FUGERM Z(4,3)', Z(4,3), 0.5D0, 0.D0)
C     The third point is out of reach: three motions need three points.
      CALL FUGECD(8, S, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1, IDOF, DN,
     $            ALPHA, 3, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD slides', INFO, 0)
      CALL STATUS('NHELD(1) slides', NHELD(1), 1)
      CALL STATUS('NHELD(2) slides', NHELD(2), 0)
      CALL STATUS('NHELD(3) slides', NHELD(3), 0)
      CALL NUMBER('W(2) slides', W(2), -4.D0, EPS)
      CALL NUMBER('W(3) slides', W(3), -1.D0, EPS)
      DO 50 I = 1, 3
        GAP(I) = 0.25D0 + B(I)
        Q(I) = 0.D0
   50 CONTINUE
      GAP(3) = 9.D0
      CALL FUGEGX(3, 3, ALPHA, 3, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX slides', INFO, 0)
      CALL NUMBER('F(1) slides', F(1), 1.D0, EPS)
      CALL NUMBER('F(2) slides', F(2), 3.D0, EPS)
      CALL FUGERD(8, S, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD slides', INFO, 0)
      CALL NUMBER('U(2) slides', U(2), -0.25D0, EPS)
      CALL NUMBER('U(4) slides', U(4), -0.25D0, EPS)
      CALL NUMBER('RESID slides', RESID, 0.D0, EPS)
C     A load that drives it along.
      P(1) = 1.D0
      NHELD(1) = 7
      CALL FUGECD(8, S, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1, IDOF, DN,
     $            ALPHA, 3, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD driven along', INFO, -10)
      CALL STATUS('FUGECD driven along, NHELD', NHELD(1), 7)
C     What FUGERM refuses.
      Z(1,1) = 7.D0
      CALL FUGERM(1, 4, X, Z, 8, INFO)
      CALL STATUS('FUGERM, NDIM = 1', INFO, -1)
      CALL FUGERM(2, 0, X, Z, 8, INFO)
      CALL STATUS('FUGERM, NN = 0', INFO, -1)
      CALL FUGERM(2, 4, X, Z, 7, INFO)
      CALL STATUS('FUGERM, LDZ < 2 NN', INFO, -1)
      CALL FUGERM(3, 2000000000, X, Z, 8, INFO)
      CALL STATUS('FUGERM, NN large', INFO, -1)
      CALL FUGERX(1, 4, X, Z, 8, MSG, INFO)
      CALL STATUS('FUGERX, NDIM = 1', INFO, -1)
      CALL HASTXT('FUGERX, NDIM = 1', MSG, 'NDIM = 1')
      CALL FUGERX(2, 0, X, Z, 8, MSG, INFO)
      CALL STATUS('FUGERX, NN = 0', INFO, -1)
      CALL HASTXT('FUGERX, NN = 0', MSG, 'NN = 0')
      CALL FUGERX(2, 4, X, Z, 7, MSG, INFO)
      CALL STATUS('FUGERX, LDZ < 2 NN', INFO, -1)
      CALL HASTXT('FUGERX, LDZ < 2 NN', MSG, 'LDZ = 7')
      CALL NUMBER('FUGERM untouched', Z(1,1), 7.D0, 0.D0)
C     FUGERX is FUGERM with a message, which is blank where all is well.
      CALL FUGERX(2, 4, X, Z, 8, MSG, INFO)
      CALL STATUS('FUGERX', INFO, 0)
      CALL NUMBER('FUGERX Z(3,3)', Z(3,3), 0.5D0, 0.D0)
      CALL STATUS('FUGERX blank MSG', INDEX(MSG, 'LDZ'), 0)
      END

C     A spring between nodes I and J in the stiffness matrix of a plane
C     frame, its part along axes K and L.
      SUBROUTINE ADDBAR(S, I, J, K, L, C)
      DOUBLE PRECISION S(8,8), C
      INTEGER I, J, K, L
      S(2*I-2+K,2*I-2+L) = S(2*I-2+K,2*I-2+L) + C
      S(2*J-2+K,2*J-2+L) = S(2*J-2+K,2*J-2+L) + C
      S(2*I-2+K,2*J-2+L) = S(2*I-2+K,2*J-2+L) - C
      S(2*J-2+K,2*I-2+L) = S(2*J-2+K,2*I-2+L) - C
      END

C     Two bodies on springs of stiffness 2 and 4 in one matrix, between
C     them one contact of both: DN = -1 and 1. A load of 3 on the first
C     moves both by 0.5 and leaves a contact force of 2.
      SUBROUTINE PAIR
      DOUBLE PRECISION S(2,2), P(2), DN(2,1), ALPHA(1,1), B(1), F(1)
      DOUBLE PRECISION Z(1,1), R(1,1), W(1), Q(1), UFIX(1), U(2), C(1)
      DOUBLE PRECISION PLAY(1), RESID, EPS
      INTEGER IFIX(1), IDOF(2,1), NSTOP(1), NHELD(1), INFO
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-14)
      DATA S /2.D0, 0.D0, 0.D0, 4.D0/
      DATA P /3.D0, 0.D0/
      DATA IDOF /1, 2/
      DATA DN /-1.D0, 1.D0/
      DATA NSTOP /1/
      CALL FUGECD(2, S, 2, 0, IFIX, UFIX, P, 0, Z, 1, 1, 2, IDOF, DN,
     $            ALPHA, 1, B, R, 1, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD of a pair', INFO, 0)
      CALL NUMBER('ALPHA of a pair', ALPHA(1,1), 0.75D0, EPS)
      CALL NUMBER('B of a pair', B(1), -1.5D0, EPS)
      CALL FUGEGV(1, 0, ALPHA, 1, B, NSTOP, PLAY, R, 1, W, F, C, Q,
     $            INFO)
      CALL NUMBER('F of a pair', F(1), 2.D0, 2*EPS)
      CALL FUGERD(2, S, 2, 0, IFIX, UFIX, P, 0, Z, 1, 1, 2, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD of a pair', INFO, 0)
      CALL NUMBER('U(1) of a pair', U(1), 0.5D0, EPS)
      CALL NUMBER('U(2) of a pair', U(2), 0.5D0, EPS)
      END

C     A free beam of two elements, length 2, EI = 1: deflections and
C     rotations of three nodes. A force of 1 in the middle presses it on
C     stops at its ends, 0.25 and 0.5 below it: half each, and the middle
C     sinks by 0.375 and by 2**3/48.
      SUBROUTINE BEAM
      DOUBLE PRECISION AB(4,6), E(4,4), P(6), Z(6,2), DN(1,2), UFIX(1)
      DOUBLE PRECISION ALPHA(2,2), B(2), R(2,2), W(2), GAP(2), PLAY(2)
      DOUBLE PRECISION F(2), C(2), Q(2), U(6), RESID, EPS
      INTEGER IFIX(1), IDOF(1,2), NSTOP(2), NHELD(2), INFO, I, J, L
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-13)
      DATA E /12.D0, 6.D0, -12.D0, 6.D0,  6.D0, 4.D0, -6.D0, 2.D0,
     $       -12.D0, -6.D0, 12.D0, -6.D0,  6.D0, 2.D0, -6.D0, 4.D0/
      DATA AB /24*0.D0/
      DATA P /0.D0, 0.D0, 1.D0, 0.D0, 0.D0, 0.D0/
      DATA Z /1.D0, 0.D0, 1.D0, 0.D0, 1.D0, 0.D0,
     $        0.D0, 1.D0, 1.D0, 1.D0, 2.D0, 1.D0/
      DATA IDOF /1, 5/
      DATA DN /-1.D0, -1.D0/
      DATA NSTOP /1, 1/
      DO 30 L = 0, 2, 2
        DO 20 J = 1, 4
          DO 10 I = J, 4
            AB(1+I-J,L+J) = AB(1+I-J,L+J) + E(I,J)
   10     CONTINUE
   20   CONTINUE
   30 CONTINUE
      CALL FUGECB('L', 6, 3, AB, 4, 0, IFIX, UFIX, P, 2, Z, 6, 2, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB of a beam', INFO, 0)
      CALL NUMBER('R(2,1) of a beam', R(2,1), 1.D0, EPS)
      CALL NUMBER('R(1,2) of a beam', R(1,2), 0.D0, EPS)
      CALL NUMBER('R(2,2) of a beam', R(2,2), 2.D0, EPS)
      CALL STATUS('NHELD of a beam', NHELD(1) + NHELD(2), 0)
      CALL NUMBER('W(1) of a beam', W(1), 1.D0, EPS)
      CALL NUMBER('W(2) of a beam', W(2), 1.D0, EPS)
      GAP(1) = 0.25D0 + B(1)
      GAP(2) = 0.5D0 + B(2)
      CALL FUGEGV(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 2, W, F, C, Q,
     $            INFO)
      CALL STATUS('FUGEGV of a beam', INFO, 0)
      CALL NUMBER('F(1) of a beam', F(1), 0.5D0, EPS)
      CALL NUMBER('F(2) of a beam', F(2), 0.5D0, EPS)
      CALL FUGERB('L', 6, 3, AB, 4, 0, IFIX, UFIX, P, 2, Z, 6, 2, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB of a beam', INFO, 0)
      CALL NUMBER('U(1) of a beam', U(1), 0.25D0, EPS)
      CALL NUMBER('U(2) of a beam', U(2), 0.125D0 + 0.25D0, EPS)
      CALL NUMBER('U(3) of a beam', U(3), 0.375D0 + 1.D0/6.D0, EPS)
      CALL NUMBER('U(4) of a beam', U(4), 0.125D0, EPS)
      CALL NUMBER('U(5) of a beam', U(5), 0.5D0, EPS)
      CALL NUMBER('U(6) of a beam', U(6), 0.125D0 - 0.25D0, EPS)
      CALL NUMBER('RESID of a beam', RESID, 0.D0, EPS)
      END

C     Every refusal leaves the outputs alone.
      SUBROUTINE REFUSE
      DOUBLE PRECISION S(4,3), UP(3,3), LOW(2,3), P(3), DN(1,2), Z(3,1)
      DOUBLE PRECISION ALPHA(2,2), B(2), R(2,1), W(1), UFIX(1), RESID
      DOUBLE PRECISION F(2), Q(1), U(3), BAD, KEEP
      INTEGER IFIX(1), IDOF(1,2), NHELD(1), INFO, I, N, NBITS(2)
      CHARACTER*80 MSG
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA IFIX /1/
      DATA UFIX /0.D0/
      DATA IDOF /2, 3/
      DATA DN /-1.D0, -1.D0/
      DATA P /0.D0, 0.D0, 3.D0/
      DATA Z /1.D0, 1.D0, 1.D0/
      DATA F /1.D0, 2.D0/
      DATA Q /0.D0/
      DATA ALPHA, B, R, W, U, RESID /13*7.D0/
      DATA NHELD /7/
      CALL SPRING(S, UP, LOW)
      N = 2
C     Sizes.
      CALL FUGECD(0, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, ND = 0', INFO, -1)
      CALL HASTXT('FUGECD, ND = 0', MSG, 'ND = 0')
      CALL FUGECD(3, S, 2, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, LDS < ND', INFO, -1)
      CALL HASTXT('FUGECD, LDS < ND', MSG, 'LDS = 2')
      CALL FUGECD(3, S, 4, -1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, NFIX < 0', INFO, -1)
      CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, 1, Z, 2, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, LDZ < ND', INFO, -1)
      CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, -1, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, M < 0', INFO, -1)
      CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, 3, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, M > N', INFO, -21)
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, 0, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, N = 0', INFO, -1)
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 0, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, NW = 0', INFO, -1)
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 1, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, LDA < N', INFO, -1)
      CALL FUGECD(3, S, 4, 0, IFIX, UFIX, P, 1, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 1, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, LDR < N', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 1, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, LDAB < KD + 1', INFO, -1)
      CALL FUGECB('U', 3, -1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, KD < 0', INFO, -1)
      CALL FUGECB('X', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, UPLO = X', INFO, -14)
      CALL FUGERB('U', 3, 1, UP, 1, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, LDAB < KD + 1', INFO, -1)
      CALL FUGERD(3, S, 2, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD, LDS < ND', INFO, -1)
C     Degrees of freedom that there are not.
      IFIX(1) = 4
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, IFIX = 4', INFO, -22)
      IFIX(1) = 1
      IDOF(1,2) = -1
      CALL FUGERD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD, IDOF = -1', INFO, -22)
      IDOF(1,2) = 3
C     NaN, one after the other.
      U(2) = BAD
      CALL FUGERM(3, 1, U, Z, 3, INFO)
      CALL STATUS('FUGERM, X NaN', INFO, -3)
      CALL FUGERX(3, 1, U, Z, 3, MSG, INFO)
      CALL STATUS('FUGERX, X NaN', INFO, -3)
      CALL HASTXT('FUGERX, X NaN', MSG, 'node 1')
      U(2) = 7.D0
      CALL NUMBER('FUGERM, X NaN, Z', Z(1,1), 1.D0, 0.D0)
      UFIX(1) = BAD
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, UFIX NaN', INFO, -3)
      UFIX(1) = 0.D0
      KEEP = DN(1,2)
      DN(1,2) = BAD
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, DN NaN', INFO, -3)
      DN(1,2) = KEEP
      F(2) = BAD
      CALL FUGERD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD, F NaN', INFO, -3)
      F(2) = 2.D0
      P(2) = BAD
      CALL FUGECD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECD, P NaN', INFO, -3)
      CALL FUGERD(3, S, 4, 1, IFIX, UFIX, P, 0, Z, 3, N, 1, IDOF, DN,
     $            F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERD, P NaN', INFO, -3)
      P(2) = 0.D0
      UP(2,2) = BAD
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, AB NaN', INFO, -3)
      CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, AB NaN', INFO, -3)
      DO 10 I = 1, 2
        CALL NUMBER('ALPHA untouched', ALPHA(I,1), 7.D0, 0.D0)
        CALL NUMBER('ALPHA untouched', ALPHA(I,2), 7.D0, 0.D0)
        CALL NUMBER('B untouched', B(I), 7.D0, 0.D0)
        CALL NUMBER('R untouched', R(I,1), 7.D0, 0.D0)
   10 CONTINUE
      DO 20 I = 1, 3
        CALL NUMBER('U untouched', U(I), 7.D0, 0.D0)
   20 CONTINUE
      CALL NUMBER('W untouched', W(1), 7.D0, 0.D0)
      CALL STATUS('NHELD untouched', NHELD(1), 7)
      CALL NUMBER('RESID untouched', RESID, 7.D0, 0.D0)
      END
