/* Laws of points in fuge_core.h: compliances, limits of forces, springs on motions, states, energy. */
#include "table1.h"

enum { N = 2 };
/* Rigid bodies, so that all that gives way are the springs. */
static const double RIGID[N * N] = {0.0, 0.0, 0.0, 0.0};
static const double ELASTIC[N * N] = {2.0, 1.0, 1.0, 2.0};
static const double FLAT[N] = {0.0, 0.0};
/* Springs of stiffness 1 and 2. */
static const double SPRINGS[N] = {1.0, 0.5};

static fuge_solver *new_flat(const double *alpha, const fuge_options *options, fuge_operator **op) {
  fuge_solver *solver = new_solver(alpha, N, options, op);
  CHECK_DONE(fuge_set_gap(solver, FLAT, NULL));
  return solver;
}

static void check_says(const fuge_solver *solver, int status, int expected, const char *part) {
  char message[300] = "";
  CHECK_STATUS(status, expected);
  CHECK_DONE(fuge_solver_message(solver, message, sizeof message));
  CHECK_CONTAINS(message, part);
}

static void check_numbers(const fuge_solver *solver, double f0, double f1, double c0, double c1, double q) {
  double force[N], gap[N], motion;
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, EXACT, f0, f1);
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_VALUES(gap, EXACT, c0, c1);
  CHECK_DONE(fuge_get_motion(solver, &motion));
  CHECK_NEAR(motion, q, EXACT);
}

/* One more value than points, which the call has to leave alone. */
static void check_states(const fuge_solver *solver, int first, int second) {
  int state[N + 1] = {77, 77, 77};
  CHECK_DONE(fuge_get_states(solver, state));
  CHECK_INT(state[0], first);
  CHECK_INT(state[1], second);
  CHECK_INT(state[2], 77);
}

static double energy_of(const fuge_solver *solver) {
  fuge_info info;
  CHECK_DONE(fuge_get_info(solver, &info));
  return info.energy;
}

/* Two springs share a load of 6; with the second one limited to 3, the first one carries the rest. */
static void test_two_springs(void) {
  const double limit[N] = {HUGE_VAL, 3.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(RIGID, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_set_compliance(solver, SPRINGS));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_AT_LOWER_STOP);
  CHECK_NEAR(energy_of(solver), 6.0, EXACT);
  CHECK_DONE(fuge_set_limits(solver, limit, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 3.0, 3.0, 0.0, -1.5, 3.0);
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_LIMITED_LOWER);
  CHECK_NEAR(energy_of(solver), 0.5 * (9.0 + 4.5), EXACT);
  /* NULL takes them away again. */
  CHECK_DONE(fuge_set_limits(solver, NULL, NULL));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  CHECK_DONE(fuge_set_compliance(solver, NULL));
  CHECK_STATUS(fuge_solve(solver), FUGE_WARN_NOT_UNIQUE);
  free_both(&solver, &op);
}

/* 6 = (1 + 2 + 3) q: a spring on the motion beside them.  It is no point, and goes with the motion. */
static void test_spring_on_motion(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(RIGID, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_set_compliance(solver, SPRINGS));
  CHECK_DONE(fuge_set_motion_stiffness(solver, 0, 3.0));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 1.0, 2.0, 0.0, 0.0, 1.0);
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_AT_LOWER_STOP);
  CHECK_NEAR(energy_of(solver), 3.0, EXACT);
  CHECK_DONE(fuge_set_resultant(solver, 0, -3.0));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 0.0, 0.0, 1.0, 1.0, -1.0);
  check_states(solver, FUGE_OPEN, FUGE_OPEN);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  CHECK_DONE(fuge_set_motion_stiffness(solver, 0, 3.0));
  CHECK_DONE(fuge_set_motion_stiffness(solver, 0, 0.0));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  free_both(&solver, &op);
}

/* The upper stop: tied points, of which the second one yields when pulled by more than 1. */
static void test_pulling_limit(void) {
  const double none[N] = {0.0, 0.0}, limit_upper[N] = {HUGE_VAL, 1.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(RIGID, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, FLAT, none));
  CHECK_DONE(fuge_set_compliance(solver, SPRINGS));
  CHECK_DONE(fuge_set_limits(solver, NULL, limit_upper));
  CHECK_DONE(fuge_set_resultant(solver, 0, -4.0));
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, -3.0, -1.0, 0.0, 2.5, -3.0);
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_LIMITED_UPPER);
  free_both(&solver, &op);
}

/* Hard contact has states too. */
static void test_states_without_law(void) {
  const double gap[N] = {0.0, 5.0}, play[N] = {HUGE_VAL, 0.5};
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  int state[N] = {77, 77};
  CHECK_STATUS(fuge_get_states(solver, state), FUGE_ERR_CALL_ORDER);
  CHECK_INT(state[0], 77);
  CHECK_DONE(fuge_solve(solver));
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_OPEN);
  CHECK_STATUS(fuge_get_states(NULL, state), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_states(solver, NULL), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_set_load(solver, 0.0));
  CHECK_STATUS(fuge_get_states(solver, state), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_solve(solver));
  check_states(solver, FUGE_OPEN, FUGE_OPEN);
  CHECK_NEAR(energy_of(solver), 0.0, 0.0);
  CHECK_DONE(fuge_set_gap(solver, gap, play));
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_DONE(fuge_solve(solver));
  check_states(solver, FUGE_AT_LOWER_STOP, FUGE_AT_UPPER_STOP);
  free_both(&solver, &op);
}

/* A load beyond the sum of the limits, then one at the sum, with which nothing resists the approach. */
static void test_limits_that_do_not_carry(void) {
  const double limit[N] = {1.0, 2.0};
  double force[N];
  int state[N] = {77, 77};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(ELASTIC, NULL, &op);
  CHECK_DONE(fuge_set_limits(solver, limit, NULL));
  CHECK_DONE(fuge_set_load(solver, 3.1));
  check_says(solver, fuge_solve(solver), FUGE_ERR_NO_EQUILIBRIUM, "within their limits");
  CHECK_STATUS(fuge_get_states(solver, state), FUGE_ERR_CALL_ORDER);
  CHECK_INT(state[0], 77);
  CHECK_DONE(fuge_set_load(solver, 3.0));
  CHECK_STATUS(fuge_solve(solver), FUGE_WARN_NOT_UNIQUE);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, EXACT, 1.0, 2.0);
  free_both(&solver, &op);
}

/* What is refused changes nothing; indices count from 0. */
static void test_refused(void) {
  const double negative[N] = {1.0, -0.5}, not_a_number[N] = {1.0, NAN}, infinite[N] = {1.0, HUGE_VAL};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(RIGID, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_set_compliance(solver, SPRINGS));
  CHECK_DONE(fuge_solve(solver));
  check_says(solver, fuge_set_compliance(solver, negative), FUGE_ERR_LAW, "compliance(1) = -0.5");
  check_says(solver, fuge_set_compliance(solver, not_a_number), FUGE_ERR_NOT_FINITE, "compliance(1)");
  check_says(solver, fuge_set_compliance(solver, infinite), FUGE_ERR_NOT_FINITE, "compliance(1)");
  check_says(solver, fuge_set_limits(solver, negative, NULL), FUGE_ERR_LAW, "limit(1) = -0.5");
  check_says(solver, fuge_set_limits(solver, not_a_number, NULL), FUGE_ERR_NOT_FINITE, "limit(1)");
  check_says(solver, fuge_set_limits(solver, NULL, negative), FUGE_ERR_LAW, "limit_upper(1) = -0.5");
  check_says(solver, fuge_set_limits(solver, SPRINGS, not_a_number), FUGE_ERR_NOT_FINITE, "limit_upper(1)");
  check_says(solver, fuge_set_motion_stiffness(solver, 0, -3.0), FUGE_ERR_LAW, "motion_stiffness(0) = -3");
  check_says(solver, fuge_set_motion_stiffness(solver, 0, NAN), FUGE_ERR_NOT_FINITE, "stiffness");
  check_says(solver, fuge_set_motion_stiffness(solver, 1, 1.0), FUGE_ERR_SIZE, "mode = 1");
  check_says(solver, fuge_set_motion_stiffness(solver, -1, 1.0), FUGE_ERR_SIZE, "mode = -1");
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  CHECK_STATUS(fuge_set_compliance(NULL, SPRINGS), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_limits(NULL, SPRINGS, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_motion_stiffness(NULL, 0, 1.0), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_solve(solver));
  check_numbers(solver, 2.0, 4.0, 0.0, 0.0, 2.0);
  free_both(&solver, &op);
}

/* Springs of stiffness 1 and 2 share the load until the second one is at its limit of 3, at a load of 4.5.  The body's
 * own spring of stiffness 3 takes as much as both. */
static void test_path(void) {
  const double limit[N] = {HUGE_VAL, 3.0}, least = 4.5, most = 18.0;
  double parameter[3], motion[3], rate[3];
  int point[3], state[3], contacts[3], entries = -1;
  fuge_operator *op = NULL;
  fuge_solver *solver = new_flat(RIGID, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, 3.0));
  CHECK_DONE(fuge_set_compliance(solver, SPRINGS));
  CHECK_DONE(fuge_set_limits(solver, limit, NULL));
  CHECK_DONE(fuge_follow_path(solver, &least, 3, parameter, motion, rate, point, state, contacts, &entries));
  CHECK_INT(entries, 1);
  CHECK_DONE(fuge_set_motion_stiffness(solver, 0, 3.0));
  CHECK_DONE(fuge_set_resultant(solver, 0, 6.0));
  CHECK_DONE(fuge_follow_path(solver, &most, 3, parameter, motion, rate, point, state, contacts, &entries));
  CHECK_INT(entries, 2);
  CHECK_INT(point[1], 1);
  CHECK_INT(state[1], FUGE_LIMITED_LOWER);
  CHECK_INT(contacts[1], 2);
  CHECK_NEAR(parameter[1], 0.25, EXACT);
  CHECK_NEAR(motion[0], 1.0, EXACT);
  CHECK_NEAR(motion[1], 1.5, EXACT);
  CHECK_NEAR(rate[1], 3.0, EXACT);
  free_both(&solver, &op);
}

int main(void) {
  test_two_springs();
  test_spring_on_motion();
  test_pulling_limit();
  test_states_without_law();
  test_limits_that_do_not_carry();
  test_refused();
  test_path();
  return check_summary();
}
