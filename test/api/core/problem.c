/* Section "problem" of fuge_core.h: motions, play and exclusions.  Three springs of 0.5 length
 * per force, so that all answers are whole or a few halves. */
#include "table1.h"

enum { N = 3 };
static const double SPRINGS[N * N] = {0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5};
static const double FLAT[N] = {0.0, 0.0, 0.0};
static const double BOWL[N] = {1.0, 0.0, 1.0};
/* A translation and a tilt about the middle. */
static const double PLANE[2 * N] = {1.0, 1.0, 1.0, -1.0, 0.0, 1.0};

static fuge_solver *springs(const double *gap, const double *gap_upper, fuge_operator **op) {
  fuge_solver *solver = new_solver(SPRINGS, N, NULL, op);
  CHECK_DONE(fuge_set_gap(solver, gap, gap_upper));
  return solver;
}

static void check_forces(const fuge_solver *solver, double f0, double f1, double f2) {
  double force[N];
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, EXACT, f0, f1, f2);
}

static void check_gaps(const fuge_solver *solver, double c0, double c1, double c2) {
  double gap[N];
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_VALUES(gap, EXACT, c0, c1, c2);
}

static void check_motions(const fuge_solver *solver, int m, const double *motion, const double *resultant) {
  double q[N], w[N];
  int motions = -1;
  CHECK_DONE(fuge_get_mode_count(solver, &motions));
  CHECK_INT(motions, m);
  fill(q, N);
  fill(w, N);
  CHECK_DONE(fuge_get_motion(solver, q));
  CHECK_DONE(fuge_get_resultant(solver, w));
  for (int j = 0; j < m; j++) {
    CHECK_NEAR(q[j], motion[j], EXACT);
    CHECK_NEAR(w[j], resultant[j], EXACT);
  }
  CHECK_UNTOUCHED(q + m, N - m);
  CHECK_UNTOUCHED(w + m, N - m);
}

static void check_message(const fuge_solver *solver, const char *part) {
  char message[300];
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, part);
}

static void test_approach(void) {
  const double two = 2.0, eight = 8.0, three = 3.0, twelve = 12.0;
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(BOWL, NULL, &op);
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALL_ORDER);
  check_message(solver, "fuge_set_approach");
  CHECK_DONE(fuge_set_approach(solver, two));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 4.0, 2.0);
  check_motions(solver, 1, &two, &eight);
  /* That load gives back that approach. */
  CHECK_DONE(fuge_set_load(solver, eight));
  CHECK_STATUS(fuge_get_motion(solver, (double[1]){0.0}), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 4.0, 2.0);
  check_motions(solver, 1, &two, &eight);
  /* Not yet touching: no force, a gap. */
  CHECK_DONE(fuge_set_approach(solver, -1.0));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 0.0, 0.0, 0.0);
  check_gaps(solver, 2.0, 1.0, 2.0);
  /* The same by the one motion there is. */
  CHECK_DONE(fuge_set_motion(solver, 0, three));
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 1, &three, (double[1]){14.0});
  CHECK_DONE(fuge_set_resultant(solver, 0, 14.0));
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 1, &three, (double[1]){14.0});
  CHECK_STATUS(fuge_set_approach(solver, NAN), FUGE_ERR_NOT_FINITE);
  check_message(solver, "approach");
  CHECK_DONE(fuge_get_motion(solver, (double[1]){twelve}));
  free_both(&solver, &op);
}

/* A solver that was never told but one motion. */
static void test_motion_alone(void) {
  int motions = -1;
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(BOWL, NULL, &op);
  CHECK_DONE(fuge_get_mode_count(solver, &motions));
  CHECK_INT(motions, 1);
  CHECK_DONE(fuge_set_motion(solver, 0, 0.5));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 0.0, 1.0, 0.0);
  /* Free again it is the plain problem: by the tableau too, and it cannot pull. */
  CHECK_DONE(fuge_set_resultant(solver, 0, -1.0));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_set_resultant(solver, 0, 1.0));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 0.0, 1.0, 0.0);
  free_both(&solver, &op);
}

static void test_tilt(void) {
  const double resultant[2] = {6.0, 2.0}, motion[2] = {1.0, 0.5};
  double modes[2 * N], loads[2];
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, NULL, &op);
  memcpy(modes, PLANE, sizeof modes);
  memcpy(loads, resultant, sizeof loads);
  CHECK_DONE(fuge_set_modes(solver, 2, modes, loads));
  /* The arrays are copied. */
  modes[0] = loads[0] = NAN;
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 1.0, 2.0, 3.0);
  check_gaps(solver, 0.0, 0.0, 0.0);
  check_motions(solver, 2, motion, resultant);
  /* The tilt given: its moment is a result. */
  CHECK_DONE(fuge_set_motion(solver, 1, 0.5));
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 2, motion, resultant);
  CHECK_DONE(fuge_set_motion(solver, 0, 1.0));
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 2, motion, resultant);
  CHECK_DONE(fuge_set_resultant(solver, 1, 2.0));
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 2, motion, resultant);
  CHECK_DONE(fuge_set_resultant(solver, 0, 3.0));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 0.0, 1.0, 2.0);
  /* fuge_reset leaves the problem, fuge_set_load makes it the plain one. */
  CHECK_DONE(fuge_reset(solver));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 0.0, 1.0, 2.0);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 2.0, 2.0);
  check_motions(solver, 1, motion, resultant);
  free_both(&solver, &op);
}

static void test_no_equilibrium(void) {
  const double outside[2] = {2.0, 3.0}, pull[2] = {-1.0, 0.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, NULL, &op);
  CHECK_DONE(fuge_set_modes(solver, 2, PLANE, outside));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_NO_EQUILIBRIUM);
  check_message(solver, "passes at 1.500000, but the points reach from -1.000000 to 1.000000");
  CHECK_STATUS(fuge_get_force(solver, (double[N]){0.0}), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_set_modes(solver, 2, PLANE, pull));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_NO_EQUILIBRIUM);
  check_message(solver, "-1.0");
  free_both(&solver, &op);
}

/* m = 0: nothing moves but the springs. */
static void test_no_motion(void) {
  const double deep[N] = {-1.0, 1.0, -2.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(deep, NULL, &op);
  CHECK_DONE(fuge_set_modes(solver, 0, NULL, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 0.0, 4.0);
  check_gaps(solver, 0.0, 1.0, 0.0);
  check_motions(solver, 0, NULL, NULL);
  CHECK_STATUS(fuge_set_motion(solver, 0, 1.0), FUGE_ERR_SIZE);
  check_message(solver, "no mode");
  check_forces(solver, 2.0, 0.0, 4.0);
  free_both(&solver, &op);
}

static void test_play(void) {
  const double play[N] = {HUGE_VAL, 1.0, 0.0}, wide[N] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  const double up[N] = {-1.0, 3.0, 1.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(up, play, &op);
  CHECK_DONE(fuge_set_modes(solver, 0, NULL, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, -4.0, -2.0);
  check_gaps(solver, 0.0, 1.0, 0.0);
  /* The stop taken away: the next solve starts from it all the same. */
  CHECK_DONE(fuge_set_gap(solver, up, wide));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 0.0, 0.0);
  check_gaps(solver, 0.0, 3.0, 1.0);
  CHECK_DONE(fuge_set_gap(solver, up, play));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, -4.0, -2.0);
  CHECK_DONE(fuge_set_gap(solver, up, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 0.0, 0.0);
  free_both(&solver, &op);
}

/* A load that pulls the points to their upper stops. */
static void test_pull(void) {
  const double play[N] = {1.0, 1.0, 1.0}, motion = -2.0, pull = -6.0;
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, play, &op);
  CHECK_STATUS(fuge_set_load(solver, pull), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_set_resultant(solver, 0, pull));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, -2.0, -2.0, -2.0);
  check_gaps(solver, 1.0, 1.0, 1.0);
  check_motions(solver, 1, &motion, &pull);
  free_both(&solver, &op);
}

static void test_excluded(void) {
  const int middle[N] = {0, -7, 0};
  const double two = 2.0, four = 4.0;
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(BOWL, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, four));
  CHECK_DONE(fuge_set_excluded(solver, middle));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0, 0.0, 2.0);
  check_gaps(solver, 0.0, -2.0, 0.0);
  check_motions(solver, 1, &two, &four);
  /* With its motions in another form the gap of a point that takes no part is the same. */
  CHECK_DONE(fuge_set_modes(solver, 2, PLANE, (double[2]){4.0, 0.0}));
  CHECK_DONE(fuge_solve(solver));
  check_gaps(solver, 0.0, -2.0, 0.0);
  CHECK_DONE(fuge_set_load(solver, four));
  CHECK_DONE(fuge_set_excluded(solver, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_forces(solver, 2.0 / 3.0, 8.0 / 3.0, 2.0 / 3.0);
  free_both(&solver, &op);
}

static void test_derivatives(void) {
  const double moment[2] = {0.0, 1.0}, unit[N] = {0.0, 1.0, 0.0}, mixed[2] = {6.0, 1.0};
  double force[N], gap[N], motion[2];
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, NULL, &op);
  CHECK_DONE(fuge_set_modes(solver, 2, PLANE, (double[2]){6.0, 2.0}));
  fill(force, N);
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, moment, force, gap, motion), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, moment, NULL, gap, motion), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_derivatives(NULL, NULL, moment, force, gap, motion), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, (double[2]){NAN, 0.0}, force, gap, motion), FUGE_ERR_NOT_FINITE);
  CHECK_UNTOUCHED(force, N);
  CHECK_DONE(fuge_get_derivatives(solver, NULL, moment, force, gap, motion));
  CHECK_VALUES(force, EXACT, -0.5, 0.0, 0.5);
  CHECK_VALUES(motion, EXACT, 0.0, 0.25);
  CHECK_DONE(fuge_get_derivatives(solver, unit, NULL, force, NULL, NULL));
  CHECK_VALUES(force, EXACT, 2.0 / 3.0, -4.0 / 3.0, 2.0 / 3.0);
  /* The load of the translation and the value of the tilt. */
  CHECK_DONE(fuge_set_motion(solver, 1, 0.5));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_derivatives(solver, NULL, mixed, force, gap, motion));
  CHECK_VALUES(force, EXACT, 0.0, 2.0, 4.0);
  CHECK_VALUES(motion, EXACT, 1.0, 1.0);
  for (int k = 0; k < N; k++) CHECK_NEAR(gap[k], 0.0, EXACT);
  free_both(&solver, &op);
}

/* Each refusal leaves problem and answer as they are. */
static void test_refusals(void) {
  const double negative[N] = {1.0, -0.5, 1.0}, not_a_number[2 * N] = {1.0, 1.0, 1.0, 1.0, NAN, 1.0};
  const double infinite[2] = {1.0, HUGE_VAL}, resultant[2] = {6.0, 2.0}, motion[2] = {1.0, 0.5};
  int motions = -5;
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, NULL, &op);
  CHECK_DONE(fuge_set_modes(solver, 2, PLANE, resultant));
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(fuge_set_gap(solver, FLAT, negative), FUGE_ERR_GAP);
  check_message(solver, "gap_upper(1)");
  CHECK_STATUS(fuge_set_gap(solver, FLAT, not_a_number + 3), FUGE_ERR_NOT_FINITE);
  check_message(solver, "gap_upper(1)");
  CHECK_STATUS(fuge_set_gap(solver, NULL, FLAT), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_modes(solver, -1, PLANE, resultant), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_set_modes(solver, N + 1, PLANE, resultant), FUGE_ERR_MODES);
  check_message(solver, "4 modes of 3 point(s)");
  CHECK_STATUS(fuge_set_modes(solver, 2, NULL, resultant), FUGE_ERR_POINTER);
  check_message(solver, "modes is NULL");
  CHECK_STATUS(fuge_set_modes(solver, 2, PLANE, NULL), FUGE_ERR_POINTER);
  check_message(solver, "resultant is NULL");
  CHECK_STATUS(fuge_set_modes(solver, 2, not_a_number, resultant), FUGE_ERR_NOT_FINITE);
  check_message(solver, "mode 1 at point (1)");
  CHECK_STATUS(fuge_set_modes(solver, 2, PLANE, infinite), FUGE_ERR_NOT_FINITE);
  check_message(solver, "resultant(1)");
  CHECK_STATUS(fuge_set_motion(solver, 2, 0.0), FUGE_ERR_SIZE);
  check_message(solver, "mode = 2 is not one of the 2 modes, 0 .. 1");
  CHECK_STATUS(fuge_set_motion(solver, -1, 0.0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_set_motion(solver, 0, NAN), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(fuge_set_resultant(solver, 2, 0.0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_set_resultant(solver, 0, -HUGE_VAL), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(fuge_set_load(solver, -1.0), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_STATUS(fuge_set_approach(solver, HUGE_VAL), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(fuge_get_mode_count(solver, NULL), FUGE_ERR_POINTER);
  check_motions(solver, 2, motion, resultant);
  CHECK_DONE(fuge_solve(solver));
  check_motions(solver, 2, motion, resultant);
  CHECK_STATUS(fuge_set_gap(NULL, FLAT, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_excluded(NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_load(NULL, 1.0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_approach(NULL, 1.0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_modes(NULL, 2, PLANE, resultant), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_motion(NULL, 0, 1.0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_resultant(NULL, 0, 1.0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_mode_count(NULL, &motions), FUGE_ERR_POINTER);
  CHECK_INT(motions, -5);
  free_both(&solver, &op);
}

/* Each setter that succeeds makes earlier results unavailable. */
static void test_results_belong_to_the_problem(void) {
  double force[N];
  fuge_operator *op = NULL;
  fuge_solver *solver = springs(FLAT, NULL, &op);
  fill(force, N);
  for (int setter = 0; setter < 7; setter++) {
    CHECK_DONE(fuge_set_load(solver, 6.0));
    CHECK_DONE(fuge_solve(solver));
    if (setter == 0) CHECK_DONE(fuge_set_gap(solver, FLAT, NULL));
    if (setter == 1) CHECK_DONE(fuge_set_load(solver, 6.0));
    if (setter == 2) CHECK_DONE(fuge_set_excluded(solver, NULL));
    if (setter == 3) CHECK_DONE(fuge_set_approach(solver, 1.0));
    if (setter == 4) CHECK_DONE(fuge_set_modes(solver, 0, NULL, NULL));
    if (setter == 5) CHECK_DONE(fuge_set_motion(solver, 0, 1.0));
    if (setter == 6) CHECK_DONE(fuge_set_resultant(solver, 0, 6.0));
    CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
    check_message(solver, "present problem");
  }
  CHECK_UNTOUCHED(force, N);
  free_both(&solver, &op);
}

int main(void) {
  test_approach();
  test_motion_alone();
  test_tilt();
  test_no_equilibrium();
  test_no_motion();
  test_play();
  test_pull();
  test_excluded();
  test_derivatives();
  test_refusals();
  test_results_belong_to_the_problem();
  return check_summary();
}
