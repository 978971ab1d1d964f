C     Load paths, called without any interface. Answers by hand.
      PROGRAM PATHS
      CALL LOADS
      CALL STEPS
      CALL REFUSE
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

C     The first node touches at once and sinks by 0.2 for each unit of
C     load; from 10 on both carry, and sink by 0.15.
      SUBROUTINE LOADS
      DOUBLE PRECISION ALPHA(3,2), GAP(2), FE(4), VE(4), RATE(4), RESID,
     $                 EPS
      PARAMETER (EPS=1.D-13)
      INTEGER NE, IPOINT(4), ISTATE(4), NCON(4), INFO, I
      CHARACTER*256 MSG
      CALL TWONOD(ALPHA, GAP)
      MSG = 'old'
      FE(4) = 77.D0
      CALL FUGELP(2, ALPHA, 3, GAP, 12.D0, 4, NE, FE, VE, RATE, IPOINT,
     $            ISTATE, NCON, RESID, MSG, INFO)
      CALL STATUS('FUGELP', INFO, 0)
      CALL STATUS('FUGELP blank MSG', INDEX(MSG, 'old'), 0)
      CALL STATUS('FUGELP NE', NE, 3)
      CALL NUMBER('FUGELP RESID', RESID, 0.D0, EPS)
      CALL STATUS('the start', IPOINT(1), 0)
      CALL STATUS('first point', IPOINT(2), 1)
      CALL STATUS('second point', IPOINT(3), 2)
      CALL NUMBER('FUGELP FE(1)', FE(1), 0.D0, 0.D0)
      CALL NUMBER('FUGELP FE(2)', FE(2), 0.D0, 0.D0)
      CALL NUMBER('FUGELP FE(3)', FE(3), 10.D0, 10*EPS)
      CALL NUMBER('FUGELP FE(4)', FE(4), 77.D0, 0.D0)
      CALL NUMBER('FUGELP VE(3)', VE(3), 2.D0, 2*EPS)
      CALL NUMBER('FUGELP RATE(2)', RATE(2), 0.2D0, EPS)
      CALL NUMBER('FUGELP RATE(3)', RATE(3), 0.15D0, EPS)
      CALL STATUS('FUGELP ISTATE(3)', ISTATE(3), 1)
      CALL STATUS('FUGELP NCON(2)', NCON(2), 1)
      CALL STATUS('FUGELP NCON(3)', NCON(3), 2)
C     Room for two, then none.
      FE(3) = 77.D0
      CALL FUGELP(2, ALPHA, 3, GAP, 12.D0, 2, NE, FE, VE, RATE, IPOINT,
     $            ISTATE, NCON, RESID, MSG, INFO)
      CALL STATUS('room for two', INFO, 0)
      CALL STATUS('room for two, NE', NE, 3)
      CALL NUMBER('room for two, FE(3)', FE(3), 77.D0, 0.D0)
      DO 10 I = 1, 4
        FE(I) = 77.D0
   10 CONTINUE
      CALL FUGELP(2, ALPHA, 3, GAP, 12.D0, 0, NE, FE, VE, RATE, IPOINT,
     $            ISTATE, NCON, RESID, MSG, INFO)
      CALL STATUS('question, NE', NE, 3)
      CALL NUMBER('question, FE(1)', FE(1), 77.D0, 0.D0)
      END

C     The load of the two nodes grows from 2 to 12; they sink from 0.4 to
C     3; they rise, and the second one meets an upper stop.
      SUBROUTINE STEPS
      DOUBLE PRECISION ALPHA(3,2), GAP(2), PLAY(2), R(3,1), W(1), Q(1),
     $                 WEND(1), TE(4), QE(1,4), RATE(1,4), RESID, EPS
      PARAMETER (EPS=1.D-13)
      INTEGER NSTOP(2), NHELD(1), NE, NSTART(2), IPOINT(4), ISTATE(4),
     $        NCON(4), INFO
      CHARACTER*256 MSG
      DATA NSTOP /1, 1/
      DATA PLAY /-1.D0, 0.5D0/
      DATA R /1.D0, 1.D0, 77.D0/
      CALL TWONOD(ALPHA, GAP)
      NHELD(1) = 0
      W(1) = 2.D0
      WEND(1) = 12.D0
      CALL FUGEFP(2, 1, ALPHA, 3, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            WEND, 4, NE, NSTART, TE, QE, RATE, IPOINT, ISTATE,
     $            NCON, RESID, MSG, INFO)
      CALL STATUS('FUGEFP', INFO, 0)
      CALL STATUS('FUGEFP NE', NE, 2)
      CALL STATUS('FUGEFP NSTART(1)', NSTART(1), 1)
      CALL STATUS('FUGEFP NSTART(2)', NSTART(2), 0)
      CALL STATUS('FUGEFP IPOINT(2)', IPOINT(2), 2)
      CALL STATUS('FUGEFP ISTATE(2)', ISTATE(2), 1)
      CALL STATUS('FUGEFP NCON(2)', NCON(2), 2)
      CALL NUMBER('FUGEFP TE(1)', TE(1), 0.D0, 0.D0)
      CALL NUMBER('FUGEFP TE(2)', TE(2), 0.8D0, EPS)
      CALL NUMBER('FUGEFP QE(1)', QE(1,1), 0.4D0, EPS)
      CALL NUMBER('FUGEFP QE(2)', QE(1,2), 2.D0, 2*EPS)
      CALL NUMBER('FUGEFP RATE(1)', RATE(1,1), 2.D0, 2*EPS)
      CALL NUMBER('FUGEFP RATE(2)', RATE(1,2), 1.5D0, 2*EPS)
      CALL NUMBER('FUGEFP RESID', RESID, 0.D0, EPS)
      NHELD(1) = 1
      Q(1) = 0.4D0
      WEND(1) = 3.D0
      CALL FUGEFP(2, 1, ALPHA, 3, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            WEND, 4, NE, NSTART, TE, QE, RATE, IPOINT, ISTATE,
     $            NCON, RESID, MSG, INFO)
      CALL STATUS('FUGEFP, held', INFO, 0)
      CALL STATUS('FUGEFP, held, NE', NE, 2)
      CALL NUMBER('FUGEFP, held, TE(2)', TE(2), 1.6D0/2.6D0, EPS)
      CALL NUMBER('FUGEFP, held, QE(2)', QE(1,2), 2.D0, 2*EPS)
C     Node 2 has a play of 0.5: with F = 5 Q on node 1 its gap is 1 -
C     0.5 Q, so that from Q = 1.5 up to 0.5 it meets the upper stop at 1.
      NSTOP(2) = 2
      GAP(2) = 1.D0
      Q(1) = 1.5D0
      WEND(1) = 0.5D0
      CALL FUGEFP(2, 1, ALPHA, 3, GAP, NSTOP, PLAY, R, 3, NHELD, W, Q,
     $            WEND, 4, NE, NSTART, TE, QE, RATE, IPOINT, ISTATE,
     $            NCON, RESID, MSG, INFO)
      CALL STATUS('FUGEFP, play', INFO, 0)
      CALL STATUS('FUGEFP, play, NE', NE, 2)
      CALL STATUS('FUGEFP, play, ISTATE', ISTATE(2), -1)
      CALL NUMBER('FUGEFP, play, TE(2)', TE(2), 0.5D0, EPS)
C     No motion: nothing moves, and only the start is an entry.
      CALL FUGEFP(2, 0, ALPHA, 3, GAP, NSTOP, PLAY, R, 1, NHELD, W, Q,
     $            WEND, 4, NE, NSTART, TE, QE, RATE, IPOINT, ISTATE,
     $            NCON, RESID, MSG, INFO)
      CALL STATUS('FUGEFP, M = 0', INFO, 0)
      CALL STATUS('FUGEFP, M = 0, NE', NE, 1)
      END

C     Every refusal has a message and leaves the outputs alone.
      SUBROUTINE REFUSE
      DOUBLE PRECISION ALPHA(3,2), GAP(2), PLAY(2), R(2,1), W(1), Q(1),
     $                 WEND(1), OUT(4), RESID, F0, BAD
      INTEGER NSTOP(2), NHELD(1), NE, NSTART(2), IOUT(4), INFO, K, N,
     $        M, LDA, LDR, MAXE, NBITS(2), IWANT(8)
      CHARACTER*256 MSG
      CHARACTER*8 PART(8)
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA R /1.D0, 1.D0/
      DATA PLAY /0.D0, 0.D0/
      DATA IWANT /-1, -1, -1, -10, -3, -8, -14, -1/
      DATA PART /'N = 0', 'LDA = 1', 'MAXE = -', 'negative', 'NaN',
     $           'alpha(2,', 'NSTOP(2)', 'M = -1'/
      DO 20 K = 1, 8
        CALL TWONOD(ALPHA, GAP)
        N = 2
        M = 1
        LDA = 3
        LDR = 2
        MAXE = 4
        F0 = 12.D0
        W(1) = 2.D0
        Q(1) = 77.D0
        NHELD(1) = 0
        NSTOP(1) = 1
        NSTOP(2) = 1
        NE = 77
        RESID = 77.D0
        DO 10 I = 1, 4
          OUT(I) = 77.D0
          IOUT(I) = 77
   10   CONTINUE
        IF (K .EQ. 1) N = 0
        IF (K .EQ. 2) LDA = 1
        IF (K .EQ. 3) MAXE = -1
        IF (K .EQ. 4) F0 = -1.D0
        IF (K .EQ. 5) F0 = BAD
        IF (K .EQ. 6) ALPHA(2,1) = 0.3D0
        IF (K .EQ. 7) NSTOP(2) = 9
        IF (K .EQ. 8) M = -1
        WEND(1) = F0
        IF (K .LE. 6) THEN
          CALL FUGELP(N, ALPHA, LDA, GAP, F0, MAXE, NE, OUT, OUT, OUT,
     $      IOUT, IOUT, IOUT, RESID, MSG, INFO)
          CALL STATUS('FUGELP', INFO, IWANT(K))
          CALL HASTXT('FUGELP', MSG, PART(K)(:INDEX(PART(K)//'  ',
     $      '  ')-1))
        END IF
        CALL FUGEFP(N, M, ALPHA, LDA, GAP, NSTOP, PLAY, R, LDR, NHELD,
     $    W, Q, WEND, MAXE, NE, NSTART, OUT, OUT, OUT, IOUT, IOUT,
     $    IOUT, RESID, MSG, INFO)
        CALL STATUS('FUGEFP', INFO, IWANT(K))
        IF (K .EQ. 4) CALL HASTXT('FUGEFP', MSG, 'equilibrium ends')
        IF (K .NE. 4) CALL HASTXT('FUGEFP', MSG, PART(K)(:INDEX(PART(K)
     $    //'  ', '  ')-1))
        CALL STATUS('NE untouched', NE, 77)
        CALL STATUS('entries untouched', IOUT(1), 77)
        CALL NUMBER('events untouched', OUT(1), 77.D0, 0.D0)
        CALL NUMBER('RESID untouched', RESID, 77.D0, 0.D0)
   20 CONTINUE
      END
