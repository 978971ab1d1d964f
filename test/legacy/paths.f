C     Load paths, called without any interface. Answers by hand.
      PROGRAM PATHS
      CALL LOADS
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

C     Every refusal has a message and leaves the outputs alone.
      SUBROUTINE REFUSE
      DOUBLE PRECISION ALPHA(3,2), GAP(2), OUT(4), RESID, F0, BAD
      INTEGER NE, IOUT(4), INFO, I, K, N, LDA, MAXE, NBITS(2), IWANT(6)
      CHARACTER*256 MSG
      CHARACTER*8 PART(6)
      EQUIVALENCE (BAD, NBITS)
      DATA NBITS /-1, -1/
      DATA IWANT /-1, -1, -1, -10, -3, -8/
      DATA PART /'N = 0', 'LDA = 1', 'MAXE = -', 'negative', 'NaN',
     $           'alpha(2,'/
      DO 20 K = 1, 6
        CALL TWONOD(ALPHA, GAP)
        N = 2
        LDA = 3
        MAXE = 4
        F0 = 12.D0
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
        CALL FUGELP(N, ALPHA, LDA, GAP, F0, MAXE, NE, OUT, OUT, OUT,
     $    IOUT, IOUT, IOUT, RESID, MSG, INFO)
        CALL STATUS('FUGELP', INFO, IWANT(K))
        CALL HASTXT('FUGELP', MSG, PART(K)(:INDEX(PART(K)//'  ',
     $    '  ')-1))
        CALL STATUS('NE untouched', NE, 77)
        CALL STATUS('entries untouched', IOUT(1), 77)
        CALL NUMBER('events untouched', OUT(1), 77.D0, 0.D0)
        CALL NUMBER('RESID untouched', RESID, 77.D0, 0.D0)
   20 CONTINUE
      END
