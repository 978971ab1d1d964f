/* Section "design" of fuge_core.h: gradients, and the gaps for a wanted pressure. */
#include "table1.h"

enum { N = 3 };

static const double ALPHA[N * N] = {1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 4.0};
static const double THIRD = 1.0 / 3.0;

/* Three independent points: forces 3/2, 1/4 and 0, approach 3/2. */
static fuge_solver *new_springs(fuge_operator **op) {
  const double gap[N] = {0.0, 1.0, 2.0};
  fuge_solver *solver = new_solver(ALPHA, N, NULL, op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 1.75));
  return solver;
}

static void check_message(const fuge_solver *solver, const char *part) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, part);
}

/* The gradients by gaps and loads alone. */
static int get_gradients(const fuge_solver *solver, const double *force_weight, const double *gap_weight,
                         const double *motion_weight, double *by_gap, double *by_load) {
  return fuge_get_gradients(solver, force_weight, gap_weight, motion_weight, by_gap, by_load, NULL, NULL, NULL, NULL,
                            NULL, NULL, NULL);
}

/* By hand: q = (w + g_1 + g_2/2)/(3/2), f_1 = q - g_1, c_3 = g_3 - q. */
static void test_gradients(void) {
  const double first[N] = {1.0, 0.0, 0.0}, last[N] = {0.0, 0.0, 1.0}, one = 1.0;
  double by_gap[N], by_load = SENTINEL;
  fuge_operator *op = NULL;
  fuge_solver *solver = new_springs(&op);
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(get_gradients(solver, first, NULL, NULL, by_gap, &by_load));
  CHECK_VALUES(by_gap, EXACT, -THIRD, THIRD, 0.0);
  CHECK_NEAR(by_load, 2.0 * THIRD, EXACT);
  CHECK_DONE(get_gradients(solver, NULL, last, NULL, by_gap, &by_load));
  CHECK_VALUES(by_gap, EXACT, -2.0 * THIRD, -THIRD, 1.0);
  CHECK_NEAR(by_load, -2.0 * THIRD, EXACT);
  CHECK_DONE(get_gradients(solver, NULL, NULL, &one, by_gap, NULL));
  CHECK_VALUES(by_gap, EXACT, 2.0 * THIRD, THIRD, 0.0);
  CHECK_DONE(get_gradients(solver, NULL, NULL, NULL, by_gap, &by_load));
  CHECK_VALUES(by_gap, 0.0, 0.0, 0.0, 0.0);
  /* The gradient in the place of the weights. */
  by_gap[0] = 1.0;
  CHECK_DONE(get_gradients(solver, by_gap, NULL, NULL, by_gap, NULL));
  CHECK_VALUES(by_gap, EXACT, -THIRD, THIRD, 0.0);
  free_both(&solver, &op);
}

static void test_all_gradients(void) {
  const double first[N] = {1.0, 0.0, 0.0}, limit[N] = {10.0, 0.25, 10.0};
  double compliance[N], stiffness, play[N], by_limit[N], by_upper[N], modulus;
  int at_kink[N] = {-1, -1, -1};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_springs(&op);
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_gradients(solver, first, NULL, NULL, NULL, NULL, compliance, &stiffness, play, by_limit, by_upper,
                                &modulus, at_kink));
  CHECK_VALUES(compliance, EXACT, -0.5, 0.25 * THIRD, 0.0);
  CHECK_NEAR(stiffness, -1.5 * 2.0 * THIRD, EXACT);
  CHECK_NEAR(modulus, THIRD, EXACT);
  for (int k = 0; k < N; k++) {
    CHECK_INT(at_kink[k], 0);
    CHECK(play[k] == 0.0 && by_limit[k] == 0.0 && by_upper[k] == 0.0);
  }
  CHECK_DONE(fuge_get_gradients(solver, first, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL));
  /* At its limit the second point only takes what the first one has not. */
  CHECK_DONE(fuge_set_load(solver, 1.8));
  CHECK_DONE(fuge_set_limits(solver, limit, NULL));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_gradients(solver, first, NULL, NULL, NULL, NULL, NULL, NULL, NULL, by_limit, NULL, NULL, NULL));
  CHECK_VALUES(by_limit, EXACT, 0.0, -1.0, 0.0);
  free_both(&solver, &op);
}

/* The third point just touches. */
static void test_kink(void) {
  const double first[N] = {1.0, 0.0, 0.0}, gap[N] = {0.0, 1.0, 1.5};
  double by_gap[N];
  int at_kink[N] = {-1, -1, -1};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_springs(&op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(get_gradients(solver, first, NULL, NULL, by_gap, NULL), FUGE_WARN_KINK);
  check_message(solver, "first point 2,");
  CHECK_STATUS(fuge_get_gradients(solver, first, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, at_kink),
               FUGE_WARN_KINK);
  CHECK_INT(at_kink[0] + at_kink[1], 0);
  CHECK_INT(at_kink[2], 1);
  free_both(&solver, &op);
}

static void test_refused_weights(void) {
  const double weights[N] = {1.0, NAN, 0.0};
  double by_gap[N], by_load = SENTINEL;
  fuge_operator *op = NULL;
  fuge_solver *solver = new_springs(&op);
  fill(by_gap, N);
  CHECK_STATUS(get_gradients(NULL, NULL, NULL, NULL, by_gap, &by_load), FUGE_ERR_POINTER);
  CHECK_STATUS(get_gradients(solver, NULL, NULL, NULL, by_gap, &by_load), FUGE_ERR_CALL_ORDER);
  check_message(solver, "call fuge_solve");
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(get_gradients(solver, weights, NULL, NULL, by_gap, &by_load), FUGE_ERR_NOT_FINITE);
  check_message(solver, "force_weight(1) = NaN");
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_STATUS(get_gradients(solver, NULL, NULL, NULL, by_gap, &by_load), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(by_gap, N);
  CHECK_UNTOUCHED(&by_load, 1);
  free_both(&solver, &op);
}

/* The gaps for forces, before any other is set; the forces come back. */
static void test_wanted_pressure(void) {
  const double wanted[N] = {1.5, 0.25, 0.0};
  double gap[N], reached[N], resultant, force[N];
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(ALPHA, N, NULL, &op);
  CHECK_DONE(fuge_gap_for_pressure(solver, wanted, 0.5, gap, reached, &resultant));
  CHECK_VALUES(gap, EXACT, 0.0, 1.0, 2.0);
  CHECK_VALUES(reached, 0.0, 1.5, 0.25, 0.0);
  CHECK_NEAR(resultant, 1.75, EXACT);
  CHECK_DONE(fuge_gap_for_pressure(solver, wanted, 0.5, gap, NULL, NULL));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, resultant));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, EXACT, 1.5, 0.25, 0.0);
  /* The solution is still there. */
  CHECK_STATUS(fuge_gap_for_pressure(solver, (double[N]){1.5, -0.25, 0.0}, 0.0, gap, reached, NULL),
               FUGE_WARN_UNREACHABLE);
  check_message(solver, "as point 1 with -0.25");
  CHECK_VALUES(reached, 0.0, 1.5, 0.0, 0.0);
  CHECK_DONE(fuge_get_force(solver, force));
  free_both(&solver, &op);
}

static void test_refused_wishes(void) {
  const double wanted[N] = {1.0, 1.0, NAN};
  double gap[N];
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(ALPHA, N, NULL, &op);
  fill(gap, N);
  CHECK_STATUS(fuge_gap_for_pressure(NULL, wanted, 0.0, gap, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_gap_for_pressure(solver, NULL, 0.0, gap, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_gap_for_pressure(solver, wanted, 0.0, NULL, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_gap_for_pressure(solver, wanted, 0.0, gap, NULL, NULL), FUGE_ERR_NOT_FINITE);
  check_message(solver, "force(2) = NaN");
  CHECK_STATUS(fuge_gap_for_pressure(solver, ALPHA, -1.0, gap, NULL, NULL), FUGE_ERR_GAP);
  CHECK_UNTOUCHED(gap, N);
  free_both(&solver, &op);
}

int main(void) {
  test_gradients();
  test_all_gradients();
  test_kink();
  test_refused_weights();
  test_wanted_pressure();
  test_refused_wishes();
  return check_summary();
}
