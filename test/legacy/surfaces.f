C     Cells on a half-plane by FFT, under a load and with the approach
C     prescribed, called without any interface: against their matrix,
C     Hertz's roller and a wave.
      PROGRAM SURFAC
      CALL BYFFT
      CALL ROLLER
      CALL REPEAT
      CALL REFUSE
      CALL VERDCT
      END

C     Two cells by FFT, by all cores, one thread and two, and by their
C     matrix.
      SUBROUTINE BYFFT
      DOUBLE PRECISION X(2), WIDTH(2), GAP(2), ALPHA(2,2), F(2), C(2),
     $                 F0, V0, FM(2), CM(2), VM, RESID, EPS
      PARAMETER (EPS=1.D-12)
      INTEGER NCON, NITER, INFO, NTHR
      CHARACTER*256 MSG
      DATA X /-0.5D0, 0.5D0/
      DATA WIDTH /1.D0, 1.D0/
      DATA GAP /0.D0, 1.D-2/
      CALL FUGEHX(2, X, WIDTH, 100.D0, 1, 0, ALPHA, 2, MSG, INFO)
      CALL FUGESV(2, ALPHA, 2, GAP, 3.D0, FM, CM, VM, INFO)
      CALL STATUS('FUGESV of the cells', INFO, 0)
      F0 = 3.D0
      DO 10 NTHR = 0, 2
        CALL FUGEFX(2, 1.D0, 100.D0, 1, 0, NTHR, GAP, 0, F0, V0, 0.D0,
     $              0, F, C, NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('two cells', INFO, 0)
        CALL NUMBER('two cells, F(1)', F(1), FM(1), EPS)
        CALL NUMBER('two cells, F(2)', F(2), FM(2), EPS)
        CALL NUMBER('two cells, C(1)', C(1), CM(1), EPS)
        CALL NUMBER('two cells, C(2)', C(2), CM(2), EPS)
        CALL NUMBER('two cells, V0', V0, VM, EPS)
   10 CONTINUE
C     Equal forces displace nothing on a periodic surface.
      F0 = 4.D0
      CALL FUGEFX(2, 1.D0, 100.D0, 1, 1, 1, WIDTH, 0, F0, V0, 0.D0, 0,
     $            F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('two cells, periodic', INFO, 0)
      CALL NUMBER('two cells, periodic, V0', V0, 1.D0, EPS)
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
     $                 LOAD, A, H, LARGE
      INTEGER NCON, NITER, INFO, I
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
      A = SQRT(16.D0*LOAD*R/(4.D0*ATAN(1.D0)*ESTAR))/2.D0
      CALL NUMBER('contact width', NCON*H, 2.D0*A, H)
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
      CALL NUMBER('pressure', LARGE, LOAD/(2.D0*ATAN(1.D0)*A), 1.D0)
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

C     Length of a text without the blanks at its end.
      INTEGER FUNCTION LENTXT(TEXT)
      CHARACTER*(*) TEXT
      INTEGER I
      LENTXT = 0
      DO 10 I = 1, LEN(TEXT)
        IF (TEXT(I:I) .NE. ' ') LENTXT = I
   10 CONTINUE
      END

C     Every refusal has a message and leaves the outputs alone. The NaN
C     has all bits set: no operation makes it, so that none can trap.
      SUBROUTINE REFUSE
      DOUBLE PRECISION GAP(4), OUT(8), V0, F0, RESID, BAD, H, ESTAR, TOL
      INTEGER NBITS(2), IWANT(10), INFO, K, N, NELEM, NBOUND, NTHR,
     $        MAXIT, NCON, NITER, NHELD
      CHARACTER*256 MSG
      CHARACTER*16 PART(10)
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA GAP /0.D0, 1.D0, 1.D0, 0.D0/
      DATA IWANT /-1, -4, -5, -6, -14, -14, -10, -3, -14, -14/
      DATA PART /'n = 0', 'spacing', 'e_star', 'element', 'boundary',
     $  'threads', 'load', 'motion', 'max_iterations', 'tolerance'/
      DO 10 K = 1, 8
        OUT(K) = 77.D0
   10 CONTINUE
      NCON = 77
      NITER = 77
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
        IF (K .EQ. 5) NBOUND = 2
        IF (K .EQ. 6) NTHR = -1
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
   20 CONTINUE
      DO 30 K = 1, 8
        CALL NUMBER('untouched', OUT(K), 77.D0, 0.D0)
   30 CONTINUE
      CALL STATUS('NCON untouched', NCON, 77)
      CALL STATUS('NITER untouched', NITER, 77)
      CALL NUMBER('RESID untouched', RESID, 77.D0, 0.D0)
      END
