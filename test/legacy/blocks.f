C     Two blocks of finite elements, one upon the other, pressed
C     together: condensed, solved and recovered, called without any
C     interface.
      PROGRAM BLOCKS
      CALL PRESS
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

C     Add a block, WIDTH by HEIGHT, of NX by NY elements to the band AB.
C     Its nodes begin behind NOFF, those above each other side by side.
      SUBROUTINE BLOCK(NX, NY, WIDTH, HEIGHT, E, V, NOFF, KD, AB, LDAB)
      INTEGER NX, NY, NOFF, KD, LDAB, NODE(4), NDOF(8), I, J, K, L, M
      DOUBLE PRECISION WIDTH, HEIGHT, E, V, AB(LDAB,*), S(8,8)
      CALL QUAD(WIDTH/NX, HEIGHT/NY, E, V, S)
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

C     A block of 5 by 2 elements, 1/8 above one of another material,
C     whose upper nodes face its lower ones, pressed on it by a pressure
C     of 3 on its upper face. Both stay on the line x = 0 and may grow
C     sideways: the contact pressure is 3 everywhere.
      SUBROUTINE PRESS
      INTEGER NX, NN, ND, KD, LDAB, N, NW, NFIX
      PARAMETER (NX=5, NN=36, ND=72, KD=9, LDAB=10, N=6, NW=2, NFIX=12)
      DOUBLE PRECISION AB(LDAB,ND), P(ND), Z(ND,1), U(ND), UFIX(NFIX)
      DOUBLE PRECISION DN(NW,N), GAP(N), PLAY(N), AREA(N), ALPHA(N,N)
      DOUBLE PRECISION B(N), R(N,1), W(1), F(N), C(N), Q(1), RESID
      DOUBLE PRECISION TOL, EQUAL, DEPTH
      INTEGER IFIX(NFIX), IDOF(NW,N), NSTOP(N), NHELD(1), NCON, NITER
      INTEGER INFO, I, J, K
      CHARACTER*256 MSG
      PARAMETER (TOL=1.D-12)
      DO 20 J = 1, ND
        P(J) = 0.D0
        Z(J,1) = 0.D0
        DO 10 I = 1, LDAB
          AB(I,J) = 0.D0
   10   CONTINUE
   20 CONTINUE
      CALL BLOCK(NX, 2, 2.D0, 1.D0, 1.D3, 0.3D0, 0, KD, AB, LDAB)
      CALL BLOCK(NX, 2, 2.D0, 1.D0, 3.D2, 0.2D0, 18, KD, AB, LDAB)
C     The line x = 0, and the bottom of the lower block.
      DO 30 K = 1, 3
        IFIX(K) = 2*K - 1
        IFIX(3+K) = 2*(18 + K) - 1
   30 CONTINUE
      DO 40 K = 1, 6
        IFIX(6+K) = 2*(3*K - 2)
   40 CONTINUE
      DO 50 K = 1, NFIX
        UFIX(K) = 0.D0
   50 CONTINUE
C     The motion along y of the upper block.
      DO 60 K = 19, NN
        Z(2*K,1) = 1.D0
   60 CONTINUE
C     The load; a contact point of the lowest node of each column of the
C     upper block, which is pushed up, and the highest one of the lower.
      DO 70 K = 1, N
        AREA(K) = 0.4D0
        IF (K .EQ. 1 .OR. K .EQ. N) AREA(K) = 0.2D0
        P(2*(18 + 3*K)) = -3.D0*AREA(K)
        IDOF(1,K) = 2*(18 + 3*K - 2)
        IDOF(2,K) = 2*3*K
        DN(1,K) = 1.D0
        DN(2,K) = -1.D0
        NSTOP(K) = 1
   70 CONTINUE
      CALL FUGECB('U', ND, KD, AB, LDAB, NFIX, IFIX, UFIX, P, 1, Z, ND,
     $            N, NW, IDOF, DN, ALPHA, N, B, R, N, W, NHELD, MSG,
     $            INFO)
      CALL STATUS('FUGECB', INFO, 0)
      CALL NUMBER('W', W(1), -6.D0, 6.D0*TOL)
      DO 80 I = 1, N
        GAP(I) = 0.125D0 + B(I)
   80 CONTINUE
      CALL FUGEGX(N, 1, ALPHA, N, GAP, NSTOP, PLAY, R, N, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX', INFO, 0)
      EQUAL = 0.D0
      DO 90 I = 1, N
        EQUAL = MAX(EQUAL, ABS(F(I)/AREA(I) - 3.D0))
   90 CONTINUE
      CALL NUMBER('pressure', EQUAL, 0.D0, 3.D0*TOL)
      CALL FUGERB('U', ND, KD, AB, LDAB, NFIX, IFIX, UFIX, P, 1, Z, ND,
     $            N, NW, IDOF, DN, F, Q, U, RESID, MSG, INFO)
      CALL STATUS('FUGERB', INFO, 0)
      DEPTH = 0.125D0 + 3.D0*(0.91D0/1.D3 + 0.96D0/3.D2)
      CALL NUMBER('U, above on the left', U(2*21), -DEPTH, TOL)
      CALL NUMBER('U, above on the right', U(2*36), -DEPTH, TOL)
      CALL NUMBER('U, growth', U(2*36-1), 6.D0*0.24D0/3.D2, TOL)
      END
