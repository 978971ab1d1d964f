/* Section "operators" of fuge.h: callback operators. */
#include "table1.h"

enum { N = 3 };

/* What the callbacks see as user. */
typedef struct scene {
  int calls;
  int returns;   /* what to return */
  int spoil;     /* point, from 1, that gets `odd`; 0: none */
  int forget;    /* point that is not written */
  double odd;
  int overwrite; /* write to f */
} scene;

static int multiply(int n, const double *f, double *u, void *user) {
  scene *s = user;
  s->calls++;
  CHECK_INT(n, N);
  for (int k = 0; k < n; k++)
    if (k + 1 != s->forget) u[k] = 4.0 * f[k];
  if (s->spoil > 0) u[s->spoil - 1] = s->odd;
  if (s->overwrite)
    for (int k = 0; k < n; k++) ((double *)f)[k] = 1e9;
  return s->returns;
}

/* User is allowed to be NULL. */
static int multiply_without_user(int n, const double *f, double *u, void *user) {
  CHECK(user == NULL);
  for (int k = 0; k < n; k++) u[k] = 4.0 * f[k];
  return 0;
}

static const double GAP[N] = {0.5, 1.0, 2.0};

/* A solver with load 0: the certificate makes one product. */
static fuge_solver *callback_solver(fuge_apply apply, void *user, fuge_operator **op) {
  fuge_solver *solver = NULL;
  CHECK_STATUS(fuge_operator_callback(N, apply, user, op), FUGE_DONE);
  CHECK_STATUS(fuge_solver_new(*op, NULL, &solver), FUGE_DONE);
  CHECK_STATUS(fuge_set_gap(solver, GAP, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_set_load(solver, 0.0), FUGE_DONE);
  return solver;
}

static void check_solved(fuge_solver *solver) {
  double force[N], gap[N];
  fuge_info info;
  CHECK_STATUS(fuge_solve(solver), FUGE_DONE);
  CHECK_STATUS(fuge_get_info(solver, &info), FUGE_DONE);
  CHECK_INT(info.products, 1);
  CHECK_INT(info.filters, 0);
  CHECK_NEAR(info.residual, 0.0, 0.0);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_DONE);
  CHECK_STATUS(fuge_get_gap(solver, gap), FUGE_DONE);
  for (int k = 0; k < N; k++) {
    CHECK_NEAR(force[k], 0.0, 0.0);
    CHECK_NEAR(gap[k], GAP[k] - 0.5, 0.0);
  }
}

static void test_product(void) {
  scene s = {0};
  fuge_operator *op = NULL;
  fuge_solver *solver = callback_solver(multiply, &s, &op);
  check_solved(solver);
  CHECK_INT(s.calls, 1);
  free_both(&solver, &op);
  CHECK(op == NULL);
  solver = callback_solver(multiply_without_user, NULL, &op);
  check_solved(solver);
  free_both(&solver, &op);
}

/* Nor does it matter what the callback does to its f. */
static void test_overwritten_forces(void) {
  scene s = {0};
  fuge_operator *op = NULL;
  s.overwrite = 1;
  fuge_solver *solver = callback_solver(multiply, &s, &op);
  check_solved(solver);
  free_both(&solver, &op);
}

/* The solve fails with that message, gives no answer, and works when mended. */
static void check_fails(scene s, const char *part) {
  const scene good = {0};
  char message[256] = "";
  double force[N];
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = callback_solver(multiply, &s, &op);
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALLBACK);
  CHECK_STATUS(fuge_last_message(solver, message, sizeof message), FUGE_DONE);
  CHECK_CONTAINS(message, part);
  CHECK_STATUS(fuge_get_info(solver, &info), FUGE_DONE);
  CHECK_INT(info.status, FUGE_ERR_CALLBACK);
  CHECK_INT(info.products, 1);
  fill(force, N);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(force, N);
  s = good;
  check_solved(solver);
  free_both(&solver, &op);
}

static void test_failures(void) {
  const scene seven = {.returns = 7}, minus_one = {.returns = -1}, minus_hundred = {.returns = -100};
  const scene nan = {.spoil = 2, .odd = NAN}, infinite = {.spoil = 3, .odd = INFINITY};
  const scene forgotten = {.forget = 2};
  check_fails(seven, "product 1: the operator returned status 7");
  check_fails(minus_one, "product 1: a callback failed");
  check_fails(minus_hundred, "product 1: a callback failed");
  check_fails(nan, "product 1: displacement(2) = NaN");
  check_fails(infinite, "product 1: displacement(3) = Inf");
  check_fails(forgotten, "product 1: displacement(2) = NaN");
}

static void check_refused(int n, fuge_apply apply, int status) {
  char place;
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  fuge_operator *op = before;
  CHECK_STATUS(fuge_operator_callback(n, apply, NULL, &op), status);
  CHECK(op == before);
}

static void test_refusals(void) {
  check_refused(0, multiply, FUGE_ERR_SIZE);
  check_refused(-3, multiply, FUGE_ERR_SIZE);
  check_refused(N, NULL, FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_callback(N, multiply, NULL, NULL), FUGE_ERR_POINTER);
}

static void check_diagonal(fuge_operator *op, double second, int status) {
  const double diagonal[N] = {1.0, second, 3.0};
  CHECK_STATUS(fuge_operator_set_diagonal(op, diagonal), status);
}

static void test_filter_refusals(void) {
  const double diagonal[2] = {1.0, 1.0};
  scene s = {0};
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_callback(N, multiply, &s, &op), FUGE_DONE);
  CHECK_STATUS(fuge_operator_set_filter(NULL, multiply), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_set_filter(op, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_set_filter(op, multiply), FUGE_DONE);
  CHECK_STATUS(fuge_operator_set_diagonal(NULL, diagonal), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_set_diagonal(op, NULL), FUGE_ERR_POINTER);
  check_diagonal(op, NAN, FUGE_ERR_NOT_FINITE);
  check_diagonal(op, INFINITY, FUGE_ERR_NOT_FINITE);
  check_diagonal(op, 0.0, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, -1.0, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, 1e-310, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, 2.0, FUGE_DONE);
  check_diagonal(op, 3.0, FUGE_DONE);
  CHECK_INT(s.calls, 0);
  fuge_operator_free(&op);

  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
  CHECK_STATUS(fuge_operator_set_filter(op, multiply), FUGE_ERR_UNSUPPORTED);
  CHECK_STATUS(fuge_operator_set_diagonal(op, diagonal), FUGE_ERR_UNSUPPORTED);
  fuge_operator_free(&op);
}

int main(void) {
  test_product();
  test_overwritten_forces();
  test_failures();
  test_refusals();
  test_filter_refusals();
  return check_summary();
}
