/* Section "operators" of fuge.h. */
#include <limits.h>
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

static void test_halfplane_life_cycle(void) {
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++)
    for (int boundary = FUGE_FREE; boundary <= FUGE_PERIODIC; boundary++) {
      char message[256] = "not written";
      fuge_operator *op = NULL;
      fuge_solver *solver = NULL;
      CHECK_STATUS(fuge_operator_halfplane(100, 0.25, 3.0, element, boundary, &op), FUGE_DONE);
      CHECK(op != NULL);
      CHECK_STATUS(fuge_solver_new(op, NULL, &solver), FUGE_DONE);
      CHECK_STATUS(fuge_check_operator_halfplane(100, 0.25, 3.0, element, boundary, message, sizeof message), FUGE_DONE);
      CHECK_STRING(message, "");
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

/* Function and check agree, *op stays as it was, the message says what. */
static void test_halfplane_refusals(void) {
  char place, message[256];
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  for (size_t k = 0; k < sizeof BAD_HALFPLANE / sizeof BAD_HALFPLANE[0]; k++) {
    const bad_halfplane *bad = &BAD_HALFPLANE[k];
    fuge_operator *op = before;
    CHECK_STATUS(fuge_operator_halfplane(bad->n, bad->spacing, bad->e_star, bad->element, bad->boundary, &op),
                 bad->status);
    CHECK(op == before);
    strcpy(message, "not written");
    CHECK_STATUS(fuge_check_operator_halfplane(bad->n, bad->spacing, bad->e_star, bad->element, bad->boundary,
                                               message, sizeof message), bad->status);
    CHECK_CONTAINS(message, bad->part);
  }
  CHECK_STATUS(fuge_operator_halfplane(9, 0.25, 3, FUGE_MEAN, FUGE_FREE, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_check_operator_halfplane(0, 0.25, 3, FUGE_MEAN, FUGE_FREE, NULL, 9), FUGE_ERR_SIZE);
}

int main(void) {
  test_life_cycle();
  test_padding();
  test_refusals();
  test_asymmetry_limit();
  test_halfplane_life_cycle();
  test_halfplane_refusals();
  return check_summary();
}
