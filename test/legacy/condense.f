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

C     Three nodes in a row, two springs of stiffness 2, in bands of both
C     triangles. What is 9.D99 is not to be read.
      SUBROUTINE SPRING(UP, LOW)
      DOUBLE PRECISION UP(3,3), LOW(2,3)
      INTEGER J
      DO 10 J = 1, 3
        UP(1,J) = -2.D0
        UP(2,J) = 2.D0
        IF (J .EQ. 2) UP(2,J) = 4.D0
        UP(3,J) = 9.D99
        LOW(1,J) = UP(2,J)
        LOW(2,J) = -2.D0
   10 CONTINUE
      UP(1,1) = 9.D99
      LOW(2,3) = 9.D99
      END

C     Node 1 is moved by 0.5, node 3 loaded by 3, both towards the stops
C     before nodes 2 and 3, which push back: DN = -1.
      SUBROUTINE HELD
      DOUBLE PRECISION UP(3,3), LOW(2,3), P(3), DN(1,2)
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
      CALL SPRING(UP, LOW)
      DO 10 K = 1, 2
        MSG = 'old'
        ALPHA(3,1) = 7.D0
        IF (K .EQ. 1) CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, ALPHA, 3, B, R, 1, W, NHELD,
     $    MSG, INFO)
        IF (K .EQ. 2) CALL FUGECB('l', 3, 1, LOW, 2, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, ALPHA, 3, B, R, 1, W, NHELD,
     $    MSG, INFO)
        CALL STATUS('FUGECB', INFO, 0)
        CALL STATUS('FUGECB blank MSG', INDEX(MSG, 'old'), 0)
        CALL NUMBER('ALPHA(1,1)', ALPHA(1,1), 0.5D0, EPS)
        CALL NUMBER('ALPHA(2,1)', ALPHA(2,1), 0.5D0, EPS)
        CALL NUMBER('ALPHA(1,2)', ALPHA(1,2), 0.5D0, EPS)
        CALL NUMBER('ALPHA(2,2)', ALPHA(2,2), 1.D0, EPS)
        CALL NUMBER('ALPHA padding', ALPHA(3,1), 7.D0, 0.D0)
        CALL NUMBER('B(1)', B(1), -2.D0, 4*EPS)
        CALL NUMBER('B(2)', B(2), -3.5D0, 4*EPS)
C       With 1 and 2 on the stops the springs carry 0 and 1.
        IF (K .EQ. 1) CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (K .EQ. 2) CALL FUGERB('L', 3, 1, LOW, 2, 1, IFIX, UFIX, P,
     $    0, Z, 1, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        CALL STATUS('FUGERB', INFO, 0)
        CALL NUMBER('U(1)', U(1), 0.5D0, 0.D0)
        CALL NUMBER('U(2)', U(2), 0.5D0, 4*EPS)
        CALL NUMBER('U(3)', U(3), 1.D0, 4*EPS)
        CALL NUMBER('RESID', RESID, 0.D0, EPS)
   10 CONTINUE
      END

C     Nothing holds the row; node 1 is loaded by 4 and drives it against
C     stops before node 3, at once, and before node 1, at 1. Then the
C     springs are shortened by 1 and carry 1: F = (3, 1) and
C     U = (1, 0.5, 0).
      SUBROUTINE FLOATS
      DOUBLE PRECISION UP(3,3), LOW(2,3), P(3), DN(1,2), Z(4,1)
      DOUBLE PRECISION ALPHA(2,2), B(2), GAP(2), F(2), C(2), U(3), Q(1)
      DOUBLE PRECISION R(3,1), W(1), PLAY(2), UFIX(1), RESID, EPS
      INTEGER IFIX(1), IDOF(1,2), NSTOP(2), NHELD(1), NCON, NITER, INFO
      INTEGER K
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-14)
      DATA IDOF /1, 3/
      DATA DN /-1.D0, -1.D0/
      DATA P /4.D0, 0.D0, 0.D0/
      DATA Z /1.D0, 1.D0, 1.D0, 9.D99/
      DATA NSTOP /1, 1/
      CALL SPRING(UP, LOW)
      DO 10 K = 1, 2
        R(3,1) = 7.D0
        IF (K .EQ. 1) CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, ALPHA, 2, B, R, 3, W, NHELD,
     $    MSG, INFO)
        IF (K .EQ. 2) CALL FUGECB('L', 3, 1, LOW, 2, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, ALPHA, 2, B, R, 3, W, NHELD,
     $    MSG, INFO)
        CALL STATUS('FUGECB floats', INFO, 0)
        CALL NUMBER('R(1)', R(1,1), 1.D0, 0.D0)
        CALL NUMBER('R(2)', R(2,1), 1.D0, 0.D0)
        CALL NUMBER('R padding', R(3,1), 7.D0, 0.D0)
        CALL NUMBER('W', W(1), 4.D0, 0.D0)
        CALL STATUS('NHELD', NHELD(1), 0)
        GAP(1) = 1.D0 + B(1)
        GAP(2) = B(2)
        CALL FUGEGX(2, 1, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $              0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGEGX floats', INFO, 0)
        CALL NUMBER('F(1) floats', F(1), 3.D0, 16*EPS)
        CALL NUMBER('F(2) floats', F(2), 1.D0, 16*EPS)
        IF (K .EQ. 1) CALL FUGERB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        IF (K .EQ. 2) CALL FUGERB('L', 3, 1, LOW, 2, 0, IFIX, UFIX, P,
     $    1, Z, 4, 2, 1, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        CALL STATUS('FUGERB floats', INFO, 0)
        CALL NUMBER('U(1) floats', U(1), 1.D0, 16*EPS)
        CALL NUMBER('U(2) floats', U(2), 0.5D0, 16*EPS)
        CALL NUMBER('U(3) floats', U(3), 0.D0, 16*EPS)
   10 CONTINUE
C     Forces that do not balance the load.
      F(1) = 0.D0
      U(1) = 7.D0
      CALL FUGERB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, 1, Z, 4, 2, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB out of balance', INFO, -10)
      CALL HASTXT('FUGERB out of balance', MSG, 'rigid mode 1')
      CALL NUMBER('FUGERB out of balance, U', U(1), 7.D0, 0.D0)
C     It does float.
      CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, 0, Z, 4, 2, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB without motions', INFO, -9)
      END

C     A square frame with diagonals, on stops 0.25 below its two lower
C     nodes: they feel that it sinks and turns, not that it slides.
C     Loads of 3 and 1 on the upper nodes go down to the lower ones. The
C     band is as wide as the matrix.
      SUBROUTINE SLIDES
      DOUBLE PRECISION AB(8,8), P(8), Z(8,3), X(2,4), DN(1,3), UFIX(1)
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
      DATA AB /64*0.D0/
      DATA P /5*0.D0, -3.D0, 0.D0, -1.D0/
      DO 40 I = 1, 3
        DO 30 J = I + 1, 4
          D = (X(1,I) - X(1,J))**2 + (X(2,I) - X(2,J))**2
          DO 20 K = 1, 2
            DO 10 L = 1, 2
              CALL ADDBAR(AB, I, J, K, L, (X(K,I) - X(K,J))
     $                    *(X(L,I) - X(L,J))/D)
   10       CONTINUE
   20     CONTINUE
   30   CONTINUE
   40 CONTINUE
C     Two translations, and the rotation about the centre.
      DO 50 I = 1, 4
        Z(2*I-1,1) = 1.D0
        Z(2*I,1) = 0.D0
        Z(2*I-1,2) = 0.D0
        Z(2*I,2) = 1.D0
        Z(2*I-1,3) = 0.5D0 - X(2,I)
        Z(2*I,3) = X(1,I) - 0.5D0
   50 CONTINUE
C     The third point is out of reach: three motions need three points.
      CALL FUGECB('L', 8, 7, AB, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1,
     $            IDOF, DN, ALPHA, 3, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB slides', INFO, 0)
      CALL STATUS('NHELD(1) slides', NHELD(1), 1)
      CALL STATUS('NHELD(2) slides', NHELD(2), 0)
      CALL STATUS('NHELD(3) slides', NHELD(3), 0)
      CALL NUMBER('W(2) slides', W(2), -4.D0, EPS)
      CALL NUMBER('W(3) slides', W(3), -1.D0, EPS)
      DO 60 I = 1, 3
        GAP(I) = 0.25D0 + B(I)
        Q(I) = 0.D0
   60 CONTINUE
      GAP(3) = 9.D0
      CALL FUGEGX(3, 3, ALPHA, 3, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX slides', INFO, 0)
      CALL NUMBER('F(1) slides', F(1), 1.D0, EPS)
      CALL NUMBER('F(2) slides', F(2), 3.D0, EPS)
      CALL FUGERB('L', 8, 7, AB, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB slides', INFO, 0)
      CALL NUMBER('U(2) slides', U(2), -0.25D0, EPS)
      CALL NUMBER('U(4) slides', U(4), -0.25D0, EPS)
      CALL NUMBER('RESID slides', RESID, 0.D0, EPS)
C     A load that drives it along.
      P(1) = 1.D0
      NHELD(1) = 7
      CALL FUGECB('L', 8, 7, AB, 8, 0, IFIX, UFIX, P, 3, Z, 8, 3, 1,
     $            IDOF, DN, ALPHA, 3, B, R, 3, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB driven along', INFO, -10)
      CALL STATUS('FUGECB driven along, NHELD', NHELD(1), 7)
      END

C     A spring between nodes I and J in the stiffness matrix of a plane
C     frame, its part along axes K and L.
      SUBROUTINE ADDBAR(AB, I, J, K, L, C)
      DOUBLE PRECISION AB(8,8), C
      INTEGER I, J, K, L
      CALL ADDTO(AB, 2*I-2+K, 2*I-2+L, C)
      CALL ADDTO(AB, 2*J-2+K, 2*J-2+L, C)
      CALL ADDTO(AB, 2*I-2+K, 2*J-2+L, -C)
      CALL ADDTO(AB, 2*J-2+K, 2*I-2+L, -C)
      END

C     Add C to the coefficient (I,J) if it is in the lower triangle.
      SUBROUTINE ADDTO(AB, I, J, C)
      DOUBLE PRECISION AB(8,8), C
      INTEGER I, J
      IF (I .GE. J) AB(1+I-J,J) = AB(1+I-J,J) + C
      END

C     Two bodies on springs of stiffness 2 and 4 in one matrix, whose
C     band is the diagonal alone, and between them one contact of both:
C     DN = -1 and 1. A load of 3 on the first moves both by 0.5 and
C     leaves a contact force of 2.
      SUBROUTINE PAIR
      DOUBLE PRECISION AB(1,2), P(2), DN(2,1), ALPHA(1,1), B(1), F(1)
      DOUBLE PRECISION Z(1,1), R(1,1), W(1), Q(1), UFIX(1), U(2), C(1)
      DOUBLE PRECISION PLAY(1), RESID, EPS
      INTEGER IFIX(1), IDOF(2,1), NSTOP(1), NHELD(1), NCON, NITER, INFO
      CHARACTER*80 MSG
      PARAMETER (EPS=1.D-14)
      DATA AB /2.D0, 4.D0/
      DATA P /3.D0, 0.D0/
      DATA IDOF /1, 2/
      DATA DN /-1.D0, 1.D0/
      DATA NSTOP /1/
      CALL FUGECB('U', 2, 0, AB, 1, 0, IFIX, UFIX, P, 0, Z, 1, 1, 2,
     $            IDOF, DN, ALPHA, 1, B, R, 1, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB of a pair', INFO, 0)
      CALL NUMBER('ALPHA of a pair', ALPHA(1,1), 0.75D0, EPS)
      CALL NUMBER('B of a pair', B(1), -1.5D0, EPS)
      CALL FUGEGX(1, 0, ALPHA, 1, B, NSTOP, PLAY, R, 1, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX of a pair', INFO, 0)
      CALL NUMBER('F of a pair', F(1), 2.D0, 2*EPS)
      CALL FUGERB('U', 2, 0, AB, 1, 0, IFIX, UFIX, P, 0, Z, 1, 1, 2,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB of a pair', INFO, 0)
      CALL NUMBER('U(1) of a pair', U(1), 0.5D0, EPS)
      CALL NUMBER('U(2) of a pair', U(2), 0.5D0, EPS)
      END

C     A free beam of two elements, length 2, EI = 1: deflections and
C     rotations of three nodes. A force of 1 in the middle presses it on
C     stops at its ends, 0.25 and 0.5 below it: half each, and the
C     middle sinks by 0.375 and by 2**3/48.
      SUBROUTINE BEAM
      DOUBLE PRECISION AB(4,6), E(4,4), P(6), Z(6,2), DN(1,2), UFIX(1)
      DOUBLE PRECISION ALPHA(2,2), B(2), R(2,2), W(2), GAP(2), PLAY(2)
      DOUBLE PRECISION F(2), C(2), Q(2), U(6), RESID, EPS
      INTEGER IFIX(1), IDOF(1,2), NSTOP(2), NHELD(2), NCON, NITER, INFO
      INTEGER I, J, L
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
      CALL FUGEGX(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 2, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX of a beam', INFO, 0)
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
      DOUBLE PRECISION UP(3,3), LOW(2,3), P(3), DN(1,2), Z(3,1)
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
      CALL SPRING(UP, LOW)
      N = 2
C     Sizes.
      CALL FUGECB('U', 0, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, ND = 0', INFO, -1)
      CALL HASTXT('FUGECB, ND = 0', MSG, 'ND = 0')
      CALL FUGECB('U', 3, 1, UP, 3, -1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, NFIX < 0', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, 1, Z, 2, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, LDZ < ND', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, -1, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, M < 0', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, 3, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, M > N', INFO, -21)
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, 0, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, N = 0', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 0,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, NW = 0', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 1, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, LDA < N', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 3, 0, IFIX, UFIX, P, 1, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 1, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, LDR < N', INFO, -1)
      CALL FUGECB('U', 3, 1, UP, 1, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, LDAB < KD + 1', INFO, -1)
      CALL HASTXT('FUGECB, LDAB < KD + 1', MSG, 'LDAB = 1')
      CALL FUGECB('U', 3, -1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, KD < 0', INFO, -1)
      CALL FUGECB('X', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, UPLO = X', INFO, -14)
      CALL FUGERB('U', 3, 1, UP, 1, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, LDAB < KD + 1', INFO, -1)
C     Degrees of freedom that there are not.
      IFIX(1) = 4
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, IFIX = 4', INFO, -22)
      IFIX(1) = 1
      IDOF(1,2) = -1
      CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, IDOF = -1', INFO, -22)
      IDOF(1,2) = 3
C     NaN, one after the other.
      UFIX(1) = BAD
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, UFIX NaN', INFO, -3)
      UFIX(1) = 0.D0
      KEEP = DN(1,2)
      DN(1,2) = BAD
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, DN NaN', INFO, -3)
      DN(1,2) = KEEP
      F(2) = BAD
      CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, F NaN', INFO, -3)
      F(2) = 2.D0
      P(2) = BAD
      CALL FUGECB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, ALPHA, 2, B, R, 2, W, NHELD, MSG, INFO)
      CALL STATUS('FUGECB, P NaN', INFO, -3)
      CALL FUGERB('U', 3, 1, UP, 3, 1, IFIX, UFIX, P, 0, Z, 3, N, 1,
     $            IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB, P NaN', INFO, -3)
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
