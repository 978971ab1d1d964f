C     Cells on a half-plane and on a half-space by FFT, under a load and
C     with the approach prescribed, and edges of the contact, called
C     without any interface. Hertz's contacts.
      PROGRAM SURFAC
      CALL ROLLER
      CALL REPEAT
      CALL BALL
      CALL EDGES
      CALL REFUSE
      CALL VERDCT
      END

C     Gaps of a roller, X**2/(2 R), at the centres of N cells of width H
C     about X = 0; centres and widths.
      SUBROUTINE ROUND(N, H, R, X, WIDTH, GAP)
      INTEGER N, I
      DOUBLE PRECISION H, R, X(N), WIDTH(N), GAP(N)
      DO 10 I = 1, N
        X(I) = H*(I - 0.5D0*(N + 1))
        WIDTH(I) = H
        GAP(I) = X(I)**2/(2.D0*R)
   10 CONTINUE
      END

C     A roller against Hertz and against its matrix: pressed by a load,
C     then as far as that load has pressed it.
      SUBROUTINE ROLLER
      INTEGER N
      PARAMETER (N=80)
      DOUBLE PRECISION X(N), WIDTH(N), GAP(N), F(N), C(N), ALPHA(N,N),
     $                 FM(N), CM(N), F0, V0, FA, VM, RESID, R, ESTAR,
     $                 LOAD, A, H, XL(2), XR(2), EL(2), ER(2), LARGE
      INTEGER NCON, NITER, NI, KL(2), KR(2), INFO, I
      CHARACTER*256 MSG
      PARAMETER (R=50.D0, ESTAR=1.D5, LOAD=400.D0, H=0.02D0)
      CALL ROUND(N, H, R, X, WIDTH, GAP)
      F0 = LOAD
      V0 = 77.D0
      MSG = 'old'
      CALL FUGEFX(N, H, ESTAR, 2, 0, 1, GAP, 0, F0, V0, 1.D-13, 0, F, C,
     $            NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEFX', INFO, 0)
      CALL STATUS('FUGEFX blank MSG', INDEX(MSG, 'old'), 0)
      CALL NUMBER('FUGEFX F0', F0, LOAD, 0.D0)
      CALL NUMBER('FUGEFX RESID', RESID, 0.D0, 1.D-12)
      LARGE = 0.D0
      FA = 0.D0
      DO 10 I = 1, N
        FA = FA + F(I)
        IF (F(I) .GT. 0.D0) NCON = NCON - 1
        LARGE = MAX(LARGE, F(I)/H)
   10 CONTINUE
      CALL STATUS('FUGEFX NCON', NCON, 0)
      CALL STATUS('FUGEFX NITER', MIN(NITER, 1), 1)
      CALL NUMBER('FUGEFX sum of F', FA, LOAD, 1.D-10*LOAD)
      A = SQRT(16.D0*LOAD*R/(4.D0*ATAN(1.D0)*ESTAR))/2.D0
      CALL NUMBER('pressure', LARGE, LOAD/(2.D0*ATAN(1.D0)*A), 1.D0)
C     The edges, closer than a thousandth of a cell.
      CALL FUGEED(N, X, WIDTH, F, 2, 0, 2, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('FUGEED', INFO, 0)
      CALL STATUS('FUGEED NI', NI, 1)
      CALL STATUS('FUGEED KL', KL(1), 0)
      CALL STATUS('FUGEED KR', KR(1), 0)
      CALL NUMBER('FUGEED XL', XL(1), -A, 1.D-3*H)
      CALL NUMBER('FUGEED XR', XR(1), A, 1.D-3*H)
      CALL NUMBER('FUGEED EL', EL(1), 0.D0, 1.D-2*H)
C     The approach that was found takes the same load.
      VM = V0
      CALL FUGEFX(N, H, ESTAR, 2, 0, 2, GAP, 1, FA, V0, 1.D-13, 0, FM,
     $            CM, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEFX, approach', INFO, 0)
      CALL NUMBER('FUGEFX V0 unchanged', V0, VM, 0.D0)
      CALL NUMBER('FUGEFX F0 of V0', FA, LOAD, 1.D-9*LOAD)
      CALL SAME('FUGEFX, approach', N, F, FM, 1.D-9*LOAD)
C     The matrix, with each method.
      CALL FUGEHX(N, X, WIDTH, ESTAR, 2, 0, ALPHA, N, MSG, INFO)
      CALL STATUS('FUGEHX', INFO, 0)
      DO 20 I = 0, 3
        FA = LOAD
        CALL FUGESX(N, ALPHA, N, GAP, 0, FA, V0, I, 1.D-12, 0, FM, CM,
     $              NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGESX', INFO, 0)
        CALL NUMBER('FUGESX V0', V0, VM, 1.D-10*VM)
        CALL SAME('FUGESX F', N, F, FM, 1.D-9*LOAD)
        CALL SAME('FUGESX C', N, C, CM, 1.D-9*VM)
   20 CONTINUE
      END

C     Largest difference of two arrays.
      SUBROUTINE SAME(WHAT, N, A, B, TOL)
      CHARACTER*(*) WHAT
      INTEGER N, I
      DOUBLE PRECISION A(N), B(N), TOL, LARGE
      LARGE = 0.D0
      DO 10 I = 1, N
        LARGE = MAX(LARGE, ABS(A(I) - B(I)))
   10 CONTINUE
      CALL NUMBER(WHAT, LARGE, 0.D0, TOL)
      END

C     A wave pressed flat on a periodic surface: COS of amplitude D and
C     period L needs the mean pressure PI ESTAR D/L, and the approach is
C     that of the mean surface.
      SUBROUTINE REPEAT
      INTEGER N
      PARAMETER (N=64)
      DOUBLE PRECISION GAP(N), F(N), C(N), F0, V0, RESID, D, P, FULL, PI
      INTEGER NCON, NITER, INFO, I
      CHARACTER*256 MSG
      PARAMETER (D=1.D-3)
      PI = 4.D0*ATAN(1.D0)
      DO 10 I = 1, N
        GAP(I) = D*(1.D0 - COS(2.D0*PI*(I - 0.5D0)/N))
   10 CONTINUE
      P = PI*100.D0*D/(0.125D0*N)
      FULL = P*0.125D0*N
      F0 = 1.2D0*FULL
      CALL FUGEFX(N, 0.125D0, 100.D0, 1, 1, 1, GAP, 0, F0, V0, 0.D0, 0,
     $            F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('periodic', INFO, 0)
      CALL STATUS('periodic, all touch', NCON, N)
      CALL NUMBER('periodic, V0', V0, D, 1.D-9*D)
C     Not so far: a part touches, and the same load comes back.
      F0 = 0.4D0*FULL
      CALL FUGEFX(N, 0.125D0, 100.D0, 1, 1, 1, GAP, 0, F0, V0, 0.D0, 0,
     $            F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('periodic, a part', INFO, 0)
      CALL STATUS('periodic, not all touch', MIN(N - NCON, 1), 1)
      F0 = 0.D0
      CALL FUGEFX(N, 0.125D0, 100.D0, 1, 1, 1, GAP, 1, F0, V0, 0.D0, 0,
     $            F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('periodic, approach', INFO, 0)
      CALL NUMBER('periodic, F0', F0, 0.4D0*FULL, 1.D-7*FULL)
      END

C     A ball, free and with its images beside it; the approach of Hertz
C     and the load that belongs to it.
      SUBROUTINE BALL
      INTEGER N
      PARAMETER (N=32)
      DOUBLE PRECISION GAP(N,N), F(N,N), C(N,N), F0, V0, RESID, R,
     $                 ESTAR, A, H, HERTZ, VM
      INTEGER NCON, NITER, INFO, I, J, NBOUND
      CHARACTER*256 MSG
      PARAMETER (R=10.D0, ESTAR=1.D5, A=0.1D0, H=0.0075D0)
      DO 20 J = 1, N
        DO 10 I = 1, N
          GAP(I,J) = ((H*(I - 16.5D0))**2 + (H*(J - 16.5D0))**2)/(2*R)
   10   CONTINUE
   20 CONTINUE
      HERTZ = 4.D0*ESTAR*A**3/(3.D0*R)
      DO 30 NBOUND = 0, 3
        F0 = HERTZ
        V0 = 77.D0
        CALL FUGEAX(N, N, H, H, ESTAR, 1, NBOUND, 1, GAP, 0, F0, V0,
     $              0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGEAX', INFO, 0)
        IF (NBOUND .EQ. 0) CALL NUMBER('FUGEAX V0', V0, A**2/R,
     $                                 0.01D0*A**2/R)
        IF (NBOUND .EQ. 0) CALL NUMBER('FUGEAX pressure', F(16,16)/H**2,
     $    1.5D0*HERTZ/(4.D0*ATAN(1.D0)*A**2),
     $    0.02D0*HERTZ/(4.D0*ATAN(1.D0)*A**2))
        CALL STATUS('FUGEAX blank MSG', MIN(1, LENTXT(MSG)), 0)
        VM = V0
        F0 = 77.D0
        CALL FUGEAX(N, N, H, H, ESTAR, 1, NBOUND, 2, GAP, 1, F0, V0,
     $              0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGEAX, approach', INFO, 0)
        CALL NUMBER('FUGEAX V0 unchanged', V0, VM, 0.D0)
        CALL NUMBER('FUGEAX F0', F0, HERTZ, 1.D-7*HERTZ)
   30 CONTINUE
C     A remark, not an error: the contact reaches the rim of the grid.
      F0 = 4.D0*HERTZ
      CALL FUGEAX(N, N, H, H, ESTAR, 1, 0, 1, GAP, 0, F0, V0, 0.D0, 0,
     $            F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEAX at the rim', INFO, 0)
      CALL HASTXT('FUGEAX at the rim', MSG, 'rim')
      END

C     Length of a text without the blanks at its end.
      INTEGER FUNCTION LENTXT(TEXT)
      CHARACTER*(*) TEXT
      INTEGER I
      LENTXT = 0
      DO 10 I = 1, LEN(TEXT)
        IF (TEXT(I:I) .NE. ' ') LENTXT = I
   10 CONTINUE
      END

C     Two rollers on one surface, half of a symmetric model, few cells
C     and none; room for less than there is.
      SUBROUTINE EDGES
      INTEGER N
      PARAMETER (N=8)
      DOUBLE PRECISION X(N), WIDTH(N), F(N), XL(3), XR(3), EL(3), ER(3)
      INTEGER NI, KL(3), KR(3), INFO, I
      CHARACTER*256 MSG
      DATA F /0.D0, 1.D0, 1.D0, 0.D0, 0.D0, 2.D0, 0.D0, 3.D0/
      DO 10 I = 1, N
        X(I) = 0.5D0*I
        WIDTH(I) = 0.5D0
   10 CONTINUE
      CALL FUGEED(N, X, WIDTH, F, 1, 0, 3, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('few cells', INFO, 0)
      CALL STATUS('few cells, NI', NI, 3)
      CALL NUMBER('few cells, XL(1)', XL(1), 0.75D0, 0.D0)
      CALL NUMBER('few cells, XR(1)', XR(1), 1.75D0, 0.D0)
      CALL NUMBER('few cells, XL(2)', XL(2), 2.75D0, 0.D0)
      CALL STATUS('few cells, KL(1)', KL(1), 1)
      CALL NUMBER('few cells, EL(1)', EL(1), 0.5D0, 0.D0)
      CALL STATUS('end of the grid', KR(3), 3)
C     Room for one, and the question.
      XL(2) = 77.D0
      CALL FUGEED(N, X, WIDTH, F, 1, 0, 1, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('room for one, NI', NI, 3)
      CALL NUMBER('room for one', XL(2), 77.D0, 0.D0)
      XL(1) = 77.D0
      CALL FUGEED(N, X, WIDTH, F, 1, 0, 0, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('question, NI', NI, 3)
      CALL NUMBER('question', XL(1), 77.D0, 0.D0)
C     Symmetric: the interval about x = 0 is whole.
      DO 20 I = 1, N
        X(I) = 0.5D0*I - 0.25D0
        F(I) = MAX(0.D0, 3.5D0 - I)
   20 CONTINUE
      CALL FUGEED(N, X, WIDTH, F, 1, 1, 3, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('symmetric', INFO, 0)
      CALL STATUS('symmetric, NI', NI, 1)
      CALL NUMBER('symmetric', XL(1) + XR(1), 0.D0, 0.D0)
C     No force, no contact.
      DO 30 I = 1, N
        F(I) = 0.D0
   30 CONTINUE
      CALL FUGEED(N, X, WIDTH, F, 1, 1, 3, NI, XL, XR, EL, ER, KL, KR,
     $            MSG, INFO)
      CALL STATUS('no contact', INFO, 0)
      CALL STATUS('no contact, NI', NI, 0)
      END

C     Every refusal has a message and leaves the outputs alone. The NaN
C     has all bits set: no operation makes it, so that none can trap.
      SUBROUTINE REFUSE
      DOUBLE PRECISION GAP(4), WIDTH(4), X(4), OUT(8), V0, F0, RESID,
     $                 BAD, H, ESTAR, TOL
      INTEGER NBITS(2), IWANT(10), INFO, K, N, NELEM, NBOUND, NTHR,
     $        MAXIT, NCON, NITER, NI, KL(2), NHELD
      CHARACTER*256 MSG
      CHARACTER*16 PART(10)
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA GAP /0.D0, 1.D0, 1.D0, 0.D0/
      DATA WIDTH /4*1.D0/
      DATA X /0.D0, 1.D0, 2.D0, 3.D0/
      DATA IWANT /-1, -4, -5, -6, -14, -14, -10, -3, -14, -14/
      DATA PART /' ', 'spacing', 'e_star', 'element', 'boundary',
     $  'threads', 'load', 'motion', 'max_iterations', 'tolerance'/
      DO 10 K = 1, 8
        OUT(K) = 77.D0
   10 CONTINUE
      NCON = 77
      NITER = 77
      NI = 77
      RESID = 77.D0
      DO 20 K = 1, 10
        N = 4
        H = 1.D0
        ESTAR = 100.D0
        NELEM = 1
        NBOUND = 0
        NTHR = 1
        F0 = 3.D0
        V0 = 77.D0
        NHELD = 0
        MAXIT = 0
        TOL = 0.D0
        IF (K .EQ. 1) N = 0
        IF (K .EQ. 2) H = 0.D0
        IF (K .EQ. 3) ESTAR = -1.D0
        IF (K .EQ. 4) NELEM = 7
        IF (K .EQ. 5) NBOUND = 9
        IF (K .EQ. 6) NTHR = 0
        IF (K .EQ. 7) F0 = -3.D0
        IF (K .EQ. 8) NHELD = 1
        IF (K .EQ. 8) V0 = BAD
        IF (K .EQ. 9) MAXIT = -1
        IF (K .EQ. 10) TOL = 2.D0
        CALL FUGEFX(N, H, ESTAR, NELEM, NBOUND, NTHR, GAP, NHELD, F0,
     $    V0, TOL, MAXIT, OUT, OUT(5), NCON, NITER, RESID, MSG, INFO)
        CALL STATUS(PART(K), INFO, IWANT(K))
        CALL HASTXT('FUGEFX MSG', MSG, PART(K)(:LENTXT(PART(K))))
        IF (K .NE. 8) CALL NUMBER('FUGEFX V0', V0, 77.D0, 0.D0)
        CALL FUGEAX(N, 1, H, H, ESTAR, NELEM, NBOUND, NTHR, GAP, NHELD,
     $    F0, V0, TOL, MAXIT, OUT, OUT(5), NCON, NITER, RESID, MSG,
     $    INFO)
        CALL STATUS(PART(K), INFO, IWANT(K))
        CALL HASTXT('FUGEAX MSG', MSG, PART(K)(:LENTXT(PART(K))))
        IF (K .NE. 8) CALL NUMBER('FUGEAX V0', V0, 77.D0, 0.D0)
   20 CONTINUE
      CALL FUGEAX(65536, 65536, 1.D0, 1.D0, ESTAR, 1, 0, 1, GAP, 0, F0,
     $  V0, 0.D0, 0, OUT, OUT(5), NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEAX, NX*NY too large', INFO, -1)
      CALL HASTXT('FUGEAX, NX*NY too large', MSG, '65536')
      CALL FUGEHX(4, X, WIDTH, -1.D0, 1, 0, OUT, 4, MSG, INFO)
      CALL STATUS('FUGEHX, ESTAR < 0', INFO, -5)
      CALL HASTXT('FUGEHX, ESTAR < 0', MSG, 'e_star = -1')
      CALL FUGEHX(4, X, WIDTH, 1.D0, 1, 0, OUT, 3, MSG, INFO)
      CALL STATUS('FUGEHX, LDA < N', INFO, -1)
      CALL HASTXT('FUGEHX, LDA < N', MSG, 'LDA = 3')
      CALL FUGEED(4, X, WIDTH, GAP, 1, 0, -1, NI, OUT, OUT, OUT, OUT,
     $            KL, KL, MSG, INFO)
      CALL STATUS('FUGEED, MAXI < 0', INFO, -1)
      CALL HASTXT('FUGEED, MAXI < 0', MSG, 'MAXI = -1')
      CALL FUGEED(0, X, WIDTH, GAP, 1, 0, 2, NI, OUT, OUT, OUT, OUT,
     $            KL, KL, MSG, INFO)
      CALL STATUS('FUGEED, N = 0', INFO, -1)
      CALL FUGEED(4, X, WIDTH, GAP, 3, 0, 2, NI, OUT, OUT, OUT, OUT,
     $            KL, KL, MSG, INFO)
      CALL STATUS('FUGEED, NELEM = 3', INFO, -6)
      WIDTH(3) = 0.5D0
      CALL FUGEED(4, X, WIDTH, GAP, 1, 0, 2, NI, OUT, OUT, OUT, OUT,
     $            KL, KL, MSG, INFO)
      CALL STATUS('FUGEED, unequal cells', INFO, -7)
      CALL HASTXT('FUGEED, unequal cells', MSG, 'cell 3')
      WIDTH(3) = 1.D0
      GAP(2) = BAD
      CALL FUGEED(4, X, WIDTH, GAP, 1, 0, 2, NI, OUT, OUT, OUT, OUT,
     $            KL, KL, MSG, INFO)
      CALL STATUS('FUGEED, F NaN', INFO, -3)
      DO 30 K = 1, 8
        CALL NUMBER('untouched', OUT(K), 77.D0, 0.D0)
   30 CONTINUE
      CALL STATUS('NCON untouched', NCON, 77)
      CALL STATUS('NITER untouched', NITER, 77)
      CALL STATUS('NI untouched', NI, 77)
      CALL NUMBER('RESID untouched', RESID, 77.D0, 0.D0)
      END
