/* Section "solver" of fuge_core.h: life cycle, data, call order, failures of a solve. */
#include <limits.h>
#include "table1.h"

static void check_solved(fuge_solver *solver) {
  double force[2], gap[2], approach;
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  check_table1(force, gap, approach);
}

/* No result of any kind, and nothing written. */
static void check_no_answer(const fuge_solver *solver) {
  double values[2];
  fill(values, 2);
  CHECK_STATUS(fuge_get_force(solver, values), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_get_gap(solver, values), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_get_motion(solver, values), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_get_resultant(solver, values), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(values, 2);
}

static void check_message(const fuge_solver *solver, const char *part) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, part);
}

static void test_life_cycle(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  check_solved(solver);
  fuge_solver_free(&solver);
  CHECK(solver == NULL);
  fuge_solver_free(&solver);
  CHECK(solver == NULL);
  fuge_solver_free(NULL);
  fuge_operator_free(&op);
}

static void test_new_null_pointers(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  CHECK_STATUS(fuge_solver_new(NULL, NULL, &solver, NULL, 0), FUGE_ERR_POINTER);
  CHECK(solver == NULL);
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_STATUS(fuge_solver_new(op, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  fuge_operator_free(&op);
}

static void test_null_solver(void) {
  CHECK_STATUS(fuge_set_gap(NULL, TABLE1_GAP, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_load(NULL, 1.0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve(NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_reset(NULL), FUGE_ERR_POINTER);
}

/* ---- options ------------------------------------------------------------ */

static void check_option(const fuge_operator *op, const fuge_options *options, int status) {
  char place;
  fuge_solver *const before = (fuge_solver *)(void *)&place;
  fuge_solver *solver = before;
  CHECK_STATUS(fuge_solver_new(op, options, &solver, NULL, 0), status);
  if (status < 0) {
    CHECK(solver == before);
  } else {
    fuge_solver_free(&solver);
  }
}

static void check_int_option(const fuge_operator *op, size_t offset, int value, int status) {
  fuge_options options;
  fuge_default_options(&options);
  memcpy((char *)&options + offset, &value, sizeof value);
  check_option(op, &options, status);
}

static void check_tolerance(const fuge_operator *op, double tolerance, int status) {
  fuge_options options;
  fuge_default_options(&options);
  options.tolerance = tolerance;
  check_option(op, &options, status);
}

static void test_bad_options(void) {
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  check_int_option(op, offsetof(fuge_options, method), 99, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, method), -1, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, method), FUGE_TABLEAU, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, method), FUGE_ITERATIVE, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, method), FUGE_ITERATIVE + 1, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, pivot_rule), FUGE_GREATEST_DECREASE + 1, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, pivot_rule), -1, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, max_iterations), -1, FUGE_ERR_OPTION);
  check_int_option(op, offsetof(fuge_options, max_iterations), 7, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, keep_history), -5, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, threads), 0, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, threads), 64, FUGE_DONE);
  check_int_option(op, offsetof(fuge_options, threads), INT_MIN, FUGE_ERR_OPTION);
  const double bad_tolerances[] = {0.0, -1e-10, 1.0, INFINITY, -INFINITY, NAN};
  for (int k = 0; k < 6; k++) check_tolerance(op, bad_tolerances[k], FUGE_ERR_OPTION);
  check_tolerance(op, 0.5, FUGE_DONE);
  fuge_operator_free(&op);
}

static void test_negative_threads(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  fuge_default_options(&options);
  options.threads = -1;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_MESSAGE(fuge_solver_new(op, &options, &solver, message, sizeof message), FUGE_ERR_OPTION, message,
                "threads = -1 is negative: use 0 for all cores, 1 for one thread, or more");
  CHECK(solver == NULL);
  fuge_operator_free(&op);
}

/* Every rule and engine finds the one answer. */
static void test_every_rule(void) {
  for (int rule = FUGE_PAPER_RULE; rule <= FUGE_GREATEST_DECREASE; rule++) {
    fuge_options options;
    fuge_operator *op = NULL;
    fuge_default_options(&options);
    options.method = FUGE_TABLEAU;
    options.pivot_rule = rule;
    fuge_solver *solver = table1_solver(&options, &op);
    check_solved(solver);
    free_both(&solver, &op);
  }
}

/* The engine of products on a matrix: all that a solver does. */
static void test_iterative(void) {
  const double loads[] = {1.0, 20.0, 0.0, 2.0}, first[] = {1.0, 15.0, 0.0, 2.0};
  double values[2];
  fuge_info info;
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_default_options(&options);
  options.method = FUGE_ITERATIVE;
  fuge_solver *solver = table1_solver(&options, &op);
  check_solved(solver);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK(info.iterations > 0);
  CHECK(info.products > 1);
  CHECK_INT(info.preconditionings, 0);
  CHECK_INT(info.contacts, 1);
  for (int k = 0; k < 4; k++) {
    CHECK_DONE(fuge_set_load(solver, loads[k]));
    check_no_answer(solver);
    CHECK_DONE(fuge_solve(solver));
    CHECK_DONE(fuge_get_force(solver, values));
    CHECK_VALUES(values, 1e-9, first[k], loads[k] - first[k]);
  }
  fill(values, 2);
  CHECK_DONE(fuge_get_derivatives(solver, NULL, &ONE, values, NULL, NULL));
  CHECK_NEAR(values[0] + values[1], 1.0, 1e-12);
  free_both(&solver, &op);
}

static void test_iterative_limit(void) {
  enum { N = 30 };
  double alpha[N * N], gap[N];
  fuge_info info;
  fuge_options options;
  fuge_operator *op = NULL;
  for (int j = 0; j < N; j++) {
    for (int i = 0; i < N; i++) alpha[i + j * N] = 1.0 / (1.0 + 0.3 * abs(i - j));
    gap[j] = 0.02 * (j - 14.0) * (j - 14.0) + 0.1 * fabs(sin(3.0 * j));
  }
  fuge_default_options(&options);
  options.method = FUGE_ITERATIVE;
  options.max_iterations = 1;
  fuge_solver *solver = new_solver(alpha, N, &options, &op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 1.0));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_ITERATION_LIMIT);
  check_message(solver, "max_iterations");
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.iterations, 1);
  free_both(&solver, &op);
}

/* The caller may throw the options away. */
static void test_options_are_copied(void) {
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_default_options(&options);
  fuge_solver *solver = table1_solver(&options, &op);
  memset(&options, 0xff, sizeof options);
  check_solved(solver);
  free_both(&solver, &op);
}

/* ---- call order --------------------------------------------------------- */

static void test_solve_needs_data(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALL_ORDER);
  check_message(solver, "fuge_set_gap");
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALL_ORDER);
  check_message(solver, "fuge_set_load");
  check_no_answer(solver);
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_load_before_gap(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALL_ORDER);
  check_message(solver, "fuge_set_gap");
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_results_end_with_new_data(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  check_no_answer(solver);
  check_message(solver, "fuge_solve");
  check_solved(solver);
  CHECK_DONE(fuge_set_load(solver, 1.0));
  check_no_answer(solver);
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  check_no_answer(solver);
  free_both(&solver, &op);
}

static void test_reset(void) {
  double residual = SENTINEL;
  int available = -1;
  fuge_info info;
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_default_options(&options);
  options.keep_history = 1;
  fuge_solver *solver = table1_solver(&options, &op);
  check_solved(solver);
  CHECK_DONE(fuge_reset(solver));
  check_no_answer(solver);
  info.residual = residual;
  CHECK_STATUS(fuge_get_info(solver, &info), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(&info.residual, 1);
  CHECK_STATUS(fuge_get_history(solver, 0, 0, NULL, NULL, &available), FUGE_ERR_CALL_ORDER);
  CHECK_INT(available, -1);
  /* The data have stayed. */
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_reset_of_new_solver(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_DONE(fuge_reset(solver));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALL_ORDER);
  free_both(&solver, &op);
}

static void test_two_solvers_on_one_operator(void) {
  double force[2];
  fuge_operator *op = NULL;
  fuge_solver *one = table1_solver(NULL, &op), *other = NULL;
  CHECK_DONE(fuge_solver_new(op, NULL, &other, NULL, 0));
  CHECK_DONE(fuge_set_gap(other, TABLE1_GAP, NULL));
  CHECK_DONE(fuge_set_load(other, 20.0));
  CHECK_DONE(fuge_solve(other));
  check_no_answer(one);
  check_solved(one);
  CHECK_DONE(fuge_get_force(other, force));
  CHECK_NEAR(force[0], 15.0, 20.0 * EXACT);
  fuge_solver_free(&other);
  check_solved(one);
  free_both(&one, &op);
}

/* ---- data that are refused ---------------------------------------------- */

static void check_load_refused(fuge_solver *solver, double load, int status, const char *part) {
  CHECK_STATUS(fuge_set_load(solver, load), status);
  check_message(solver, part);
}

/* What is refused changes nothing: the answer of before is still there. */
static void test_refused_data(void) {
  const double nan_gap[2] = {0.0, NAN}, infinite_gap[2] = {INFINITY, 1.0};
  double force[2];
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  check_solved(solver);
  check_load_refused(solver, -3.0, FUGE_ERR_NO_EQUILIBRIUM, "-3.0");
  check_load_refused(solver, NAN, FUGE_ERR_NOT_FINITE, "load");
  check_load_refused(solver, INFINITY, FUGE_ERR_NOT_FINITE, "load");
  CHECK_STATUS(fuge_set_gap(solver, nan_gap, NULL), FUGE_ERR_NOT_FINITE);
  check_message(solver, "gap(1)");
  CHECK_STATUS(fuge_set_gap(solver, infinite_gap, NULL), FUGE_ERR_NOT_FINITE);
  check_message(solver, "gap(0)");
  CHECK_STATUS(fuge_set_gap(solver, NULL, NULL), FUGE_ERR_POINTER);
  check_message(solver, "gap is NULL");
  CHECK_DONE(fuge_get_force(solver, force));
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_gap_is_copied(void) {
  double gap[2] = {0.0, 1.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  gap[0] = gap[1] = NAN;
  check_solved(solver);
  free_both(&solver, &op);
}

/* ---- solves that fail or warn ------------------------------------------- */

static void check_solve_fails(fuge_solver *solver, int status, const char *part) {
  fuge_info info;
  memset(&info, 0xff, sizeof info);
  CHECK_STATUS(fuge_solve(solver), status);
  check_message(solver, part);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.status, status);
  check_no_answer(solver);
}

static void test_iteration_limit(void) {
  fuge_info info;
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_default_options(&options);
  options.method = FUGE_TABLEAU;
  options.max_iterations = 2;
  fuge_solver *solver = table1_solver(&options, &op);
  check_solve_fails(solver, FUGE_ERR_ITERATION_LIMIT, "max_iterations");
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.iterations, 2);
  free_both(&solver, &op);

  options.max_iterations = 3;
  solver = table1_solver(&options, &op);
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_not_definite(void) {
  const double alpha[4] = {1.0, 2.0, 2.0, 1.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(alpha, 2, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  check_solve_fails(solver, FUGE_ERR_NOT_DEFINITE, "points 0 and 1");
  free_both(&solver, &op);
}

/* An answer of before is gone, the data stay and can be mended. */
static void test_overflow_after_answer(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  check_solved(solver);
  CHECK_DONE(fuge_set_load(solver, 1.7e308));
  check_solve_fails(solver, FUGE_ERR_OVERFLOW, "units");
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  check_solved(solver);
  free_both(&solver, &op);
}

/* A tilt about a point 2^36 cells away, and stiff bodies: the last digit of R q, to which the
 * equations hold, is a hundredth of the displacements by the forces. */
static void test_ill_conditioned(void) {
  enum { N = 4 };
  const double force[N] = {3, 1, 4, 2}, far = 68719476736.0, compliance = 1.0 / 1024.0;
  double alpha[N * N] = {0}, gap[N], modes[2 * N], resultant[2] = {10, 0}, found[N];
  fuge_info info;
  fuge_operator *op = NULL;
  for (int k = 0; k < N; k++) {
    alpha[k + k * N] = compliance;
    modes[k] = 1.0;
    modes[N + k] = k - far;
    gap[k] = 10.0 + 3.0 * k - compliance * force[k];
    resultant[1] += k * force[k];
  }
  resultant[1] -= 10.0 * far;
  fuge_solver *solver = new_solver(alpha, N, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_modes(solver, 2, modes, resultant));
  CHECK_STATUS(fuge_solve(solver), FUGE_WARN_ILL_CONDITIONED);
  check_message(solver, "the forces may be wrong by ");
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.status, FUGE_WARN_ILL_CONDITIONED);
  CHECK(info.residual <= 1e-10);
  CHECK(info.force_error > 1e-3 && info.force_error < 0.1);
  CHECK_DONE(fuge_get_force(solver, found));
  for (int k = 0; k < N; k++) CHECK_NEAR(found[k], force[k], 3.0 * 4.0 * info.force_error);
  /* The same tilt about a point nearby is harmless. */
  resultant[1] += 10.0 * far;
  for (int k = 0; k < N; k++) modes[N + k] = k;
  CHECK_DONE(fuge_set_modes(solver, 2, modes, resultant));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK(info.force_error > 0.0 && info.force_error < 1e-10);
  free_both(&solver, &op);
}

int main(void) {
  test_life_cycle();
  test_new_null_pointers();
  test_null_solver();
  test_bad_options();
  test_negative_threads();
  test_every_rule();
  test_iterative();
  test_iterative_limit();
  test_options_are_copied();
  test_solve_needs_data();
  test_load_before_gap();
  test_results_end_with_new_data();
  test_reset();
  test_reset_of_new_solver();
  test_two_solvers_on_one_operator();
  test_refused_data();
  test_gap_is_copied();
  test_iteration_limit();
  test_not_definite();
  test_overflow_after_answer();
  test_ill_conditioned();
  return check_summary();
}
