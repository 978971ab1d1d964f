/* The rule of fuge.h for messages: every call outside of solvers and bodies that refuses data says
 * what is wrong and where, with indices from 0, in the buffer of its last two arguments. */
#include <limits.h>
#include "table1.h"

enum { MANY = 16, UNSET = -77 };

/* What calls must leave alone when they fail: nothing but these is passed for output. */
static double reals[MANY];
static int ints[MANY];
static char place;
static void *const no_handle = &place;
static fuge_operator *op;
static fuge_solver *solver;
static fuge_body *body;
static fuge_punch *smooth;

static void reset_outputs(void) {
  fill(reals, MANY);
  for (int k = 0; k < MANY; k++) ints[k] = UNSET;
  op = no_handle;
  solver = no_handle;
  body = no_handle;
  smooth = no_handle;
}

static void check_outputs(void) {
  CHECK_UNTOUCHED(reals, MANY);
  for (int k = 0; k < MANY; k++) CHECK_INT(ints[k], UNSET);
  CHECK(op == no_handle);
  CHECK(solver == no_handle);
  CHECK(body == no_handle);
  CHECK(smooth == no_handle);
}

/* ---- calls that are refused ---------------------------------------------- */

static const double SKEW[4] = {0.2, 0.1, 0.15, 0.2}, HOLE[4] = {0.2, NAN, 0.1, 0.2};
static const double X[2] = {0.5, 1.5}, WIDTH[2] = {1.0, 1.0}, NO_WIDTH[2] = {1.0, 0.0};
static const double UNEQUAL[2] = {1.0, 2.0}, ONES[2] = {1.0, 1.0}, ONE_NEGATIVE[2] = {1.0, -1.0};

static int apply(int n, const double *f, double *u, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) u[k] = f[k];
  return 0;
}

static int profile(int n, const double *x, double *gap, double *slope, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) {
    gap[k] = x[k] * x[k];
    slope[k] = 2.0 * x[k];
  }
  return 0;
}

static int dense_not_symmetric(char *message, size_t len) {
  return fuge_solve_dense(2, SKEW, 2, X, 1.0, reals, reals + 2, reals + 4, message, len);
}

static int dense_negative_load(char *message, size_t len) {
  return fuge_solve_dense(2, TABLE1_ALPHA, 2, X, -1.0, reals, reals + 2, reals + 4, message, len);
}

static int plane_modulus(char *message, size_t len) {
  return fuge_plane_modulus(-1.0, 0.3, FUGE_PLANE_STRAIN, reals, message, len);
}

static int combined_modulus(char *message, size_t len) {
  return fuge_combined_modulus(1.0, 0.0, reals, message, len);
}

static int displacement_shares(char *message, size_t len) {
  return fuge_displacement_shares(INFINITY, INFINITY, reals, reals + 1, message, len);
}

static int matrix_width(char *message, size_t len) {
  return fuge_halfplane_matrix(2, X, NO_WIDTH, 1.0, FUGE_MEAN, 0, reals, 2, message, len);
}

static int matrix_unequal(char *message, size_t len) {
  return fuge_halfplane_matrix(2, X, UNEQUAL, 1.0, FUGE_HAT, 1, reals, 2, message, len);
}

static int edges_grid(char *message, size_t len) {
  return fuge_contact_edges(2, X, UNEQUAL, ONES, NULL, NULL, FUGE_MEAN, 0, 4, reals, reals + 4, reals + 8,
                            reals + 12, ints, ints + 4, ints + 8, message, len);
}

static int operator_hole(char *message, size_t len) { return fuge_operator_dense(2, HOLE, 2, &op, message, len); }

static int operator_skew(char *message, size_t len) { return fuge_operator_dense(2, SKEW, 2, &op, message, len); }

static int operator_callback(char *message, size_t len) {
  return fuge_operator_callback(0, apply, NULL, &op, message, len);
}

static int operator_halfplane(char *message, size_t len) {
  return fuge_operator_halfplane(8, 1.0, 1.0, FUGE_MEAN, 7, &op, message, len);
}

static fuge_operator *springs, *dense;

static int diagonal_negative(char *message, size_t len) {
  return fuge_operator_set_diagonal(springs, ONE_NEGATIVE, message, len);
}

static int diagonal_of_dense(char *message, size_t len) {
  return fuge_operator_set_diagonal(dense, ONES, message, len);
}

static int preconditioner_null(char *message, size_t len) {
  return fuge_operator_set_preconditioner(springs, NULL, message, len);
}

/* Zeros are no options. */
static int solver_zeroed(char *message, size_t len) {
  fuge_options options;
  memset(&options, 0, sizeof options);
  return fuge_solver_new(dense, &options, &solver, message, len);
}

static int load_path_pulls(char *message, size_t len) {
  return fuge_load_path(dense, X, -1.0, 2, reals, reals + 2, reals + 4, ints, ints + 2, ints + 4, ints + 6, message,
                        len);
}

static int load_path_of_springs(char *message, size_t len) {
  return fuge_load_path(springs, X, 1.0, 2, reals, reals + 2, reals + 4, ints, ints + 2, ints + 4, ints + 6, message,
                        len);
}

static int body_dense(char *message, size_t len) { return fuge_body_dense(2, TABLE1_ALPHA, 1, &body, message, len); }

static int body_band(char *message, size_t len) {
  return fuge_body_band(2, 2, TABLE1_ALPHA, 2, 1, &body, message, len);
}

static int rigid_modes(char *message, size_t len) { return fuge_rigid_modes(4, 2, X, reals, message, len); }

static int rigid_modes_hole(char *message, size_t len) { return fuge_rigid_modes(2, 2, HOLE, reals, message, len); }

/* Refused before any position is read. */
static int rigid_modes_many(char *message, size_t len) {
  return fuge_rigid_modes(3, 1000000000, X, reals, message, len);
}

static int path_of_two_lines(char *message, size_t len) {
  const char *const name = "p";
  const double *const result = X;
  return fuge_write_results("no_such\n%s'folder/\xc3\xa4", 1, 1, ONES, NULL, 1, &name, &result, message, len);
}

static int smooth_interval(char *message, size_t len) {
  return fuge_solve_smooth_punch(profile, NULL, 1.0, -1.0, 1.0, 1.0, NULL, &smooth, message, len);
}

static fuge_punch *cylinder;

static int smooth_report(char *message, size_t len) { return fuge_punch_get_report(cylinder, NULL, message, len); }

static int smooth_pressure(char *message, size_t len) {
  return fuge_punch_get_pressure(cylinder, -1, X, reals, message, len);
}

static int smooth_pressure_hole(char *message, size_t len) {
  return fuge_punch_get_pressure(cylinder, 4, HOLE, reals, message, len);
}

static int smooth_gap_hole(char *message, size_t len) {
  return fuge_punch_get_gap(cylinder, 2, X, HOLE, reals, message, len);
}

static int smooth_gap(char *message, size_t len) {
  return fuge_punch_get_gap(cylinder, 2, X, NULL, reals, message, len);
}

static int smooth_coefficients(char *message, size_t len) {
  return fuge_punch_get_coefficients(cylinder, -3, reals, message, len);
}

#ifdef HAVE_SPARSE
static int body_sparse(char *message, size_t len) {
  const int column[3] = {0, 0, 0}, row[1] = {0};
  return fuge_body_sparse(2, column, row, ONES, &body, message, len);
}

static int body_sparse_many(char *message, size_t len) {
  return fuge_body_sparse(INT_MAX, ints, ints, reals, &body, message, len);
}
#endif

typedef struct refusal {
  int (*call)(char *message, size_t len);
  int status;
  const char *part;
} refusal;

static const refusal REFUSALS[] = {
  {dense_not_symmetric, FUGE_ERR_NOT_SYMMETRIC, "alpha(1,0) and alpha(0,1) differ by 0.05"},
  {dense_negative_load, FUGE_ERR_NO_EQUILIBRIUM, "load F_0 = -1.0"},
  {plane_modulus, FUGE_ERR_MODULUS, "young = -1.0"},
  {combined_modulus, FUGE_ERR_MODULUS, "e2 = 0.0"},
  {displacement_shares, FUGE_ERR_MODULUS, "both"},
  {matrix_width, FUGE_ERR_WIDTH, "width(1) = 0.0"},
  {matrix_unequal, FUGE_ERR_GRID, "width(1) = 2.000000 differs from width(0) by 1.0"},
  {edges_grid, FUGE_ERR_GRID, "cell 1 at x = 1.5"},
  {operator_hole, FUGE_ERR_NOT_FINITE, "alpha(1,0) = NaN"},
  {operator_skew, FUGE_ERR_NOT_SYMMETRIC, "alpha(1,0) and alpha(0,1) differ by 0.05"},
  {operator_callback, FUGE_ERR_SIZE, "n = 0"},
  {operator_halfplane, FUGE_ERR_OPTION, "boundary = 7"},
  {diagonal_negative, FUGE_ERR_NOT_DEFINITE, "diagonal(1) = -1.0"},
  {diagonal_of_dense, FUGE_ERR_UNSUPPORTED, "fuge_operator_callback"},
  {preconditioner_null, FUGE_ERR_POINTER, "preconditioner is NULL"},
  {solver_zeroed, FUGE_ERR_OPTION, "tolerance = 0.0"},
  {load_path_pulls, FUGE_ERR_NO_EQUILIBRIUM, "load F_0 = -1.0"},
  {load_path_of_springs, FUGE_ERR_UNSUPPORTED, "dense operator"},
  {body_dense, FUGE_ERR_SIZE, "ldk = 1 is less than degrees = 2"},
  {body_band, FUGE_ERR_SIZE, "ldab = 2 is not above kd = 2"},
  {rigid_modes, FUGE_ERR_SIZE, "dimensions = 4"},
  {rigid_modes_hole, FUGE_ERR_NOT_FINITE, "position(1,0) = NaN"},
  {rigid_modes_many, FUGE_ERR_SIZE, "nodes = 1000000000 have more than 2147483647 degrees of freedom"},
  {path_of_two_lines, FUGE_ERR_FILE, "\"no_such?%s'folder/\xc3\xa4\" cannot be opened"},
  {smooth_interval, FUGE_ERR_WIDTH, "lower = 1.0"},
  {smooth_report, FUGE_ERR_POINTER, "report is NULL"},
  {smooth_pressure, FUGE_ERR_SIZE, "count = -1"},
  {smooth_pressure_hole, FUGE_ERR_NOT_FINITE, "x(1) = NaN"},
  {smooth_gap_hole, FUGE_ERR_NOT_FINITE, "initial_gap(1) = NaN"},
  {smooth_gap, FUGE_ERR_POINTER, "initial_gap is NULL"},
  {smooth_coefficients, FUGE_ERR_SIZE, "capacity = -3"},
#ifdef HAVE_SPARSE
  {body_sparse_many, FUGE_ERR_SIZE, "degrees = 2147483647 is too large"},
  {body_sparse, FUGE_ERR_SIZE, "column(2) = 0"},
#endif
};

/* Bytes beyond len stay as they are. */
static void check_cut(const refusal *bad, const char *whole, size_t len) {
  char buffer[16];
  memset(buffer, '#', sizeof buffer);
  CHECK_STATUS(bad->call(buffer, len), bad->status);
  if (len > 0) {
    CHECK_INT(strlen(buffer), len - 1);
    CHECK(strncmp(buffer, whole, len - 1) == 0);
  }
  for (size_t k = len; k < sizeof buffer; k++) CHECK(buffer[k] == '#');
}

/* The largest len is no negative one. */
static void check_unlimited(const refusal *bad, const char *whole) {
  char buffer[512] = "old";
  CHECK_MESSAGE(bad->call(buffer, (size_t)-1), bad->status, buffer, whole);
}

static void test_refusals(void) {
  for (size_t k = 0; k < sizeof REFUSALS / sizeof REFUSALS[0]; k++) {
    const refusal *bad = &REFUSALS[k];
    char message[512] = "old";
    reset_outputs();
    CHECK_SAYS(bad->call(message, sizeof message), bad->status, message, bad->part);
    CHECK(strlen(message) <= 256);
    CHECK_STATUS(bad->call(NULL, 0), bad->status);
    CHECK_STATUS(bad->call(NULL, 100), bad->status);
    check_cut(bad, message, 0);
    check_cut(bad, message, 1);
    check_cut(bad, message, 8);
    check_unlimited(bad, message);
    check_outputs();
  }
}

/* ---- calls that are done ------------------------------------------------- */

static void test_success_empties_the_message(void) {
  char message[64] = "old";
  CHECK_MESSAGE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &dense, message, sizeof message), FUGE_DONE, message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_operator_callback(2, apply, NULL, &springs, message, sizeof message), FUGE_DONE, message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_operator_set_diagonal(springs, ONES, message, sizeof message), FUGE_DONE, message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_operator_set_preconditioner(springs, apply, message, sizeof message), FUGE_DONE, message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_solver_new(dense, NULL, &solver, message, sizeof message), FUGE_DONE, message, "");
  fuge_solver_free(&solver);
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_body_dense(2, TABLE1_ALPHA, 2, &body, message, sizeof message), FUGE_DONE, message, "");
  fuge_body_free(&body);
  strcpy(message, "old");
  CHECK_DONE(fuge_halfplane_matrix(2, X, WIDTH, 1.0, FUGE_MEAN, 0, reals, 2, message, sizeof message));
  CHECK_STRING(message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_solve_smooth_punch(profile, NULL, -1.0, 1.0, 1.0, 0.1, NULL, &cylinder, message, sizeof message),
                FUGE_DONE, message, "");
  strcpy(message, "old");
  CHECK_MESSAGE(fuge_punch_get_pressure(cylinder, 2, X, reals, message, sizeof message), FUGE_DONE, message, "");
}

/* ---- solvers and bodies keep theirs -------------------------------------- */

static void check_solver_message(const fuge_solver *s, const char *expected) {
  char message[300];
  memset(message, '#', sizeof message);
  CHECK_DONE(fuge_solver_message(s, message, sizeof message));
  if (expected[0] == '\0') CHECK_STRING(message, "");
  else CHECK_CONTAINS(message, expected);
}

/* A getter that succeeds leaves the warning of the solve, one that fails replaces it. */
static void test_solver_keeps_its_message(void) {
  const double tilt[4] = {1.0, 1.0, -1.0, 1.0}, none[2] = {0.0, 0.0}, once[4] = {1.0, 1.0, 2.0, 2.0};
  double force[2];
  fuge_solver *s = NULL;
  CHECK_DONE(fuge_solver_new(dense, NULL, &s, NULL, 0));
  check_solver_message(s, "");
  CHECK_STATUS(fuge_solve(s), FUGE_ERR_CALL_ORDER);
  check_solver_message(s, "fuge_set_gap before fuge_solve");
  CHECK_DONE(fuge_set_gap(s, ONES, NULL));
  check_solver_message(s, "");
  CHECK_STATUS(fuge_set_gap(s, HOLE, NULL), FUGE_ERR_NOT_FINITE);
  check_solver_message(s, "gap(1) = NaN");
  CHECK_DONE(fuge_set_modes(s, 2, once, none));
  CHECK_STATUS(fuge_solve(s), FUGE_ERR_MODES);
  check_solver_message(s, "mode ");
  CHECK_DONE(fuge_set_modes(s, 2, tilt, none));
  CHECK_STATUS(fuge_solve(s), FUGE_WARN_NOT_UNIQUE);
  check_solver_message(s, "motion ");
  CHECK_DONE(fuge_get_force(s, force));
  check_solver_message(s, "motion ");
  CHECK_STATUS(fuge_get_force(s, NULL), FUGE_ERR_POINTER);
  check_solver_message(s, "force is NULL");
  fuge_solver_free(&s);
}

static void check_body_message(const fuge_body *b, const char *expected) {
  char message[300];
  memset(message, '#', sizeof message);
  CHECK_DONE(fuge_body_message(b, message, sizeof message));
  if (expected[0] == '\0') CHECK_STRING(message, "");
  else CHECK_CONTAINS(message, expected);
}

static void test_body_keeps_its_message(void) {
  const double nearly[4] = {1.0, 1.0 - 1e-13, 1.0 - 1e-13, 1.0}, normal[2] = {1.0, 1.0};
  const int dof[2] = {0, 1}, beyond[2] = {1, 2}, twice[2] = {1, 1};
  double alpha[4];
  fuge_body *b = NULL;
  CHECK_DONE(fuge_body_dense(2, nearly, 2, &b, NULL, 0));
  check_body_message(b, "");
  CHECK_STATUS(fuge_body_get_influence(b, alpha, 2), FUGE_ERR_CALL_ORDER);
  check_body_message(b, "fuge_body_condense first");
  CHECK_STATUS(fuge_body_condense(b), FUGE_ERR_SIZE);
  check_body_message(b, "no contact points");
  CHECK_DONE(fuge_body_set_contact(b, 2, 1, beyond, normal));
  check_body_message(b, "");
  CHECK_STATUS(fuge_body_condense(b), FUGE_ERR_DOF);
  check_body_message(b, "contact point 1: dof(0) = 2 is not one of the 2 degrees of freedom");
  CHECK_DONE(fuge_body_set_contact(b, 2, 1, dof, normal));
  CHECK_DONE(fuge_body_fix(b, 2, twice, NULL));
  CHECK_STATUS(fuge_body_condense(b), FUGE_ERR_DOF);
  check_body_message(b, "fixed(0) and fixed(1) are both degree of freedom 1:");
  CHECK_DONE(fuge_body_fix(b, 0, NULL, NULL));
  CHECK_STATUS(fuge_body_condense(b), FUGE_WARN_RESIDUAL);
  check_body_message(b, "degree of freedom ");
  CHECK_DONE(fuge_body_get_influence(b, alpha, 2));
  check_body_message(b, "degree of freedom ");
  CHECK_STATUS(fuge_body_get_influence(b, alpha, 1), FUGE_ERR_SIZE);
  check_body_message(b, "lda = 1");
  CHECK_STATUS(fuge_body_recover(b, ONES, NULL, NULL), FUGE_ERR_POINTER);
  check_body_message(b, "displacement is NULL");
  fuge_body_free(&b);
}

int main(void) {
  test_success_empties_the_message();
  test_refusals();
  test_solver_keeps_its_message();
  test_body_keeps_its_message();
  fuge_punch_free(&cylinder);
  fuge_operator_free(&springs);
  fuge_operator_free(&dense);
  return check_summary();
}
