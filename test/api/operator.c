/* Section "operators" of fuge.h. */
#include "table1.h"

static void test_life_cycle(void) {
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
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
  CHECK_STATUS(fuge_operator_dense(2, alpha, 3, &op), FUGE_DONE);
  CHECK_STATUS(fuge_solver_new(op, NULL, &solver), FUGE_DONE);
  CHECK_STATUS(fuge_set_gap(solver, TABLE1_GAP, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_set_load(solver, TABLE1_LOAD), FUGE_DONE);
  CHECK_STATUS(fuge_solve(solver), FUGE_DONE);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_DONE);
  CHECK_STATUS(fuge_get_gap(solver, gap), FUGE_DONE);
  CHECK_STATUS(fuge_get_rigid(solver, &approach), FUGE_DONE);
  check_table1(force, gap, approach);
  free_both(&solver, &op);
}

/* A refusal leaves *op as it was. */
static void check_refused(int n, const double *alpha, int lda, int status) {
  char place;
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  fuge_operator *op = before;
  CHECK_STATUS(fuge_operator_dense(n, alpha, lda, &op), status);
  CHECK(op == before);
}

static void test_refusals(void) {
  const double not_finite[4] = {0.2, 0.1, 0.1, NAN};
  const double not_symmetric[4] = {0.2, 0.1, 0.15, 0.2};
  check_refused(0, TABLE1_ALPHA, 2, FUGE_ERR_SIZE);
  check_refused(-1, TABLE1_ALPHA, 2, FUGE_ERR_SIZE);
  check_refused(2, TABLE1_ALPHA, 1, FUGE_ERR_SIZE);
  check_refused(2, NULL, 2, FUGE_ERR_POINTER);
  check_refused(2, not_finite, 2, FUGE_ERR_NOT_FINITE);
  check_refused(2, not_symmetric, 2, FUGE_ERR_NOT_SYMMETRIC);
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, NULL), FUGE_ERR_POINTER);
}

/* Up to 1e-10 of the range of the coefficients, here 0.1, is rounding. */
static void test_asymmetry_limit(void) {
  const double below[4] = {0.2, 0.1, 0.1 + 0.9e-11, 0.2};
  const double above[4] = {0.2, 0.1, 0.1 + 1.1e-11, 0.2};
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_dense(2, below, 2, &op), FUGE_DONE);
  fuge_operator_free(&op);
  check_refused(2, above, 2, FUGE_ERR_NOT_SYMMETRIC);
}

int main(void) {
  test_life_cycle();
  test_padding();
  test_refusals();
  test_asymmetry_limit();
  return check_summary();
}
