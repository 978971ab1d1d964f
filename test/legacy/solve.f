C     The external procedures that solve for a matrix, and the matrix of
C     cells on a half-plane, called without any interface. Answers by
C     hand.
      PROGRAM SOLVE
      CALL PLAIN
      CALL GIVEN
      CALL BOTH
      CALL LEVER
      CALL EXPERT
      CALL REFUSE
      CALL HPLANE
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
      DOUBLE PRECISION ALPHA(3,2), GAP(2), F(2), C(2), F0, V0, RESID,
     $                 EPS
      PARAMETER (EPS=1.D-14)
      INTEGER NCON, NITER, INFO
      CHARACTER*80 MSG
      CALL TWONOD(ALPHA, GAP)
      V0 = 0.4D0
      CALL FUGESX(2, ALPHA, 3, GAP, 1, F0, V0, 0, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, approach', INFO, 0)
      CALL NUMBER('FUGESX F0', F0, 2.D0, EPS)
      CALL NUMBER('FUGESX F(1)', F(1), 2.D0, EPS)
      CALL NUMBER('FUGESX C(2)', C(2), 0.8D0, EPS)
      V0 = -1.D0
      CALL FUGESX(2, ALPHA, 3, GAP, 1, F0, V0, 0, 0.D0, 0, F, C, NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX apart', INFO, 0)
      CALL NUMBER('FUGESX F0 apart', F0, 0.D0, 0.D0)
      CALL NUMBER('FUGESX C(2) apart', C(2), 2.D0, EPS)
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
      DOUBLE PRECISION F(2), C(2), Q(2), RESID, EPS
      PARAMETER (EPS=1.D-14)
      INTEGER NSTOP(2), NHELD(2), NCON, NITER, INFO
      CHARACTER*80 MSG
      DATA ALPHA /0.1D0, 0.D0, 0.D0, 0.1D0/
      DATA GAP /0.D0, 0.D0/
      DATA R /1.D0, 1.D0, 7.D0, 0.D0, 1.D0, 7.D0/
      DATA NSTOP /2, 1/
      DATA NHELD /0, 0/
C     Not read where there is one stop.
      DATA PLAY /0.5D0, -1.D0/
      DATA W /1.D0, 2.D0/
      CALL FUGEGX(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX of a lever', INFO, 0)
      CALL NUMBER('lever, F(1)', F(1), -1.D0, EPS)
      CALL NUMBER('lever, F(2)', F(2), 2.D0, EPS)
      CALL NUMBER('lever, C(1)', C(1), 0.5D0, EPS)
      CALL NUMBER('lever, C(2)', C(2), 0.D0, EPS)
      CALL NUMBER('lever, Q(1)', Q(1), -0.6D0, EPS)
      CALL NUMBER('lever, Q(2)', Q(2), 0.8D0, EPS)
C     One-sided it tips over.
      NSTOP(1) = 1
      F(1) = 7.D0
      CALL FUGEGX(2, 2, ALPHA, 2, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX tips', INFO, -10)
      CALL NUMBER('FUGEGX tips, F(1)', F(1), 7.D0, 0.D0)
C     Without motions the points push back what is pressed into them.
      GAP(2) = -0.3D0
      CALL FUGEGX(2, 0, ALPHA, 2, GAP, NSTOP, PLAY, R, 1, NHELD, W, Q,
     $            0, 0.D0, 0, F, C, NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX, M = 0', INFO, 0)
      CALL NUMBER('FUGEGX, M = 0, F(1)', F(1), 0.D0, 0.D0)
      CALL NUMBER('FUGEGX, M = 0, F(2)', F(2), 3.D0, 3*EPS)
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
      DOUBLE PRECISION OUT(6), RESID, V0, BAD, TOL
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
      TOL = 0.D0
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
      V0 = 2.D0
      CALL FUGESX(0, ALPHA, 3, GAP, 1, OUT(5), V0, 0, TOL, 0, OUT,
     $            OUT(3), NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, N = 0', INFO, -1)
      CALL FUGESX(2, ALPHA, 1, GAP, 1, OUT(5), V0, 0, TOL, 0, OUT,
     $            OUT(3), NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, LDA < N', INFO, -1)
      CALL FUGESX(2, ALPHA, 3, GAP, 1, OUT(5), BAD, 0, TOL, 0, OUT,
     $            OUT(3), NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, V0 NaN', INFO, -3)
      CALL FUGEGX(0, 0, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, N = 0', INFO, -1)
      CALL FUGEGX(2, -1, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, M < 0', INFO, -1)
      CALL FUGEGX(2, 2000000000, ALPHA, 3, GAP, NSTOP, PLAY, R, 2,
     $            NHELD, W, OUT(5), 0, TOL, 0, OUT, OUT(3), NCON,
     $            NITER, RESID, MSG, INFO)
      CALL STATUS('FUGEGX, M > N', INFO, -21)
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 1, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, LDR < N', INFO, -1)
      CALL FUGEGX(2, 2, ALPHA, 1, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, LDA < N', INFO, -1)
      W(2) = BAD
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, W NaN', INFO, -3)
      W(2) = 1.D0
      NSTOP(2) = 2
      PLAY(2) = -0.5D0
      CALL FUGEGX(2, 2, ALPHA, 3, GAP, NSTOP, PLAY, R, 2, NHELD, W,
     $            OUT(5), 0, TOL, 0, OUT, OUT(3), NCON, NITER, RESID,
     $            MSG, INFO)
      CALL STATUS('FUGEGX, PLAY < 0', INFO, -20)
      NSTOP(2) = 3
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
      CALL FUGESX(2, ALPHA, 3, GAP, 1, OUT(5), V0, 0, TOL, 0, OUT,
     $            OUT(3), NCON, NITER, RESID, MSG, INFO)
      CALL STATUS('FUGESX, GAP NaN', INFO, -3)
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
      CHARACTER*256 MSG
      DATA X /-0.5D0, 0.5D0/
      DATA WIDTH /1.D0, 1.D0/
      FACTOR = -2.D0/(4.D0*ATAN(1.D0)*100.D0)
      ALPHA(3,1) = 7.D0
      MSG = 'old'
      CALL FUGEHX(2, X, WIDTH, 100.D0, 0, 0, ALPHA, 3, MSG, INFO)
      CALL STATUS('FUGEHX', INFO, 0)
      CALL STATUS('FUGEHX blank MSG', INDEX(MSG, 'old'), 0)
      CALL NUMBER('FUGEHX ALPHA(1,1)', ALPHA(1,1),
     $            FACTOR*(LOG(0.5D0) - 1.D0 - LOG(4.D0)), EPS)
      CALL NUMBER('FUGEHX ALPHA(2,1)', ALPHA(2,1),
     $            FACTOR*(1.5D0*LOG(1.5D0) - 0.5D0*LOG(0.5D0) - 1.D0
     $            - LOG(4.D0)), EPS)
      CALL NUMBER('FUGEHX ALPHA(1,2)', ALPHA(1,2), ALPHA(2,1), 0.D0)
      CALL NUMBER('FUGEHX padding', ALPHA(3,1), 7.D0, 0.D0)
C     Folded: one cell stands for both.
      CALL FUGEHX(1, X(2), WIDTH, 100.D0, 0, 1, ALPHA(3,2), 1, MSG,
     $            INFO)
      CALL NUMBER('FUGEHX folded', ALPHA(3,2),
     $            0.5D0*(ALPHA(1,1) + ALPHA(2,1)), EPS)
      ALPHA(1,1) = 7.D0
      CALL FUGEHX(0, X, WIDTH, 100.D0, 0, 0, ALPHA, 3, MSG, INFO)
      CALL STATUS('FUGEHX, N = 0', INFO, -1)
      CALL HASTXT('FUGEHX, N = 0', MSG, 'N = 0')
      CALL FUGEHX(2, X, WIDTH, 100.D0, 0, 0, ALPHA, 1, MSG, INFO)
      CALL STATUS('FUGEHX, LDA < N', INFO, -1)
      CALL HASTXT('FUGEHX, LDA < N', MSG, 'LDA = 1')
      CALL FUGEHX(2, X, WIDTH, -1.D0, 0, 0, ALPHA, 3, MSG, INFO)
      CALL STATUS('FUGEHX, ESTAR < 0', INFO, -5)
      CALL HASTXT('FUGEHX, ESTAR < 0', MSG, 'e_star = -1')
      CALL FUGEHX(2, X, WIDTH, 100.D0, 3, 0, ALPHA, 3, MSG, INFO)
      CALL STATUS('FUGEHX, NELEM = 3', INFO, -6)
      CALL FUGEHX(2, X, WIDTH, 100.D0, 0, 1, ALPHA, 3, MSG, INFO)
      CALL STATUS('FUGEHX folded, X < 0', INFO, -4)
      CALL NUMBER('FUGEHX untouched', ALPHA(1,1), 7.D0, 0.D0)
      END

C     The meaning of a status.
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
