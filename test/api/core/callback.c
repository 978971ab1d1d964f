/* Section "operators" of fuge_core.h: callback operators. */
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
  CHECK_DONE(fuge_operator_callback(N, apply, user, op, NULL, 0));
  CHECK_DONE(fuge_solver_new(*op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, 0.0));
  return solver;
}

static void check_solved(fuge_solver *solver) {
  double force[N], gap[N];
  fuge_info info;
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.products, 1);
  CHECK_INT(info.preconditionings, 0);
  CHECK_NEAR(info.residual, 0.0, 0.0);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
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
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  double force[N];
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = callback_solver(multiply, &s, &op);
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALLBACK);
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, part);
  CHECK_DONE(fuge_get_info(solver, &info));
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
  check_fails(nan, "product 1: displacement(1) = NaN");
  check_fails(infinite, "product 1: displacement(2) = Inf");
  check_fails(forgotten, "product 1: displacement(1) = NaN");
}

static void check_refused(int n, fuge_apply apply, int status) {
  char place;
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  fuge_operator *op = before;
  CHECK_STATUS(fuge_operator_callback(n, apply, NULL, &op, NULL, 0), status);
  CHECK(op == before);
}

static void test_refusals(void) {
  check_refused(0, multiply, FUGE_ERR_SIZE);
  check_refused(-3, multiply, FUGE_ERR_SIZE);
  check_refused(N, NULL, FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_callback(N, multiply, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
}

static void check_diagonal(fuge_operator *op, double second, int status) {
  const double diagonal[N] = {1.0, second, 3.0};
  CHECK_STATUS(fuge_operator_set_diagonal(op, diagonal, NULL, 0), status);
}

static void test_preconditioner_refusals(void) {
  const double diagonal[2] = {1.0, 1.0};
  scene s = {0};
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_callback(N, multiply, &s, &op, NULL, 0));
  CHECK_STATUS(fuge_operator_set_preconditioner(NULL, multiply, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_set_preconditioner(op, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_operator_set_preconditioner(op, multiply, NULL, 0));
  CHECK_STATUS(fuge_operator_set_diagonal(NULL, diagonal, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_operator_set_diagonal(op, NULL, NULL, 0), FUGE_ERR_POINTER);
  check_diagonal(op, NAN, FUGE_ERR_NOT_FINITE);
  check_diagonal(op, INFINITY, FUGE_ERR_NOT_FINITE);
  check_diagonal(op, 0.0, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, -1.0, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, 1e-310, FUGE_ERR_NOT_DEFINITE);
  check_diagonal(op, 2.0, FUGE_DONE);
  check_diagonal(op, 3.0, FUGE_DONE);
  CHECK_INT(s.calls, 0);
  fuge_operator_free(&op);

  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_STATUS(fuge_operator_set_preconditioner(op, multiply, NULL, 0), FUGE_ERR_UNSUPPORTED);
  CHECK_STATUS(fuge_operator_set_diagonal(op, diagonal, NULL, 0), FUGE_ERR_UNSUPPORTED);
  fuge_operator_free(&op);
}

/* ---- solves with a load ------------------------------------------------- */

enum { M = 24 };
static double bed[M * M], bed_gap[M];

/* A bed of springs with stiff and soft places. */
static void make_bed(void) {
  for (int j = 0; j < M; j++) {
    for (int i = 0; i < M; i++)
      bed[i + j * M] = (i == j ? 1.0 : 0.3 / (1.0 + abs(i - j)))
                       * sqrt((1.0 + 20.0 * (i % 3)) * (1.0 + 20.0 * (j % 3)));
    bed_gap[j] = fabs(sin(5.0 * j)) + 0.02 * (j - 9.0) * (j - 9.0);
  }
}

typedef struct user {
  int products, preconditionings;
  int bad_product, bad_preconditioner; /* which goes wrong; 0: none */
  int returns;                 /* what it returns; 0: it gives NaN at point 5 */
} user;

static int go_wrong(user *u, double *values) {
  if (u->returns == 0) values[4] = NAN;
  return u->returns;
}

static int multiply_bed(int n, const double *f, double *u, void *data) {
  user *counted = data;
  CHECK_INT(n, M);
  for (int i = 0; i < n; i++) {
    u[i] = 0.0;
    for (int j = 0; j < n; j++) u[i] += bed[i + j * M] * f[j];
  }
  return ++counted->products == counted->bad_product ? go_wrong(counted, u) : 0;
}

static int preconditioner_bed(int n, const double *f, double *u, void *data) {
  user *counted = data;
  CHECK_INT(n, M);
  for (int i = 0; i < n; i++) u[i] = f[i] / bed[i + i * M];
  return ++counted->preconditionings == counted->bad_preconditioner ? go_wrong(counted, u) : 0;
}

static int wrong_preconditioner(int n, const double *f, double *u, void *data) {
  (void)data;
  for (int i = 0; i < n; i++) u[i] = -f[i];
  return 0;
}

enum { NO_PRECONDITIONER, DIAGONAL, PRECONDITIONER };

static fuge_solver *bed_solver(user *u, int kind, fuge_operator **op) {
  double diagonal[M];
  fuge_solver *solver = NULL;
  for (int k = 0; k < M; k++) diagonal[k] = bed[k + k * M];
  CHECK_DONE(fuge_operator_callback(M, multiply_bed, u, op, NULL, 0));
  if (kind == DIAGONAL) CHECK_DONE(fuge_operator_set_diagonal(*op, diagonal, NULL, 0));
  if (kind == PRECONDITIONER)
    CHECK_DONE(fuge_operator_set_preconditioner(*op, preconditioner_bed, NULL, 0));
  CHECK_DONE(fuge_solver_new(*op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, bed_gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 2.0));
  return solver;
}

/* The answer of the matrix. */
static void check_bed(fuge_solver *solver, const user *u, int kind) {
  double force[M], gap[M], approach, resultant, right_force[M], right_gap[M], right_approach;
  fuge_info info;
  CHECK_DONE(fuge_solve_dense(M, bed, M, bed_gap, 2.0, right_force, right_gap, &right_approach, NULL, 0));
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.products, u->products);
  CHECK(info.products > 1);
  CHECK(kind == NO_PRECONDITIONER ? info.preconditionings == 0 : info.preconditionings > 0);
  if (kind == PRECONDITIONER) CHECK_INT(info.preconditionings, u->preconditionings);
  CHECK(info.residual <= 1e-10);
  CHECK(info.contacts > 1 && info.contacts < M);
  CHECK(info.iterations > 0);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  CHECK_DONE(fuge_get_resultant(solver, &resultant));
  for (int k = 0; k < M; k++) {
    CHECK_NEAR(force[k], right_force[k], 1e-7);
    CHECK_NEAR(gap[k], right_gap[k], 1e-7);
  }
  CHECK_NEAR(approach, right_approach, 1e-7);
  CHECK_NEAR(resultant, 2.0, 1e-13);
}

static void test_solve(void) {
  int products[3];
  for (int kind = NO_PRECONDITIONER; kind <= PRECONDITIONER; kind++) {
    user u = {0};
    fuge_info info;
    fuge_operator *op = NULL;
    fuge_solver *solver = bed_solver(&u, kind, &op);
    CHECK_DONE(fuge_solve(solver));
    check_bed(solver, &u, kind);
    CHECK_DONE(fuge_get_info(solver, &info));
    products[kind] = info.products;
    free_both(&solver, &op);
  }
  CHECK(products[PRECONDITIONER] < products[NO_PRECONDITIONER]);
  CHECK_INT(products[PRECONDITIONER], products[DIAGONAL]);
}

/* Fails once, at product or preconditioner k: words with its number and the point, no answer; and
 * the same solver goes on when all is well. */
static int check_bed_fails(int k, int of_preconditioner, int returns) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "", part[64];
  double force[M];
  user u = {0};
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = bed_solver(&u, PRECONDITIONER, &op);
  u.returns = returns;
  if (of_preconditioner) u.bad_preconditioner = k; else u.bad_product = k;
  int status = fuge_solve(solver);
  if (status != FUGE_DONE) {
    CHECK_INT(status, FUGE_ERR_CALLBACK);
    if (returns == 0)
      snprintf(part, sizeof part, "%s(4) = NaN", of_preconditioner ? "force" : "displacement");
    else
      snprintf(part, sizeof part, "the operator returned status %d", returns);
    CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, part);
    snprintf(part, sizeof part, "%s %d: ", of_preconditioner ? "preconditioner" : "product", k);
    CHECK_CONTAINS(message, part);
    CHECK_DONE(fuge_get_info(solver, &info));
    CHECK_INT(info.status, FUGE_ERR_CALLBACK);
    fill(force, M);
    CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
    CHECK_UNTOUCHED(force, M);
    memset(&u, 0, sizeof u);
    CHECK_DONE(fuge_solve(solver));
    check_bed(solver, &u, PRECONDITIONER);
  }
  free_both(&solver, &op);
  return status;
}

static void test_bed_failures(void) {
  for (int of_preconditioner = 0; of_preconditioner <= 1; of_preconditioner++)
    for (int returns = 0; returns <= 7; returns += 7) {
      int k = 1;
      while (k < 1000 && check_bed_fails(k, of_preconditioner, returns) != FUGE_DONE) k++;
      CHECK(k > 5 && k < 1000);
    }
}

/* Also when it has forces to start from: one call, and no second attempt. */
static void test_warm_failure(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  user u = {0};
  fuge_operator *op = NULL;
  fuge_solver *solver = bed_solver(&u, NO_PRECONDITIONER, &op);
  CHECK_DONE(fuge_solve(solver));
  u.bad_product = u.products + 1;
  u.returns = 3;
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CALLBACK);
  CHECK_INT(u.products, u.bad_product);
  CHECK_DONE(fuge_solver_message(solver, message, sizeof message));
  CHECK_CONTAINS(message, "product 1: the operator returned status 3");
  u.bad_product = 0;
  CHECK_DONE(fuge_solve(solver));
  free_both(&solver, &op);
}

static void test_wrong_preconditioner(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  user u = {0};
  fuge_operator *op = NULL;
  fuge_solver *solver = bed_solver(&u, NO_PRECONDITIONER, &op);
  CHECK_DONE(fuge_operator_set_preconditioner(op, wrong_preconditioner, NULL, 0));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_NOT_DEFINITE);
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "preconditioner");
  CHECK_DONE(fuge_operator_set_preconditioner(op, preconditioner_bed, NULL, 0));
  memset(&u, 0, sizeof u);
  CHECK_DONE(fuge_solve(solver));
  check_bed(solver, &u, PRECONDITIONER);
  free_both(&solver, &op);
}

/* Engines that need coefficients. */
static void test_unsupported(void) {
  for (int method = FUGE_TABLEAU; method <= FUGE_ACTIVE_SET; method++) {
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    user u = {0};
    fuge_options options;
    fuge_operator *op = NULL;
    fuge_solver *solver = NULL, *other = bed_solver(&u, NO_PRECONDITIONER, &op);
    fuge_solver_free(&other);
    fuge_default_options(&options);
    options.method = method;
    CHECK_DONE(fuge_solver_new(op, &options, &solver, NULL, 0));
    CHECK_DONE(fuge_set_gap(solver, bed_gap, NULL));
    CHECK_DONE(fuge_set_load(solver, 2.0));
    CHECK_STATUS(fuge_solve(solver), FUGE_ERR_UNSUPPORTED);
    CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "FUGE_ITERATIVE");
    CHECK_INT(u.products, 0);
    free_both(&solver, &op);
  }
}

/* A product without a problem: the function of the caller, and what it leaves out of all coefficients. */
static void test_apply(void) {
  const double f[N] = {1.0, -2.0, 4.0};
  double u[N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  scene s = {0};
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_callback(N, multiply, &s, &op, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, N, f, u, message, sizeof message));
  CHECK_INT(s.calls, 1);
  for (int k = 0; k < N; k++) CHECK_NEAR(u[k], 4.0 * f[k], 0.0);
  CHECK_DONE(fuge_operator_set_coefficients(op, 10.0, 0.0, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, N, f, u, message, sizeof message));
  for (int k = 0; k < N; k++) CHECK_NEAR(u[k], 4.0 * f[k] + 30.0, 0.0);
  fill(u, N);
  s.returns = 7;
  CHECK_SAYS(fuge_operator_apply(op, N, f, u, message, sizeof message), FUGE_ERR_CALLBACK, message, "status 7");
  s.returns = 0;
  s.spoil = 2;
  s.odd = NAN;
  CHECK_STATUS(fuge_operator_apply(op, N, f, u, message, sizeof message), FUGE_ERR_CALLBACK);
  CHECK_CONTAINS(message, "displacement(1) = NaN");
  CHECK_UNTOUCHED(u, N);
  fuge_operator_free(&op);
}

int main(void) {
  test_apply();
  make_bed();
  test_solve();
  test_bed_failures();
  test_warm_failure();
  test_wrong_preconditioner();
  test_unsupported();
  test_product();
  test_overwritten_forces();
  test_failures();
  test_refusals();
  test_preconditioner_refusals();
  return check_summary();
}
