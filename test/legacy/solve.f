C     The external procedures that solve, and the half-plane, called
C     without any interface. Answers by hand.
      PROGRAM SOLVE
      CALL PLAIN
      CALL GIVEN
      CALL BOTH
      CALL LEVER
      CALL EXPERT
      CALL REFUSE
      CALL HPLANE
      CALL BYFFT
      CALL AREA
      CALL WORDS
      CALL VERDCT
      END

C     The two nodes of the paper; the third row is padding.
      SUBROUTINE TWONOD(ALPHA, GAP)
      DOUBLE PRECISION ALPHA(3,2), GAP(2)
      ALPHA(1,1) = 0.2D0
      ALPHA(2,1) = 0.1D0
      ALPHA(1,2) = 0.1D0
      ALPHA(2,2) = 0.2D0
      ALPHA(3,1) = 1.D99
      ALPHA(3,2) = -1.D99
      GAP(1) = 0.D0
      GAP(2) = 1.D0
      END

      SUBROUTINE PLAIN
      DOUBLE PRECISION ALPHA(3,2), GAP(2), F(2), C(2), V0, EPS
      PARAMETER (EPS=1.D-14)
      INTEGER INFO
      CALL TWONOD(ALPHA, GAP)
      CALL FUGESV(2, ALPHA, 3, GAP, 2.D0, F, C, V0, INFO)
      CALL STATUS('FUGESV', INFO, 0)
      CALL NUMBER('FUGESV F(1)', F(1), 2.D0, EPS)
      CALL NUMBER('FUGESV F(2)', F(2), 0.D0, EPS)
      CALL NUMBER('FUGESV C(1)', C(1), 0.D0, EPS)
      CALL NUMBER('FUGESV C(2)', C(2), 0.8D0, EPS)
      CALL NUMBER('FUGESV V0', V0, 0.4D0, EPS)
C     Both touch from F0 = 10 on: F(1) - F(2) = 10.
      CALL FUGESV(2, ALPHA, 3, GAP, 12.D0, F, C, V0, INFO)
      CALL NUMBER('FUGESV F(1) of 12', F(1), 11.D0, 12*EPS)
      CALL NUMBER('FUGESV F(2) of 12', F(2), 1.D0, 12*EPS)
C     One point, and no load.
      CALL FUGESV(1, ALPHA, 3, GAP(2), 2.D0, F, C, V0, INFO)
      CALL NUMBER('FUGESV V0 of one point', V0, 1.4D0, EPS)
      CALL FUGESV(2, ALPHA, 3, GAP, 0.D0, F, C, V0, INFO)
      CALL STATUS('FUGESV without load', INFO, 0)
      CALL NUMBER('FUGESV C(2) without load', C(2), 1.D0, 0.D0)
      END

C     The approach given: 0.4 takes the load 2, -1 leaves a gap.
      SUBROUTINE GIVEN
      DOUBLE PRECISION ALPHA(3,2), GAP(2), F(2), C(2), F0, EPS
      PARAMETER (EPS=1.D-14)
      INTEGER INFO
      CALL TWONOD(ALPHA, GAP)
      CALL FUGEAV(2, ALPHA, 3, GAP, 0.4D0, F, C, F0, INFO)
      CALL STATUS('FUGEAV', INFO, 0)
      CALL NUMBER('FUGEAV F0', F0, 2.D0, EPS)
      CALL NUMBER('FUGEAV F(1)', F(1), 2.D0, EPS)
      CALL NUMBER('FUGEAV C(2)', C(2), 0.8D0, EPS)
      CALL FUGEAV(2, ALPHA, 3, GAP, -1.D0, F, C, F0, INFO)
      CALL STATUS('FUGEAV apart', INFO, 0)
      CALL NUMBER('FUGEAV F0 apart', F0, 0.D0, 0.D0)
      CALL NUMBER('FUGEAV C(2) apart', C(2), 2.D0, EPS)
      END

C     Both by FUGESX, with each method; a message that is cut to fit.
      SUBROUTINE BOTH
      DOUBLE PRECISION ALPHA(3,2), GAP(2), F(2), C(2), F0, V0, RESID,
     $                 EPS
      PARAMETER (EPS=1.D-14)
      INTEGER NCON, NITER, INFO, METHOD
      CHARACTER MSG*80, SHORT*8
      CALL TWONOD(ALPHA, GAP)
      DO 10 METHOD = 0, 3
        F0 = 2.D0
        V0 = 77.D0
        MSG = 'old'
        CALL FUGESX(2, ALPHA, 3, GAP, 0, F0, V0, METHOD, 0.D0, 0, F, C,
     $              NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGESX', INFO, 0)
        CALL STATUS('FUGESX blank MSG', INDEX(MSG, 'old'), 0)
        CALL NUMBER('FUGESX F(1)', F(1), 2.D0, EPS)
        CALL NUMBER('FUGESX C(2)', C(2), 0.8D0, EPS)
        CALL NUMBER('FUGESX V0', V0, 0.4D0, EPS)
        CALL NUMBER('FUGESX F0', F0, 2.D0, 0.D0)
        CALL STATUS('FUGESX NCON', NCON, 1)
        CALL NUMBER('FUGESX RESID', RESID, 0.D0, EPS)
        F0 = 77.D0
        V0 = 0.4D0
        CALL FUGESX(2, ALPHA, 3, GAP, 1, F0, V0, METHOD, 0.D0, 0, F, C,
     $              NCON, NITER, RESID, MSG, INFO)
        CALL STATUS('FUGESX, approach', INFO, 0)
        CALL NUMBER('FUGESX, F0', F0, 2.D0, EPS)
        CALL NUMBER('FUGESX, V0', V0, 0.4D0, 0.D0)
   10 CONTINUE
      SHORT = 'old'
      NCON = 7
      CALL FUGESX(2, ALPHA, 1, GAP, 1, F0, V0, 0, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, SHORT, INFO)
      CALL STATUS('FUGESX, LDA < N', INFO, -1)
      CALL HASTXT('FUGESX, LDA < N', SHORT, 'LDA = 1 ')
      F0 = -2.D0
      CALL FUGESX(2, ALPHA, 3, GAP, 0, F0, V0, 0, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX pulls', INFO, -10)
      CALL HASTXT('FUGESX pulls', MSG, 'negative')
      F0 = 2.D0
      CALL FUGESX(2, ALPHA, 3, GAP, 0, F0, V0, 9, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, METHOD = 9', INFO, -14)
      CALL HASTXT('FUGESX, METHOD = 9', MSG, 'method = 9')
      ALPHA(2,1) = 0.3D0
      CALL FUGESX(2, ALPHA, 3, GAP, 0, F0, V0, 0, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX not symmetric', INFO, -8)
      CALL HASTXT('FUGESX not symmetric', MSG, 'alpha(2,1)')
      CALL NUMBER('FUGESX, V0 untouched', V0, 0.4D0, 0.D0)
      CALL NUMBER('FUGESX, F untouched', F(1), 2.D0, EPS)
      CALL STATUS('FUGESX, NCON untouched', NCON, 7)
      END

C     A lever on two points at x = 0 and 1, a force of 1 at x = 2: the
C     first point holds it down with 1 at its upper stop.
      SUBROUTINE LEVER
      DOUBLE PRECISION ALPHA(2,2), GAP(2), PLAY(2), R(3,2), W(2)
      DOUBLE PRECISION F(2), C(2), Q(2), EPS
      PARAMETER (EPS=1.D-14)
      INTEGER NSTOP(2), INFO
      DATA ALPHA /0.1D0, 0.D0, 0.D0, 0.1D0/
      DATA GAP /0.D0, 0.D0/
      DATA R /1.D0, 1.D0, 7.D0, 0.D0, 1.D0, 7.D0/
      DATA NSTOP /2, 1/
C     Not read where there is one stop.
      DATA PLAY /0.5D0, -1.D0/
      DATA W /1.D0, 2.D0/
      CALL FUGEGV(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, W, F, C, Q,
     $            INFO)
      CALL STATUS('FUGEGV', INFO, 0)
      CALL NUMBER('FUGEGV F(1)', F(1), -1.D0, EPS)
      CALL NUMBER('FUGEGV F(2)', F(2), 2.D0, EPS)
      CALL NUMBER('FUGEGV C(1)', C(1), 0.5D0, EPS)
      CALL NUMBER('FUGEGV C(2)', C(2), 0.D0, EPS)
      CALL NUMBER('FUGEGV Q(1)', Q(1), -0.6D0, EPS)
      CALL NUMBER('FUGEGV Q(2)', Q(2), 0.8D0, EPS)
C     One-sided it tips over.
      NSTOP(1) = 1
      F(1) = 7.D0
      CALL FUGEGV(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, W, F, C, Q,
     $            INFO)
      CALL STATUS('FUGEGV tips', INFO, -10)
      CALL NUMBER('FUGEGV tips, F(1)', F(1), 7.D0, 0.D0)
C     Without motions the points push back what is pressed into them.
      GAP(2) = -0.3D0
      CALL FUGEGV(2, 0, ALPHA, 2, GAP, NSTOP, PLAY, R, 1, W, F, C, Q,
     $            INFO)
      CALL STATUS('FUGEGV, M = 0', INFO, 0)
      CALL NUMBER('FUGEGV, M = 0, F(1)', F(1), 0.D0, 0.D0)
      CALL NUMBER('FUGEGV, M = 0, F(2)', F(2), 3.D0, 3*EPS)
      END

C     The two nodes again, with a tilt held at 0 and with the first
C     point left out.
      SUBROUTINE EXPERT
      DOUBLE PRECISION ALPHA(3,2), GAP(2), PLAY(2), R(2,2), W(2), Q(2)
      DOUBLE PRECISION F(2), C(2), RESID, EPS
      PARAMETER (EPS=1.D-14)
      INTEGER NSTOP(2), NHELD(2), NCON, NITER, INFO, METHOD
      CHARACTER*80 MSG
      DATA R /1.D0, 1.D0, 3.D0, 4.D0/
      DATA NSTOP /1, 1/
      DATA NHELD /0, 1/
      DO 10 METHOD = 0, 3
        CALL TWONOD(ALPHA, GAP)
        W(1) = 2.D0
        W(2) = 77.D0
        Q(1) = 77.D0
        Q(2) = 0.D0
        MSG = 'old'
        CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W, Q,
     $              METHOD, 0.D0, 0, F, C, NCON, NITER, RESID, MSG,
     $              INFO)
        CALL STATUS('FUGEGX', INFO, 0)
        CALL NUMBER('FUGEGX F(1)', F(1), 2.D0, EPS)
        CALL NUMBER('FUGEGX C(2)', C(2), 0.8D0, EPS)
        CALL NUMBER('FUGEGX Q(1)', Q(1), 0.4D0, EPS)
        CALL NUMBER('FUGEGX Q(2)', Q(2), 0.D0, 0.D0)
        CALL NUMBER('FUGEGX W(1)', W(1), 2.D0, 0.D0)
        CALL NUMBER('FUGEGX W(2)', W(2), 6.D0, 6*EPS)
        CALL STATUS('FUGEGX NCON', NCON, 1)
        CALL NUMBER('FUGEGX RESID', RESID, 0.D0, EPS)
        CALL STATUS('FUGEGX blank MSG', INDEX(MSG, 'old'), 0)
   10 CONTINUE
      NSTOP(1) = 0
      CALL FUGEGX(2, 1, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W, Q,
     $            0, 1.D-6, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX left out', INFO, 0)
      CALL NUMBER('FUGEGX F(1) left out', F(1), 0.D0, 0.D0)
      CALL NUMBER('FUGEGX F(2) left out', F(2), 2.D0, EPS)
      CALL NUMBER('FUGEGX C(1) left out', C(1), -1.2D0, EPS)
      END

C     Every refusal leaves the outputs alone. The NaN has all bits set:
C     no operation makes it, so that none can trap.
      SUBROUTINE REFUSE
      DOUBLE PRECISION ALPHA(3,2), GAP(2), PLAY(2), R(2,2), W(2)
      DOUBLE PRECISION OUT(6), RESID, BAD, TOL
      INTEGER NSTOP(2), NHELD(2), NCON, NITER, INFO, K, NBITS(2)
      CHARACTER*80 MSG
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA R /1.D0, 1.D0, 0.D0, 1.D0/
      DATA NSTOP /1, 1/
      DATA NHELD /0, 0/
      DATA W /2.D0, 1.D0/
      DO 10 K = 1, 6
        OUT(K) = 7.D0
   10 CONTINUE
      NCON = 7
      NITER = 7
      RESID = 7.D0
      CALL TWONOD(ALPHA, GAP)
      CALL FUGESV(0, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, N = 0', INFO, -1)
      CALL FUGESV(-1, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, N < 0', INFO, -1)
      CALL FUGESV(2, ALPHA, 1, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, LDA < N', INFO, -1)
      CALL FUGESV(2, ALPHA, -1, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, LDA < 0', INFO, -1)
      CALL FUGESV(2, ALPHA, 3, GAP, -2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV pulls', INFO, -10)
      CALL FUGESV(2, ALPHA, 3, GAP, BAD, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, F0 NaN', INFO, -3)
      CALL FUGEAV(0, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEAV, N = 0', INFO, -1)
      CALL FUGEAV(2, ALPHA, 1, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEAV, LDA < N', INFO, -1)
      CALL FUGEAV(2, ALPHA, 3, GAP, BAD, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEAV, V0 NaN', INFO, -3)
      CALL FUGEGV(0, 0, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, N = 0', INFO, -1)
      CALL FUGEGV(2, -1, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, M < 0', INFO, -1)
      CALL FUGEGV(2, 2000000000, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, M > N', INFO, -21)
      CALL FUGEGV(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 1, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, LDR < N', INFO, -1)
      CALL FUGEGV(2, 2, ALPHA, 1, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, LDA < N', INFO, -1)
      W(2) = BAD
      CALL FUGEGV(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, W NaN', INFO, -3)
      W(2) = 1.D0
      NSTOP(2) = 2
      PLAY(2) = -0.5D0
      CALL FUGEGV(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, W,
     $            OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEGV, PLAY < 0', INFO, -20)
      NSTOP(2) = 3
      TOL = 0.D0
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, NSTOP = 3', INFO, -14)
      CALL HASTXT('FUGEGX, NSTOP = 3', MSG, 'NSTOP(2) = 3')
      NSTOP(2) = 1
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 9, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, METHOD = 9', INFO, -14)
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, BAD, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, TOL NaN', INFO, -14)
      GAP(2) = BAD
      CALL FUGESV(2, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, GAP NaN', INFO, -3)
      CALL FUGEAV(2, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGEAV, GAP NaN', INFO, -3)
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, GAP NaN', INFO, -3)
      CALL HASTXT('FUGEGX, GAP NaN', MSG, 'gap(2)')
      ALPHA(2,1) = BAD
      CALL FUGESV(2, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV, ALPHA NaN', INFO, -3)
      ALPHA(2,1) = 0.3D0
      CALL FUGESV(2, ALPHA, 3, GAP, 2.D0, OUT, OUT(3), OUT(5), INFO)
      CALL STATUS('FUGESV not symmetric', INFO, -8)
      DO 20 K = 1, 6
        CALL NUMBER('untouched', OUT(K), 7.D0, 0.D0)
   20 CONTINUE
      CALL NUMBER('RESID untouched', RESID, 7.D0, 0.D0)
      CALL STATUS('NCON untouched', NCON, 7)
      CALL STATUS('NITER untouched', NITER, 7)
      CALL NUMBER('W untouched', W(1) + W(2), 3.D0, 0.D0)
      END

C     Two cells of width 1 side by side; D is 4. The mean of ln|s| over
C     a cell about s = 0 is ln(1/2) - 1, over the next one
C     1.5 ln(1.5) - 0.5 ln(0.5) - 1.
      SUBROUTINE HPLANE
      DOUBLE PRECISION X(2), WIDTH(2), ALPHA(3,2), FACTOR, EPS
      PARAMETER (EPS=1.D-14)
      INTEGER INFO
      DATA X /-0.5D0, 0.5D0/
      DATA WIDTH /1.D0, 1.D0/
      FACTOR = -2.D0/(4.D0*ATAN(1.D0)*100.D0)
      ALPHA(3,1) = 7.D0
      CALL FUGEHP(2, X, WIDTH, 100.D0, 0, 0, ALPHA, 3, INFO)
      CALL STATUS('FUGEHP', INFO, 0)
      CALL NUMBER('FUGEHP ALPHA(1,1)', ALPHA(1,1),
     $            FACTOR*(LOG(0.5D0) - 1.D0 - LOG(4.D0)), EPS)
      CALL NUMBER('FUGEHP ALPHA(2,1)', ALPHA(2,1),
     $            FACTOR*(1.5D0*LOG(1.5D0) - 0.5D0*LOG(0.5D0) - 1.D0
     $            - LOG(4.D0)), EPS)
      CALL NUMBER('FUGEHP ALPHA(1,2)', ALPHA(1,2), ALPHA(2,1), 0.D0)
      CALL NUMBER('FUGEHP padding', ALPHA(3,1), 7.D0, 0.D0)
C     Folded: one cell stands for both.
      CALL FUGEHP(1, X(2), WIDTH, 100.D0, 0, 1, ALPHA(3,2), 1, INFO)
      CALL NUMBER('FUGEHP folded', ALPHA(3,2),
     $            0.5D0*(ALPHA(1,1) + ALPHA(2,1)), EPS)
      ALPHA(1,1) = 7.D0
      CALL FUGEHP(0, X, WIDTH, 100.D0, 0, 0, ALPHA, 3, INFO)
      CALL STATUS('FUGEHP, N = 0', INFO, -1)
      CALL FUGEHP(2, X, WIDTH, 100.D0, 0, 0, ALPHA, 1, INFO)
      CALL STATUS('FUGEHP, LDA < N', INFO, -1)
      CALL FUGEHP(2, X, WIDTH, -1.D0, 0, 0, ALPHA, 3, INFO)
      CALL STATUS('FUGEHP, ESTAR < 0', INFO, -5)
      CALL FUGEHP(2, X, WIDTH, 100.D0, 3, 0, ALPHA, 3, INFO)
      CALL STATUS('FUGEHP, NELEM = 3', INFO, -6)
      CALL FUGEHP(2, X, WIDTH, 100.D0, 0, 1, ALPHA, 3, INFO)
      CALL STATUS('FUGEHP folded, X < 0', INFO, -4)
      CALL NUMBER('FUGEHP untouched', ALPHA(1,1), 7.D0, 0.D0)
      END

C     Two cells by FFT, on one thread and two, and by their matrix.
      SUBROUTINE BYFFT
      DOUBLE PRECISION X(2), WIDTH(2), GAP(2), ALPHA(2,2), F(2), C(2),
     $                 V0, FM(2), CM(2), VM, EPS
      PARAMETER (EPS=1.D-12)
      INTEGER INFO, NTHR
      DATA X /-0.5D0, 0.5D0/
      DATA WIDTH /1.D0, 1.D0/
      DATA GAP /0.D0, 1.D-2/
      CALL FUGEHP(2, X, WIDTH, 100.D0, 1, 0, ALPHA, 2, INFO)
      CALL FUGESV(2, ALPHA, 2, GAP, 3.D0, FM, CM, VM, INFO)
      CALL STATUS('FUGESV of the cells', INFO, 0)
      DO 10 NTHR = 1, 2
        CALL FUGEFT(2, 1.D0, 100.D0, 1, 0, NTHR, GAP, 3.D0, F, C, V0,
     $              INFO)
        CALL STATUS('FUGEFT', INFO, 0)
        CALL NUMBER('FUGEFT F(1)', F(1), FM(1), EPS)
        CALL NUMBER('FUGEFT F(2)', F(2), FM(2), EPS)
        CALL NUMBER('FUGEFT C(1)', C(1), CM(1), EPS)
        CALL NUMBER('FUGEFT C(2)', C(2), CM(2), EPS)
        CALL NUMBER('FUGEFT V0', V0, VM, EPS)
   10 CONTINUE
C     Equal forces displace nothing on a periodic surface.
      CALL FUGEFT(2, 1.D0, 100.D0, 1, 1, 1, WIDTH, 4.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, periodic', INFO, 0)
      CALL NUMBER('FUGEFT V0, periodic', V0, 1.D0, EPS)
      F(1) = 7.D0
      CALL FUGEFT(0, 1.D0, 100.D0, 1, 0, 1, GAP, 3.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, N = 0', INFO, -1)
      CALL FUGEFT(2, 0.D0, 100.D0, 1, 0, 1, GAP, 3.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, H = 0', INFO, -4)
      CALL FUGEFT(2, 1.D0, 100.D0, 1, 2, 1, GAP, 3.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, NBOUND = 2', INFO, -14)
      CALL FUGEFT(2, 1.D0, 100.D0, 1, 0, 0, GAP, 3.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, NTHR = 0', INFO, -14)
      CALL FUGEFT(2, 1.D0, 100.D0, 1, 0, 1, GAP, -1.D0, F, C, V0, INFO)
      CALL STATUS('FUGEFT, F0 < 0', INFO, -10)
      CALL NUMBER('FUGEFT untouched', F(1), 7.D0, 0.D0)
      END

C     Four unit squares: by products, on one thread and two, and by the
C     matrix of the squares themselves, their neighbours and opposites.
      SUBROUTINE AREA
      DOUBLE PRECISION GAP(2,2), F(2,2), C(2,2), FM(2,2), CM(2,2), V0,
     $                 VM, ALPHA(4,4), SELF, SIDE, OPPOS, ESTAR, EPS
      PARAMETER (SELF=3.525494348078172D0, SIDE=1.038049735904756D0,
     $           OPPOS=0.72469743813433D0, ESTAR=100.D0, EPS=1.D-10)
      INTEGER INFO, NTHR, I, J
      DATA GAP /0.D0, 1.D-3, 2.D-3, 1.D0/
      DO 20 J = 1, 4
        DO 10 I = 1, 4
          ALPHA(I,J) = SIDE/(4.D0*ATAN(1.D0)*ESTAR)
          IF (I .EQ. J) ALPHA(I,J) = SELF/(4.D0*ATAN(1.D0)*ESTAR)
          IF (I + J .EQ. 5) ALPHA(I,J) = OPPOS/(4.D0*ATAN(1.D0)*ESTAR)
   10   CONTINUE
   20 CONTINUE
      CALL FUGESV(4, ALPHA, 4, GAP, 3.D0, FM, CM, VM, INFO)
      CALL STATUS('FUGESV of squares', INFO, 0)
      DO 50 NTHR = 1, 2
        CALL FUGEFA(2, 2, 1.D0, 1.D0, ESTAR, 0, 0, NTHR, GAP, 3.D0,
     $              F, C, V0, INFO)
        CALL STATUS('FUGEFA', INFO, 0)
        CALL NUMBER('FUGEFA V0', V0, VM, EPS)
        DO 40 J = 1, 2
          DO 30 I = 1, 2
            CALL NUMBER('FUGEFA F', F(I,J), FM(I,J), EPS)
            CALL NUMBER('FUGEFA C', C(I,J), CM(I,J), EPS)
   30     CONTINUE
   40   CONTINUE
   50 CONTINUE
      F(1,1) = 7.D0
      CALL FUGEFA(2, 0, 1.D0, 1.D0, ESTAR, 0, 0, 1, GAP, 3.D0, F, C, V0,
     $            INFO)
      CALL STATUS('FUGEFA, NY = 0', INFO, -1)
      CALL FUGEFA(65536, 65536, 1.D0, 1.D0, ESTAR, 0, 0, 1, GAP, 3.D0,
     $            F, C, V0, INFO)
      CALL STATUS('FUGEFA, NX*NY too large', INFO, -1)
      CALL FUGEFA(2, 2, 1.D0, 0.D0, ESTAR, 0, 0, 1, GAP, 3.D0, F, C, V0,
     $            INFO)
      CALL STATUS('FUGEFA, HY = 0', INFO, -4)
      CALL FUGEFA(2, 2, 1.D0, 1.D0, ESTAR, 2, 0, 1, GAP, 3.D0, F, C, V0,
     $            INFO)
      CALL STATUS('FUGEFA, NELEM = 2', INFO, -6)
      CALL FUGEFA(2, 2, 1.D0, 1.D0, ESTAR, 0, 4, 1, GAP, 3.D0, F, C, V0,
     $            INFO)
      CALL STATUS('FUGEFA, NBOUND = 4', INFO, -14)
      CALL FUGEFA(2, 2, 1.D0, 1.D0, ESTAR, 0, 0, 0, GAP, 3.D0, F, C, V0,
     $            INFO)
      CALL STATUS('FUGEFA, NTHR = 0', INFO, -14)
      CALL FUGEFA(2, 2, 1.D0, 1.D0, ESTAR, 0, 0, 1, GAP, -1.D0, F, C,
     $            V0, INFO)
      CALL STATUS('FUGEFA, F0 < 0', INFO, -10)
      CALL NUMBER('FUGEFA untouched', F(1,1), 7.D0, 0.D0)
      END

      SUBROUTINE WORDS
      CHARACTER TEXT*64, SHORT*4
      CALL FUGETX(0, TEXT)
      CALL HASTXT('FUGETX(0)', TEXT, 'done  ')
      CALL FUGETX(-8, TEXT)
      CALL HASTXT('FUGETX(-8)', TEXT, 'not symmetric')
      CALL FUGETX(-999, TEXT)
      CALL HASTXT('FUGETX(-999)', TEXT, 'unknown')
      CALL FUGETX(-8, SHORT)
      CALL HASTXT('FUGETX cut', SHORT, 'the ')
      END
