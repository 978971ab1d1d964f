C     Contact pairs of two surfaces, called without any interface: two
C     blocks whose meshes do not match are pressed together, and what is
C     refused.
      PROGRAM PAIRS
      CALL BLOCKS
      CALL KINDS
      CALL SPACE
      CALL BENT
      CALL RINGS
      CALL REFUSE
      CALL VERDCT
      END

C     Stiffness of a rectangle HX by HY of four nodes, counter-clockwise
C     from the lower left one, in plane strain, depth 1.
      SUBROUTINE QUAD(HX, HY, E, V, S)
      DOUBLE PRECISION HX, HY, E, V, S(8,8)
      DOUBLE PRECISION B(3,8), D(3,3), P, Q, C, G, T
      INTEGER I, J, K, L, M
      C = E/((1.D0 + V)*(1.D0 - 2.D0*V))
      DO 10 I = 1, 3
        D(I,1) = 0.D0
        D(I,2) = 0.D0
        D(I,3) = 0.D0
   10 CONTINUE
      D(1,1) = C*(1.D0 - V)
      D(2,2) = D(1,1)
      D(1,2) = C*V
      D(2,1) = D(1,2)
      D(3,3) = 0.5D0*E/(1.D0 + V)
      DO 20 J = 1, 8
        DO 20 I = 1, 8
          S(I,J) = 0.D0
   20 CONTINUE
      G = 1.D0/SQRT(3.D0)
      DO 60 M = 1, 4
        P = 0.5D0*(1.D0 + SIGN(G, M - 2.5D0))
        Q = 0.5D0*(1.D0 + SIGN(G, MOD(M, 2) - 0.5D0))
        DO 30 I = 1, 4
          T = -(1.D0 - Q)
          IF (I .EQ. 2) T = 1.D0 - Q
          IF (I .EQ. 3) T = Q
          IF (I .EQ. 4) T = -Q
          B(1,2*I-1) = T/HX
          B(3,2*I) = T/HX
          T = -(1.D0 - P)
          IF (I .EQ. 2) T = -P
          IF (I .EQ. 3) T = P
          IF (I .EQ. 4) T = 1.D0 - P
          B(2,2*I) = T/HY
          B(3,2*I-1) = T/HY
          B(1,2*I) = 0.D0
          B(2,2*I-1) = 0.D0
   30   CONTINUE
        DO 50 J = 1, 8
          DO 50 I = 1, 8
            DO 40 K = 1, 3
              DO 40 L = 1, 3
                S(I,J) = S(I,J) + 0.25D0*HX*HY*B(K,I)*D(K,L)*B(L,J)
   40       CONTINUE
   50   CONTINUE
   60 CONTINUE
      END

C     Add a block, WIDTH by HEIGHT from (0, Y0) on, of NX by NY elements
C     to the band AB; its nodes begin behind NOFF, those above each other
C     side by side. X: positions of all nodes.
      SUBROUTINE BLOCK(NX, NY, WIDTH, HEIGHT, Y0, E, V, NOFF, KD, AB,
     $                 LDAB, X)
      INTEGER NX, NY, NOFF, KD, LDAB, NODE(4), NDOF(8), I, J, K, L, M
      DOUBLE PRECISION WIDTH, HEIGHT, Y0, E, V, AB(LDAB,*), X(2,*)
      DOUBLE PRECISION S(8,8)
      CALL QUAD(WIDTH/NX, HEIGHT/NY, E, V, S)
      DO 10 I = 0, NX
        DO 10 J = 0, NY
          K = NOFF + I*(NY + 1) + J + 1
          X(1,K) = (WIDTH*I)/NX
          X(2,K) = Y0 + (HEIGHT*J)/NY
   10 CONTINUE
      DO 40 I = 1, NX
        DO 40 J = 1, NY
          NODE(1) = NOFF + (I - 1)*(NY + 1) + J
          NODE(2) = NODE(1) + NY + 1
          NODE(3) = NODE(2) + 1
          NODE(4) = NODE(1) + 1
          DO 20 K = 1, 4
            NDOF(2*K-1) = 2*NODE(K) - 1
            NDOF(2*K) = 2*NODE(K)
   20     CONTINUE
          DO 30 K = 1, 8
            DO 30 L = 1, 8
              M = KD + 1 + NDOF(K) - NDOF(L)
              IF (M .LE. KD + 1) AB(M,NDOF(L)) = AB(M,NDOF(L)) + S(K,L)
   30     CONTINUE
   40 CONTINUE
      END

C     A block of 5 by 2 elements, 1/8 above one of 3 by 2 and of another
C     material, pressed on it by a pressure of 3 on its upper face. Both
C     stay on the line x = 0 and may grow sideways: the contact pressure
C     is 3 everywhere.
      SUBROUTINE BLOCKS
      INTEGER NN, ND, KD, LDAB, MAXN, NW, MAXFIX
      PARAMETER (NN=30, ND=60, KD=9, LDAB=10, MAXN=8, NW=16, MAXFIX=16)
      DOUBLE PRECISION AB(LDAB,ND), X(2,NN), P(ND), Z(ND,1), U(ND)
      DOUBLE PRECISION XC(2,6), XO(2,4), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), ALPHA(MAXN,MAXN)
      DOUBLE PRECISION B(MAXN), R(MAXN,1), W(1), F(MAXN), C(MAXN), Q(1)
      DOUBLE PRECISION UFIX(MAXFIX), RESID, TOL, TOTAL, DEPTH, EQUAL
      INTEGER IFACE(2,5), IFACEO(2,3), ID(2,6), IDO(2,4), IFIX(MAXFIX)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER NHELD(1), NFIX, N, NWMIN, INFO, I, J, K, MET
      CHARACTER*256 MSG
      PARAMETER (TOL=1.D-12)
      DO 10 J = 1, ND
        P(J) = 0.D0
        Z(J,1) = 0.D0
        DO 10 I = 1, LDAB
          AB(I,J) = 0.D0
   10 CONTINUE
      CALL BLOCK(3, 2, 2.D0, 1.D0, 0.D0, 1.D3, 0.3D0, 0, KD, AB, LDAB,
     $           X)
      CALL BLOCK(5, 2, 2.D0, 1.D0, 1.125D0, 3.D2, 0.2D0, 12, KD, AB,
     $           LDAB, X)
C     The line x = 0, and the bottom of the lower block.
      NFIX = 0
      DO 20 K = 1, 3
        IFIX(NFIX+1) = 2*K - 1
        IFIX(NFIX+2) = 2*(12 + K) - 1
        NFIX = NFIX + 2
   20 CONTINUE
      DO 30 K = 1, 4
        NFIX = NFIX + 1
        IFIX(NFIX) = 2*(3*K - 2)
   30 CONTINUE
      DO 40 K = 1, NFIX
        UFIX(K) = 0.D0
   40 CONTINUE
C     The load, and the motion along y of the upper block.
      DO 50 K = 1, 6
        P(2*(12 + 3*K)) = -3.D0*0.4D0
        IF (K .EQ. 1 .OR. K .EQ. 6) P(2*(12 + 3*K)) = -3.D0*0.2D0
   50 CONTINUE
      DO 60 K = 13, NN
        Z(2*K,1) = 1.D0
   60 CONTINUE
C     The lower face of the upper block, from left to right, and the
C     upper face of the lower one, from right to left.
      DO 70 K = 1, 6
        I = 12 + 3*K - 2
        XC(1,K) = X(1,I)
        XC(2,K) = X(2,I)
        ID(1,K) = 2*I - 1
        ID(2,K) = 2*I
   70 CONTINUE
      DO 80 K = 1, 5
        IFACE(1,K) = K
        IFACE(2,K) = K + 1
   80 CONTINUE
      DO 90 K = 1, 4
        I = 3*K
        XO(1,K) = X(1,I)
        XO(2,K) = X(2,I)
        IDO(1,K) = 2*I - 1
        IDO(2,K) = 2*I
   90 CONTINUE
      DO 100 K = 1, 3
        IFACEO(1,K) = K + 1
        IFACEO(2,K) = K
  100 CONTINUE
C     With node to face the pressure is not uniform: the test can fail.
      DO 140 K = 1, 3
        MET = 0
        IF (K .EQ. 3) MET = 1
        CALL FUGECP(2, 6, XC, 2, 5, IFACE, ID, 4, XO, 2, 3, IFACEO, IDO,
     $    MET, 0, MOD(K, 2), 1, 0.D0, 0.D0, MAXN, NW, N, NWMIN, IDOF,
     $    DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
        CALL STATUS('FUGECP', INFO, 0)
        CALL STATUS('FUGECP, blank MSG', INDEX('x'//MSG, 'x '), 1)
        CALL STATUS('contact points', N, 6)
        TOTAL = 0.D0
        DO 110 I = 1, N
          CALL NUMBER('GAP', GAP(I), 0.125D0, TOL)
          CALL STATUS('NSTOP', NSTOP(I), 1)
          CALL STATUS('NODE', NODE(I), I)
          TOTAL = TOTAL + AREA(I)
  110   CONTINUE
        CALL NUMBER('all areas', TOTAL, 2.D0, TOL)
        CALL STATUS('NOPP(1)', NOPP(1), 1)
        CALL STATUS('NOPP(6)', NOPP(6), 3)
        CALL FUGECB('U', ND, KD, AB, LDAB, NFIX, IFIX, UFIX, P, 1, Z,
     $    ND, N, NW, IDOF, DN, ALPHA, MAXN, B, R, MAXN, W, NHELD, MSG,
     $    INFO)
        CALL STATUS('FUGECB', INFO, 0)
        CALL NUMBER('W', W(1), -6.D0, 6.D0*TOL)
        DO 120 I = 1, N
          GAP(I) = GAP(I) + B(I)
  120   CONTINUE
        CALL FUGEGV(N, 1, ALPHA, MAXN, GAP, NSTOP, PLAY, R, MAXN, W, F,
     $    C, Q, INFO)
        CALL STATUS('FUGEGV', INFO, 0)
        EQUAL = 0.D0
        DO 130 I = 1, N
          EQUAL = MAX(EQUAL, ABS(F(I)/AREA(I) - 3.D0))
  130   CONTINUE
        IF (MET .EQ. 0) CALL NUMBER('pressure', EQUAL, 0.D0, 3.D0*TOL)
        IF (MET .EQ. 1) CALL STATUS('node to face is not uniform',
     $    INT(MIN(EQUAL*1.D3, 1.D0)), 1)
        IF (MET .EQ. 1) GO TO 140
        CALL FUGERB('U', ND, KD, AB, LDAB, NFIX, IFIX, UFIX, P, 1, Z,
     $    ND, N, NW, IDOF, DN, F, Q, U, RESID, MSG, INFO)
        CALL STATUS('FUGERB', INFO, 0)
        DEPTH = 0.125D0 + 3.D0*(0.91D0/1.D3 + 0.96D0/3.D2)
        CALL NUMBER('U, above on the left', U(2*15), -DEPTH, TOL)
        CALL NUMBER('U, above on the right', U(2*30), -DEPTH, TOL)
        CALL NUMBER('U, growth', U(2*30-1), 6.D0*0.24D0/3.D2, TOL)
  140 CONTINUE
      END

C     Two edges of different length: play, tied points, a rigid opposite
C     surface, and the question for sizes.
      SUBROUTINE KINDS
      INTEGER NW, MAXN
      PARAMETER (NW=8, MAXN=4)
      DOUBLE PRECISION X(2,2), XO(2,2), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), TOL
      INTEGER IFACE(2,1), IFACEO(2,1), ID(2,2), IDO(2,2), NONE(2,2)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER N, NWMIN, INFO, I
      CHARACTER*256 MSG
      PARAMETER (TOL=1.D-14)
      DATA X /0.D0, 1.D0, 2.D0, 1.D0/
      DATA XO /-1.D0, 0.5D0, 3.D0, 0.5D0/
      DATA IFACE /1, 2/
      DATA IFACEO /2, 1/
      DATA ID /1, 2, 3, 4/
      DATA IDO /5, 6, 7, 8/
      DATA NONE /4*0/
C     The question: the arrays are not referenced.
      IDOF(1,1) = 77
      N = -9
      CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 0, 1, 0.D0, 0.D0, 0, 1, N, NWMIN, IDOF, DN, GAP, NSTOP,
     $  PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('question', INFO, 0)
      CALL STATUS('question, N', N, 2)
      CALL STATUS('question, NWMIN', NWMIN, 3)
      CALL STATUS('question, IDOF', IDOF(1,1), 77)
C     Two points with a play; a row that no point needs is 0.
      IDOF(4,2) = 77
      IDOF(1,3) = 77
      CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 0, 2, 0.25D0, 0.D0, MAXN, NW, N, NWMIN, IDOF, DN, GAP,
     $  NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('play', INFO, 0)
      CALL STATUS('play, N', N, 2)
      DO 10 I = 1, 2
        CALL STATUS('play, NSTOP', NSTOP(I), 2)
        CALL NUMBER('play, PLAY', PLAY(I), 0.25D0, 0.D0)
        CALL NUMBER('play, GAP', GAP(I), 0.5D0, TOL)
        CALL NUMBER('play, AREA', AREA(I), 1.D0, TOL)
   10 CONTINUE
      CALL STATUS('play, IDOF(4,2)', IDOF(4,2), 0)
      CALL STATUS('play, IDOF(1,3)', IDOF(1,3), 77)
C     A second pair, the same surfaces, behind the first one.
      CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 0, 1, 0.D0, 0.D0, MAXN-N, NW, I, NWMIN, IDOF(1,N+1),
     $  DN(1,N+1), GAP(N+1), NSTOP(N+1), PLAY(N+1), AREA(N+1),
     $  NODE(N+1), NOPP(N+1), MSG, INFO)
      CALL STATUS('second pair', INFO, 0)
      CALL STATUS('second pair, points', I, 2)
      DO 15 I = 1, 2
        CALL STATUS('second pair, NSTOP', NSTOP(2+I), 1)
        CALL NUMBER('second pair, GAP', GAP(2+I), 0.5D0, TOL)
        CALL STATUS('second pair, NODE', NODE(2+I), I)
        CALL NUMBER('first pair, PLAY', PLAY(I), 0.25D0, 0.D0)
   15 CONTINUE
C     Tied: two directions at each point.
      CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 0, 3, 0.D0, 0.D0, MAXN, NW, N, NWMIN, IDOF, DN, GAP,
     $  NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('tied', INFO, 0)
      CALL STATUS('tied, N', N, 4)
      DO 20 I = 1, 4
        CALL STATUS('tied, NSTOP', NSTOP(I), 2)
        CALL NUMBER('tied, PLAY', PLAY(I), 0.D0, 0.D0)
        CALL NUMBER('tied, GAP', GAP(I), 0.D0, 0.D0)
   20 CONTINUE
C     The opposite surface is rigid: DN points into the body, upwards.
      CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  1, 1, 0, 1, 0.D0, 0.D0, MAXN, NW, N, NWMIN, IDOF, DN, GAP,
     $  NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('rigid', INFO, 0)
      CALL STATUS('rigid, NWMIN', NWMIN, 1)
      CALL STATUS('rigid, IDOF', IDOF(1,2), 4)
      CALL NUMBER('rigid, DN', DN(1,2), 1.D0, TOL)
      CALL NUMBER('rigid, PLAY', PLAY(2), 0.D0, 0.D0)
      END

C     A square of four nodes above a larger one, in space.
      SUBROUTINE SPACE
      INTEGER NW, MAXN
      PARAMETER (NW=5, MAXN=4)
      DOUBLE PRECISION X(3,4), XO(3,4), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), TOL
      INTEGER IFACE(4,1), IFACEO(4,1), ID(3,4), IDO(3,4)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER N, NWMIN, INFO, I
      CHARACTER*256 MSG
      PARAMETER (TOL=1.D-14)
      DATA X /0.D0, 0.D0, 1.D0, 1.D0, 0.D0, 1.D0, 1.D0, 1.D0, 1.D0,
     $        0.D0, 1.D0, 1.D0/
      DATA XO /-1.D0, -1.D0, 0.D0, 3.D0, -1.D0, 0.D0, 3.D0, 3.D0, 0.D0,
     $         -1.D0, 3.D0, 0.D0/
      DATA IFACE /4, 3, 2, 1/
      DATA IFACEO /1, 2, 3, 4/
      DATA ID /1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12/
      DATA IDO /13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24/
      CALL FUGECP(3, 4, X, 4, 1, IFACE, ID, 4, XO, 4, 1, IFACEO, IDO,
     $  0, 0, 0, 1, 0.D0, 0.D0, MAXN, NW, N, NWMIN, IDOF, DN, GAP,
     $  NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('space', INFO, 0)
      CALL STATUS('space, N', N, 4)
      CALL STATUS('space, NWMIN', NWMIN, 5)
      DO 10 I = 1, N
        CALL NUMBER('space, GAP', GAP(I), 1.D0, 4*TOL)
        CALL NUMBER('space, AREA', AREA(I), 0.25D0, TOL)
        CALL STATUS('space, own IDOF', IDOF(1,I), 3*NODE(I))
        CALL NUMBER('space, own DN', DN(1,I), 1.D0, TOL)
        CALL NUMBER('space, sum of DN', DN(1,I) + DN(2,I) + DN(3,I)
     $    + DN(4,I) + DN(5,I), 0.D0, 4*TOL)
   10 CONTINUE
      END

C     Two faces that meet at 30 degrees above a rigid one: an edge, or
C     beyond that angle a round nose.
      SUBROUTINE BENT
      INTEGER NW, MAXN
      PARAMETER (NW=2, MAXN=3)
      DOUBLE PRECISION X(2,3), XO(2,2), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), SHARP(MAXN), CREASE, BAD
      INTEGER IFACE(2,2), IFACEO(2,1), ID(2,3), NONE(2,2)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER N, NWMIN, INFO, I, NBITS(2)
      CHARACTER*256 MSG
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA X /0.D0, 0.25D0, 1.D0, 0.D0, 1.8660254037844386D0, 0.5D0/
      DATA XO /-1.D0, -1.D0, 3.D0, -1.D0/
      DATA IFACE /1, 2, 2, 3/
      DATA IFACEO /2, 1/
      DATA ID /1, 2, 3, 4, 5, 6/
      DATA NONE /4*0/
C     FUGECP has 25 degrees.
      CALL FUGECP(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, MAXN, NW, N, NWMIN, IDOF, DN, SHARP,
     $  NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECP, bent', INFO, 0)
      CALL STATUS('FUGECP, bent, N', N, 3)
      CREASE = 29.D0
      CALL FUGECX(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, CREASE, 0, MAXN, NW, N, NWMIN, IDOF,
     $  DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECX, edge', INFO, 0)
      DO 10 I = 1, N
        CALL NUMBER('FUGECX, edge, GAP', GAP(I), SHARP(I), 0.D0)
   10 CONTINUE
      CREASE = 60.D0
      CALL FUGECX(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, CREASE, 0, MAXN, NW, N, NWMIN, IDOF,
     $  DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECX, round', INFO, 0)
      CALL STATUS('FUGECX, round, GAP', INT(MIN(1.D0,
     $  (SHARP(1) - GAP(1))/0.01D0)), 1)
C     The question, and what no angle is.
      NODE(1) = 77
      N = 77
      CALL FUGECX(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, CREASE, 0, 0, NW, N, NWMIN, IDOF,
     $  DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECX, question, N', N, 3)
      CREASE = 91.D0
      N = 77
      CALL FUGECX(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, CREASE, 0, MAXN, NW, N, NWMIN, IDOF,
     $  DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECX, CREASE = 91', INFO, -14)
      CALL HASTXT('FUGECX, CREASE = 91', MSG, 'crease = 91.0')
      CALL FUGECX(2, 3, X, 2, 2, IFACE, ID, 2, XO, 2, 1, IFACEO, NONE,
     $  0, 1, 1, 1, 0.D0, 0.D0, BAD, 0, MAXN, NW, N, NWMIN, IDOF, DN,
     $  GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('FUGECX, CREASE NaN', INFO, -3)
      CALL HASTXT('FUGECX, CREASE NaN', MSG, 'crease = NaN')
      CALL STATUS('FUGECX, N untouched', N, 77)
      CALL STATUS('FUGECX, NODE untouched', NODE(1), 77)
      END

C     A disc of radius 2 above a larger one, in bodies of revolution:
C     the shares of both nodes in its area are 1/3 and 2/3.
      SUBROUTINE RINGS
      INTEGER NW, MAXN
      PARAMETER (NW=3, MAXN=2)
      DOUBLE PRECISION X(2,2), XO(2,2), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), DISC, TOL
      INTEGER IFACE(2,1), IFACEO(2,1), ID(2,2), IDO(2,2)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER N, NWMIN, INFO, I
      CHARACTER*256 MSG
      PARAMETER (TOL=1.D-12)
      DATA X /0.D0, 1.D0, 2.D0, 1.D0/
      DATA XO /0.D0, 0.5D0, 3.D0, 0.5D0/
      DATA IFACE /1, 2/
      DATA IFACEO /2, 1/
      DATA ID /1, 2, 3, 4/
      DATA IDO /5, 6, 7, 8/
      DISC = 16.D0*ATAN(1.D0)
      CALL FUGECX(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 1, 1, 0.D0, 0.D0, 25.D0, 1, MAXN, NW, N, NWMIN, IDOF, DN,
     $  GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('rings', INFO, 0)
      CALL STATUS('rings, N', N, 2)
      DO 10 I = 1, N
        CALL NUMBER('rings, AREA', AREA(I), NODE(I)*DISC/3.D0, TOL)
        CALL NUMBER('rings, GAP', GAP(I), 0.5D0, TOL)
   10 CONTINUE
C     A node beyond the axis.
      XO(1,1) = -1.D0
      CALL FUGECX(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1, IFACEO, IDO,
     $  0, 0, 1, 1, 0.D0, 0.D0, 25.D0, 1, MAXN, NW, N, NWMIN, IDOF, DN,
     $  GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
      CALL STATUS('rings, radius < 0', INFO, -23)
      CALL HASTXT('rings, radius < 0', MSG, 'radius')
      END

C     Errors touch nothing but INFO and MSG.
      SUBROUTINE REFUSE
      INTEGER NW, MAXN
      PARAMETER (NW=4, MAXN=2)
      DOUBLE PRECISION X(2,2), XO(2,2), DN(NW,MAXN), GAP(MAXN)
      DOUBLE PRECISION PLAY(MAXN), AREA(MAXN), D
      INTEGER IFACE(2,1), IFACEO(2,1), ID(2,2), IDO(2,2), NONE(2,2)
      INTEGER IDOF(NW,MAXN), NSTOP(MAXN), NODE(MAXN), NOPP(MAXN)
      INTEGER N, NWMIN, INFO, K, NDIM, MET, NORM, NKIND, ROWS, MAXC
      INTEGER IWANT(10)
      CHARACTER*256 MSG
      CHARACTER*24 PART(10)
      DATA X /0.D0, 1.D0, 2.D0, 1.D0/
      DATA XO /-1.D0, 0.5D0, 3.D0, 0.5D0/
      DATA IFACE /1, 2/
      DATA IFACEO /2, 1/
      DATA ID /1, 2, 3, 4/
      DATA IDO /5, 6, 7, 8/
      DATA NONE /4*0/
      DATA IWANT /-1, -14, -14, -14, -20, -1, -1, -22, -23, -1/
      DATA PART /'NDIM = 4', 'method = 7', 'NORM = 2', 'NKIND = 0',
     $  'play = -', 'NW = 3 or more', 'MAXN = 1: there are 2',
     $  'neither surface', 'normals to the same side', 'NNO = 0'/
      DO 10 K = 1, 10
        NDIM = 2
        MET = 0
        NORM = 0
        NKIND = 1
        D = 0.D0
        ROWS = NW
        MAXC = MAXN
        N = 77
        NWMIN = 77
        IDOF(1,1) = 77
        GAP(1) = 77.D0
        IF (K .EQ. 1) NDIM = 4
        IF (K .EQ. 2) MET = 7
        IF (K .EQ. 3) NORM = 2
        IF (K .EQ. 4) NKIND = 0
        IF (K .EQ. 5) NKIND = 2
        IF (K .EQ. 5) D = -1.D0
        IF (K .EQ. 6) ROWS = 2
        IF (K .EQ. 7) MAXC = 1
        IF (K .LE. 7) CALL FUGECP(NDIM, 2, X, 2, 1, IFACE, ID, 2, XO, 2,
     $    1, IFACEO, IDO, MET, NORM, 0, NKIND, D, 0.D0, MAXC, ROWS, N,
     $    NWMIN, IDOF, DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG,
     $    INFO)
        IF (K .EQ. 8) CALL FUGECP(2, 2, X, 2, 1, IFACE, NONE, 2, XO, 2,
     $    1, IFACEO, NONE, 0, 0, 0, 1, D, 0.D0, MAXC, ROWS, N, NWMIN,
     $    IDOF, DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
        IF (K .EQ. 9) CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 2, XO, 2, 1,
     $    IFACE, IDO, 0, 0, 0, 1, D, 0.D0, MAXC, ROWS, N, NWMIN, IDOF,
     $    DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
        IF (K .EQ. 10) CALL FUGECP(2, 2, X, 2, 1, IFACE, ID, 0, XO, 2,
     $    1, IFACEO, IDO, 0, 0, 0, 1, D, 0.D0, MAXC, ROWS, N, NWMIN,
     $    IDOF, DN, GAP, NSTOP, PLAY, AREA, NODE, NOPP, MSG, INFO)
        CALL STATUS(PART(K), INFO, IWANT(K))
        CALL HASTXT('MSG', MSG, PART(K)(:INDEX(PART(K)//'  ', '  ')-1))
        CALL STATUS('N untouched', N, 77)
        CALL STATUS('NWMIN untouched', NWMIN, 77)
        CALL STATUS('IDOF untouched', IDOF(1,1), 77)
        CALL NUMBER('GAP untouched', GAP(1), 77.D0, 0.D0)
   10 CONTINUE
      END
