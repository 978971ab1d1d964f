/* Section "operators" of fuge_core.h. */
#include <limits.h>
#include "table1.h"

static void test_life_cycle(void) {
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK(op != NULL);
  fuge_operator_free(&op);
  CHECK(op == NULL);
  fuge_operator_free(&op);
  CHECK(op == NULL);
  fuge_operator_free(NULL);
}

/* Rows beyond n are never read, neither here nor in a solve. */
static void test_padding(void) {
  const double alpha[6] = {0.2, 0.1, NAN, 0.1, 0.2, NAN};
  double force[2], gap[2], approach;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  CHECK_DONE(fuge_operator_dense(2, alpha, 3, &op, NULL, 0));
  CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, TABLE1_LOAD));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  check_table1(force, gap, approach);
  free_both(&solver, &op);
}

/* A refusal leaves *op as it was. */
static void check_refused(int n, const double *alpha, int lda, int status, const char *part) {
  char place, message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  fuge_operator *op = before;
  CHECK_STATUS(fuge_operator_dense(n, alpha, lda, &op, message, sizeof message), status);
  CHECK(op == before);
  CHECK_CONTAINS(message, part);
}

static void test_refusals(void) {
  const double not_finite[4] = {0.2, 0.1, 0.1, NAN};
  const double not_symmetric[4] = {0.2, 0.1, 0.15, 0.2};
  check_refused(0, TABLE1_ALPHA, 2, FUGE_ERR_SIZE, "n = 0");
  check_refused(-1, TABLE1_ALPHA, 2, FUGE_ERR_SIZE, "n = -1");
  check_refused(2, TABLE1_ALPHA, 1, FUGE_ERR_SIZE, "lda = 1");
  check_refused(2, NULL, 2, FUGE_ERR_POINTER, "alpha is NULL");
  check_refused(2, not_finite, 2, FUGE_ERR_NOT_FINITE, "alpha(1,1) = NaN");
  check_refused(2, not_symmetric, 2, FUGE_ERR_NOT_SYMMETRIC, "alpha(1,0) and alpha(0,1)");
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, NULL, NULL, 0), FUGE_ERR_POINTER);
}

/* Up to 1e-10 of the range of the coefficients, here 0.1, is rounding. */
static void test_asymmetry_limit(void) {
  const double below[4] = {0.2, 0.1, 0.1 + 0.9e-11, 0.2};
  const double above[4] = {0.2, 0.1, 0.1 + 1.1e-11, 0.2};
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, below, 2, &op, NULL, 0));
  fuge_operator_free(&op);
  check_refused(2, above, 2, FUGE_ERR_NOT_SYMMETRIC, "differ");
}

static void test_halfplane_life_cycle(void) {
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++)
    for (int boundary = FUGE_FREE; boundary <= FUGE_PERIODIC; boundary++) {
      char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
      fuge_operator *op = NULL;
      fuge_solver *solver = NULL;
      CHECK_DONE(fuge_operator_halfplane(100, 0.25, 3.0, element, boundary, &op, message, sizeof message));
      CHECK_STRING(message, "");
      CHECK(op != NULL);
      CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
      free_both(&solver, &op);
      CHECK(op == NULL);
    }
}

typedef struct bad_halfplane {
  int n;
  double spacing, e_star;
  int element, boundary, status;
  const char *part;
} bad_halfplane;

static const bad_halfplane BAD_HALFPLANE[] = {
  {0, 0.25, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_SIZE, "n = 0"},
  {-7, 0.25, 3, FUGE_MEAN, FUGE_PERIODIC, FUGE_ERR_SIZE, "n = -7"},
  {INT_MAX, 0.25, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_MEMORY, "n = 2147483647"},
  {9, 0.0, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_WIDTH, "spacing = 0"},
  {9, -0.25, 3, FUGE_MEAN, FUGE_PERIODIC, FUGE_ERR_WIDTH, "spacing = -0.25"},
  {9, NAN, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_NOT_FINITE, "spacing = NaN"},
  {9, 0.25, INFINITY, FUGE_MEAN, FUGE_FREE, FUGE_ERR_NOT_FINITE, "e_star = Inf"},
  {9, 0.25, 0.0, FUGE_MEAN, FUGE_FREE, FUGE_ERR_MODULUS, "e_star = 0"},
  {9, 1e-200, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_OVERFLOW, "spacing"},
  {9, 0.25, 1e200, FUGE_MEAN, FUGE_FREE, FUGE_ERR_OVERFLOW, "e_star"},
  {9, 0.25, 3, FUGE_HAT + 1, FUGE_FREE, FUGE_ERR_ELEMENT, "element = 3"},
  {9, 0.25, 3, FUGE_MEAN, FUGE_PERIODIC + 1, FUGE_ERR_OPTION, "boundary = 2"}
};

/* *op stays as it was, the message says what is wrong. */
static void test_halfplane_refusals(void) {
  char place, message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  for (size_t k = 0; k < sizeof BAD_HALFPLANE / sizeof BAD_HALFPLANE[0]; k++) {
    const bad_halfplane *bad = &BAD_HALFPLANE[k];
    fuge_operator *op = before;
    strcpy(message, "not written");
    CHECK_STATUS(fuge_operator_halfplane(bad->n, bad->spacing, bad->e_star, bad->element, bad->boundary, &op, message,
                                         sizeof message), bad->status);
    CHECK(op == before);
    CHECK_CONTAINS(message, bad->part);
  }
  CHECK_STATUS(fuge_operator_halfplane(9, 0.25, 3, FUGE_MEAN, FUGE_FREE, NULL, NULL, 0), FUGE_ERR_POINTER);
}

/* ---- a half-plane from end to end --------------------------------------- */

enum { CELLS = 150 };
static const double SPACING = 0.25, E_STAR = 3.0, LOAD = 20.0;

static void make_gap(double *x, double *gap) {
  for (int k = 0; k < CELLS; k++) {
    x[k] = SPACING * (k - 0.4 * CELLS);
    gap[k] = 0.02 * x[k] * x[k] + 0.05 * cos(7.0 * x[k]);
  }
}

static fuge_solver *halfplane_solver(int element, int boundary, int method, fuge_operator **op) {
  double x[CELLS], gap[CELLS];
  fuge_options options;
  fuge_solver *solver = NULL;
  fuge_default_options(&options);
  options.method = method;
  make_gap(x, gap);
  CHECK_DONE(fuge_operator_halfplane(CELLS, SPACING, E_STAR, element, boundary, op, NULL, 0));
  CHECK_DONE(fuge_solver_new(*op, &options, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, LOAD));
  return solver;
}

/* Forces, gaps and approach of the matrix. */
static void check_free_answer(int element, const double *force, const double *gap, double approach) {
  static double alpha[CELLS * CELLS];
  double x[CELLS], width[CELLS], initial[CELLS], right_force[CELLS], right_gap[CELLS], right_approach;
  make_gap(x, initial);
  for (int k = 0; k < CELLS; k++) width[k] = SPACING;
  CHECK_DONE(fuge_halfplane_matrix(CELLS, x, width, E_STAR, element, 0, alpha, CELLS, NULL, 0));
  CHECK_DONE(fuge_solve_dense(CELLS, alpha, CELLS, initial, LOAD, right_force, right_gap, &right_approach, NULL, 0));
  for (int k = 0; k < CELLS; k++) {
    CHECK_NEAR(force[k], right_force[k], 1e-7 * LOAD);
    CHECK_NEAR(gap[k], right_gap[k], 1e-8 * LOAD);
  }
  CHECK_NEAR(approach, right_approach, 1e-8 * LOAD);
}

static void check_halfplane(int element, int boundary, int method) {
  double force[CELLS], gap[CELLS], approach, resultant, change[CELLS], gap_change[CELLS], rate, sum = 0.0;
  int contacts = 0;
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = halfplane_solver(element, boundary, method, &op);
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  CHECK_DONE(fuge_get_resultant(solver, &resultant));
  for (int k = 0; k < CELLS; k++) {
    CHECK(force[k] >= 0.0 && gap[k] >= 0.0);
    CHECK_NEAR(force[k] * gap[k], 0.0, 0.0);
    contacts += force[k] > 0.0;
    sum += force[k];
  }
  CHECK_NEAR(sum, LOAD, 1e-12 * LOAD);
  CHECK_NEAR(resultant, sum, 1e-13 * LOAD);
  CHECK_INT(info.status, FUGE_DONE);
  CHECK_INT(info.contacts, contacts);
  CHECK(contacts > 3 && contacts < CELLS);
  CHECK(info.products > 1 && info.products < 60);
  CHECK(info.preconditionings > 1);
  CHECK(info.residual <= 1e-10);
  if (boundary == FUGE_FREE) check_free_answer(element, force, gap, approach);
  /* More load is carried where there is contact, and closes the gaps beside it. */
  CHECK_DONE(fuge_get_derivatives(solver, NULL, &ONE, change, gap_change, &rate));
  sum = 0.0;
  for (int k = 0; k < CELLS; k++) {
    CHECK(force[k] > 0.0 ? change[k] > 0.0 && gap_change[k] == 0.0 : change[k] == 0.0 && gap_change[k] < 0.0);
    sum += change[k];
  }
  CHECK_NEAR(sum, 1.0, 1e-12);
  CHECK(rate > 0.0 || boundary == FUGE_FREE);
  free_both(&solver, &op);
}

static void test_halfplane_solves(void) {
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++)
    for (int boundary = FUGE_FREE; boundary <= FUGE_PERIODIC; boundary++) {
      check_halfplane(element, boundary, FUGE_AUTO);
      check_halfplane(element, boundary, FUGE_ITERATIVE);
    }
}

/* Nothing but the engine of products works without coefficients. */
static void test_halfplane_unsupported(void) {
  for (int method = FUGE_TABLEAU; method <= FUGE_ACTIVE_SET; method++) {
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    double force[CELLS], x[CELLS], gap[CELLS];
    int entries = -1;
    fuge_operator *op = NULL;
    fuge_solver *solver = halfplane_solver(FUGE_MEAN, FUGE_FREE, method, &op);
    CHECK_STATUS(fuge_solve(solver), FUGE_ERR_UNSUPPORTED);
    CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "FUGE_ITERATIVE");
    fill(force, CELLS);
    CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
    CHECK_UNTOUCHED(force, CELLS);
    make_gap(x, gap);
    CHECK_STATUS(fuge_load_path(op, gap, LOAD, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0),
                 FUGE_ERR_UNSUPPORTED);
    CHECK_INT(entries, -1);
    free_both(&solver, &op);
  }
}

static int cancel_third(int iteration, double residual, int contacts, void *user) {
  (void)residual;
  (void)contacts;
  *(int *)user = iteration;
  return iteration == 3;
}

static void test_halfplane_cancelled(void) {
  int last = 0;
  double force[CELLS];
  fuge_operator *op = NULL;
  fuge_solver *solver = halfplane_solver(FUGE_MEAN, FUGE_FREE, FUGE_AUTO, &op);
  CHECK_DONE(fuge_set_progress(solver, cancel_third, &last));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CANCELLED);
  CHECK_INT(last, 3);
  fill(force, CELLS);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(force, CELLS);
  CHECK_DONE(fuge_set_progress(solver, NULL, NULL));
  CHECK_DONE(fuge_solve(solver));
  free_both(&solver, &op);
}

/* ---- products ------------------------------------------------------------ */

/* A product by FFT is that of the matrix, column k of which displaces the cells by a force at k. */
static void check_halfplane_product(int element) {
  static double alpha[CELLS * CELLS];
  double x[CELLS], gap[CELLS], width[CELLS], f[CELLS], u[CELLS], dense[CELLS];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  fuge_operator *op = NULL;
  make_gap(x, gap);
  for (int k = 0; k < CELLS; k++) {
    width[k] = SPACING;
    f[k] = sin(1.0 + k) + (k == 3 ? 5.0 : 0.0);
  }
  CHECK_DONE(fuge_halfplane_matrix(CELLS, x, width, E_STAR, element, 0, alpha, CELLS, NULL, 0));
  CHECK_DONE(fuge_operator_dense(CELLS, alpha, CELLS, &op, NULL, 0));
  CHECK_MESSAGE(fuge_operator_apply(op, CELLS, f, dense, message, sizeof message), FUGE_DONE, message, "");
  fuge_operator_free(&op);
  CHECK_DONE(fuge_operator_halfplane(CELLS, SPACING, E_STAR, element, FUGE_FREE, &op, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, CELLS, f, u, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, CELLS, f, f, NULL, 0));
  fuge_operator_free(&op);
  for (int i = 0; i < CELLS; i++) {
    double sum = 0.0;
    for (int k = 0; k < CELLS; k++) sum += alpha[i + k * CELLS] * (sin(1.0 + k) + (k == 3 ? 5.0 : 0.0));
    CHECK_NEAR(dense[i], sum, 1e-13 * CELLS);
    CHECK_NEAR(u[i], sum, 1e-13 * CELLS);
    CHECK_NEAR(f[i], u[i], 0.0);
  }
}

static void test_products(void) {
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++) check_halfplane_product(element);
}

/* By a period of equal forces nothing is displaced from its mean. */
static void test_periodic_product(void) {
  double f[CELLS], u[CELLS];
  fuge_operator *op = NULL;
  for (int k = 0; k < CELLS; k++) f[k] = 2.0;
  CHECK_DONE(fuge_operator_halfplane(CELLS, SPACING, E_STAR, FUGE_MEAN, FUGE_PERIODIC, &op, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, CELLS, f, u, NULL, 0));
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(u[k], 0.0, 1e-13);
  fuge_operator_free(&op);
}

static void test_product_refusals(void) {
  const double infinite[2] = {1.0, INFINITY}, large[2] = {0.0, -1e308}, f[2] = {1.0, 2.0};
  const double compliant[4] = {1e200, 0.0, 0.0, 1e200}, forces[2] = {1e200, 0.0};
  double u[2];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fill(u, 2);
  CHECK_MESSAGE(fuge_operator_apply(NULL, 2, f, u, message, sizeof message), FUGE_ERR_POINTER, message, "op is NULL");
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_STATUS(fuge_operator_apply(op, 3, f, u, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_STRING(message, "n = 3, but op has 2 points");
  CHECK_STATUS(fuge_operator_apply(op, -1, f, u, NULL, 0), FUGE_ERR_SIZE);
  CHECK_MESSAGE(fuge_operator_apply(op, 2, NULL, u, message, sizeof message), FUGE_ERR_POINTER, message, "f is NULL");
  CHECK_MESSAGE(fuge_operator_apply(op, 2, f, NULL, message, sizeof message), FUGE_ERR_POINTER, message, "u is NULL");
  CHECK_STATUS(fuge_operator_apply(op, 2, infinite, u, message, sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_CONTAINS(message, "f(1) = Inf");
  CHECK_STATUS(fuge_operator_apply(op, 2, large, u, message, sizeof message), FUGE_ERR_OVERFLOW);
  CHECK_CONTAINS(message, "larger unit of force");
  fuge_operator_free(&op);
  CHECK_DONE(fuge_operator_dense(2, compliant, 2, &op, NULL, 0));
  CHECK_STATUS(fuge_operator_apply(op, 2, forces, u, message, sizeof message), FUGE_ERR_OVERFLOW);
  CHECK_CONTAINS(message, "the displacements are too large");
  CHECK_UNTOUCHED(u, 2);
  fuge_operator_free(&op);
}

int main(void) {
  test_life_cycle();
  test_padding();
  test_refusals();
  test_asymmetry_limit();
  test_halfplane_life_cycle();
  test_halfplane_refusals();
  test_halfplane_solves();
  test_halfplane_unsupported();
  test_halfplane_cancelled();
  test_products();
  test_periodic_product();
  test_product_refusals();
  return check_summary();
}
