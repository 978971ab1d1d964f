/* Section "condensation" of fuge_fe.h. */
#include <limits.h>
#include "check.h"

enum { N = 5 };

/* A chain of N masses with springs of stiffness 2 between them; if anchored, mass 0 to the
 * ground too.  Upper triangle in band storage. */
static void chain_band(int anchored, double *ab) {
  for (int j = 0; j < N; j++) {
    ab[2 * j] = -2.0;
    ab[2 * j + 1] = 4.0;
  }
  ab[0] = 99.0; /* outside of the matrix */
  ab[1] = anchored ? 4.0 : 2.0;
  ab[2 * N - 1] = 2.0;
}

static void chain_dense(int anchored, double *k) {
  double ab[2 * N];
  chain_band(anchored, ab);
  for (int i = 0; i < N * N; i++) k[i] = 0.0;
  for (int j = 0; j < N; j++) {
    k[j + j * N] = ab[2 * j + 1];
    if (j > 0) k[j - 1 + j * N] = k[j + (j - 1) * N] = ab[2 * j];
  }
}

static const int TOUCH[2] = {1, 4};
static const double OUTWARD[2] = {1.0, 1.0};

static void check_chain(fuge_body *body) {
  double alpha[6], b[2], u[N], load[N] = {0, 0, 0, 0, 4};
  const double force[2] = {2.0, 0.0}, bad[2] = {2.0, NAN};
  char message[FUGE_MESSAGE_LENGTH + 1];
  int m = -1;

  CHECK_DONE(fuge_body_set_contact(body, 2, 1, TOUCH, OUTWARD));
  CHECK_STATUS(fuge_body_get_influence(body, alpha, 3), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_body_condense(body));
  CHECK_DONE(fuge_body_set_load(body, load));
  alpha[2] = alpha[5] = SENTINEL;
  CHECK_DONE(fuge_body_get_influence(body, alpha, 3));
  CHECK_VALUES(alpha, 1e-14, 1.0, 1.0);
  CHECK_NEAR(alpha[3], 1.0, 1e-14);
  CHECK_NEAR(alpha[4], 2.5, 1e-14);
  CHECK_UNTOUCHED(alpha + 2, 1);
  CHECK_UNTOUCHED(alpha + 5, 1);
  CHECK_DONE(fuge_body_get_displacement(body, b));
  CHECK_VALUES(b, 1e-13, 4.0, 10.0);
  CHECK_DONE(fuge_body_get_mode_count(body, &m));
  CHECK_INT(m, 0);
  CHECK_DONE(fuge_body_recover(body, force, NULL, u));
  CHECK_STATUS(fuge_body_recover(body, bad, NULL, u), FUGE_ERR_NOT_FINITE);
  CHECK_NEAR(u[0], 3.0, 1e-13);
  CHECK_STATUS(fuge_body_get_influence(body, alpha, 1), FUGE_ERR_SIZE);
  fuge_body_message(body, message, sizeof message);
  CHECK_CONTAINS(message, "lda = 1");
  CHECK_NEAR(u[4], 12.0, 1e-13);
}

static void test_dense_and_band(void) {
  double k[N * N], ab[2 * N];
  fuge_body *body = NULL;

  chain_dense(1, k);
  CHECK_DONE(fuge_body_dense(N, k, N, &body, NULL, 0));
  check_chain(body);
  fuge_body_free(&body);
  CHECK(body == NULL);
  fuge_body_free(&body);
  fuge_body_free(NULL);
  chain_band(1, ab);
  CHECK_DONE(fuge_body_band(N, 1, ab, 2, 1, &body, NULL, 0));
  check_chain(body);
  fuge_body_free(&body);
}

/* fuge_body_columns or fuge_body_sparse. */
typedef int (*columns_function)(int degrees, const int *column, const int *row, const double *value, fuge_body **body,
                                char *message, size_t len);

static void test_columns(columns_function create) {
  const int column[N + 1] = {0, 1, 3, 5, 7, 9}, row[9] = {0, 0, 1, 2, 1, 3, 2, 3, 4};
  double value[9] = {4, -2, 4, 4, -2, 4, -2, -2, 2};
  int bad[9];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_body *body = NULL;

  CHECK_DONE(create(N, column, row, value, &body, NULL, 0));
  check_chain(body);
  fuge_body_free(&body);
  memcpy(bad, row, sizeof bad);
  bad[3] = N;
  CHECK_DONE(create(N, column, bad, value, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_contact(body, 2, 1, TOUCH, OUTWARD));
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_DOF);
  fuge_body_message(body, message, sizeof message);
  CHECK_CONTAINS(message, "row(3) = 5");
  fuge_body_free(&body);
  CHECK_STATUS(create(0, column, row, value, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(create(N, NULL, row, value, &body, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(create(N, column, row, value, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK(body == NULL);
}

/* Springs that are all touched: CAMD 2.4.6 reads memory that is not its own where one node of its graph is last. */
static void test_columns_touched_everywhere(columns_function create) {
  const int column[3] = {0, 1, 3}, row[3] = {0, 0, 1}, touch[2] = {0, 1};
  const double spring = 2.0, springs[3] = {2.0, 1.0, 2.0}, outward[2] = {1.0, 1.0};
  double alpha[4];
  fuge_body *body = NULL;

  CHECK_DONE(create(1, column, row, &spring, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_contact(body, 1, 1, touch, outward));
  CHECK_DONE(fuge_body_condense(body));
  CHECK_DONE(fuge_body_get_influence(body, alpha, 1));
  CHECK_NEAR(alpha[0], 0.5, 1e-15);
  fuge_body_free(&body);
  CHECK_DONE(create(2, column, row, springs, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_contact(body, 2, 1, touch, outward));
  CHECK_DONE(fuge_body_condense(body));
  CHECK_DONE(fuge_body_get_influence(body, alpha, 2));
  CHECK_VALUES(alpha, 1e-15, 2.0 / 3.0, -1.0 / 3.0);
  fuge_body_free(&body);
}

/* Between two stops, without supports: all of the load goes to one of them. */
static void test_floating(void) {
  double k[N * N], alpha[4], b[2], modes[2], w[1], gap[2], force[2], motion[1], u[N];
  const double load[N] = {0, 3, 0, 0, 0}, ones[N] = {1, 1, 1, 1, 1}, normal[2] = {1.0, -1.0}, stops[2] = {0.5, 0.25};
  const int ends[2] = {0, N - 1};
  fuge_body *body = NULL;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;

  chain_dense(0, k);
  CHECK_DONE(fuge_body_dense(N, k, N, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_load(body, load));
  CHECK_DONE(fuge_body_set_contact(body, 2, 1, ends, normal));
  for (int given = 0; given < 2; given++) {
    int m = 0;
    CHECK_DONE(given ? fuge_body_set_rigid_modes(body, 1, ones) : fuge_body_find_rigid_modes(body));
    CHECK_DONE(fuge_body_condense(body));
    CHECK_DONE(fuge_body_get_mode_count(body, &m));
    CHECK_INT(m, 1);
    if (m != 1) break;
    CHECK_DONE(fuge_body_get_influence(body, alpha, 2));
    CHECK_DONE(fuge_body_get_displacement(body, b));
    CHECK_DONE(fuge_body_get_modes(body, modes, w));
    CHECK_DONE(fuge_body_get_modes(body, NULL, NULL));
    for (int i = 0; i < 2; i++) gap[i] = stops[i] + b[i];
    CHECK_DONE(fuge_operator_dense(2, alpha, 2, &op, NULL, 0));
    CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
    CHECK_DONE(fuge_set_gap(solver, gap, NULL));
    CHECK_DONE(fuge_set_modes(solver, m, modes, w));
    CHECK_DONE(fuge_solve(solver));
    fuge_get_force(solver, force);
    fuge_get_motion(solver, motion);
    CHECK_VALUES(force, 1e-13, 0.0, 3.0);
    CHECK_STATUS(fuge_body_recover(body, force, NULL, u), FUGE_ERR_POINTER);
    CHECK_DONE(fuge_body_recover(body, force, motion, u));
    CHECK_NEAR(u[4], 0.25, 1e-13);
    CHECK_NEAR(u[1], 4.75, 1e-13);
    fuge_solver_free(&solver);
    fuge_operator_free(&op);
  }
  fuge_body_free(&body);
}

static void test_rigid_modes(void) {
  const double square[8] = {1, 1, 3, 1, 1, 3, 3, 3}, cube[6] = {0, 0, 0, 2, 4, 6};
  double plane[24], space[36];

  CHECK_DONE(fuge_rigid_modes(2, 4, square, plane, NULL, 0));
  for (int node = 0; node < 4; node++) {
    CHECK_NEAR(plane[2 * node], 1.0, 0.0);
    CHECK_NEAR(plane[8 + 2 * node + 1], 1.0, 0.0);
    CHECK_NEAR(plane[16 + 2 * node], 2.0 - square[2 * node + 1], 0.0);
    CHECK_NEAR(plane[16 + 2 * node + 1], square[2 * node] - 2.0, 0.0);
  }
  CHECK_DONE(fuge_rigid_modes(3, 2, cube, space, NULL, 0));
  /* About x, the second node moves by (0, -z, y) from the centre. */
  CHECK_NEAR(space[3 * 6 + 3], 0.0, 0.0);
  CHECK_NEAR(space[3 * 6 + 4], -3.0, 0.0);
  CHECK_NEAR(space[3 * 6 + 5], 2.0, 0.0);
  CHECK_STATUS(fuge_rigid_modes(1, 2, cube, space, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_rigid_modes(2, 0, cube, space, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_rigid_modes(2, 2, NULL, space, NULL, 0), FUGE_ERR_POINTER);
}

static void test_supports(void) {
  double k[N * N], b[1], alpha[1];
  const int ends[2] = {0, N - 1}, middle = 2, bad[2] = {0, N}, far = INT_MAX;
  const double pulled[2] = {-4.0, 8.0}, one = 1.0;
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_body *body = NULL;

  chain_dense(0, k);
  CHECK_DONE(fuge_body_dense(N, k, N, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_contact(body, 1, 1, &middle, &one));
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_NOT_DEFINITE);
  fuge_body_message(body, message, sizeof message);
  CHECK_CONTAINS(message, "degree of freedom 4");
  CHECK_DONE(fuge_body_fix(body, 2, bad, NULL));
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_DOF);
  fuge_body_message(body, message, sizeof message);
  CHECK_CONTAINS(message, "fixed(1) = 5");
  CHECK_DONE(fuge_body_fix(body, 1, &far, NULL));
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_DOF);
  CHECK_DONE(fuge_body_fix(body, 2, ends, pulled));
  CHECK_DONE(fuge_body_condense(body));
  CHECK_DONE(fuge_body_get_displacement(body, b));
  CHECK_NEAR(b[0], 2.0, 1e-13);
  CHECK_DONE(fuge_body_get_influence(body, alpha, 1));
  CHECK_NEAR(alpha[0], 0.5, 1e-14);
  /* Without them it floats again. */
  CHECK_DONE(fuge_body_fix(body, 0, NULL, NULL));
  CHECK_STATUS(fuge_body_get_displacement(body, b), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_NOT_DEFINITE);
  k[1] = 3.0;
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_NOT_SYMMETRIC);
  fuge_body_message(body, message, sizeof message);
  CHECK_CONTAINS(message, "stiffness(0,1)");
  fuge_body_free(&body);
}

/* A bolt and a gasket at one node: a mass on a spring of stiffness 10, pulled away by 6, is held by
 * a bolt of stiffness 30, and from a gap of 0.1 on by a gasket of stiffness 20. */
static void test_points_that_move_alike(void) {
  const double k = 10.0, load = 6.0, normal[2] = {-1, -1}, slack[2] = {0.0, 0.1}, compliance[2] = {1.0 / 30, 1.0 / 20};
  const int dof[2] = {0, 0};
  double alpha[4], b[2], gap[2], force[2], u;
  fuge_body *body = NULL;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;

  CHECK_DONE(fuge_body_dense(1, &k, 1, &body, NULL, 0));
  CHECK_DONE(fuge_body_set_load(body, &load));
  CHECK_DONE(fuge_body_set_contact(body, 2, 1, dof, normal));
  CHECK_DONE(fuge_body_condense(body));
  CHECK_DONE(fuge_body_get_influence(body, alpha, 2));
  CHECK_DONE(fuge_body_get_displacement(body, b));
  for (int i = 0; i < 2; i++) gap[i] = slack[i] + b[i];
  CHECK_DONE(fuge_operator_dense(2, alpha, 2, &op, NULL, 0));
  CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_compliance(solver, compliance));
  CHECK_DONE(fuge_set_approach(solver, 0.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, 1e-13, 4.0, 2.0 / 3.0);
  CHECK_DONE(fuge_body_recover(body, force, NULL, &u));
  CHECK_NEAR(u, 8.0 / 60.0, 1e-14);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  fuge_body_free(&body);
}

static void test_bad_calls(void) {
  double k[N * N], x[N] = {0};
  const int dof = 0;
  fuge_body *body = NULL;

  chain_dense(1, k);
  CHECK_STATUS(fuge_body_dense(0, k, N, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_dense(N, k, N - 1, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_dense(N, NULL, N, &body, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_dense(N, k, N, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_band(N, -1, k, 2, 1, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_band(N, 2, k, 2, 1, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_band(N, 1, NULL, 2, 1, &body, NULL, 0), FUGE_ERR_POINTER);
  CHECK(body == NULL);
  CHECK_DONE(fuge_body_dense(N, k, N, &body, NULL, 0));
  CHECK_STATUS(fuge_body_fix(body, -1, &dof, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_fix(body, 1, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_set_load(body, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_set_rigid_modes(body, -1, x), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_set_rigid_modes(body, 1, NULL), FUGE_ERR_POINTER);
  /* Refused before the array is read, which is shorter. */
  CHECK_STATUS(fuge_body_set_rigid_modes(body, 1000, x), FUGE_ERR_MODES);
  CHECK_STATUS(fuge_body_set_contact(body, 0, 1, &dof, x), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_set_contact(body, 1, 1, NULL, x), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_condense(body), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_recover(body, x, x, x), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_body_condense(NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_find_rigid_modes(NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_message(body, NULL, 0), FUGE_ERR_POINTER);
  fuge_body_free(&body);
}

int main(void) {
  test_dense_and_band();
  test_columns(fuge_body_columns);
  test_columns_touched_everywhere(fuge_body_columns);
#ifdef HAVE_SPARSE
  test_columns(fuge_body_sparse);
  test_columns_touched_everywhere(fuge_body_sparse);
#endif
  test_floating();
  test_rigid_modes();
  test_supports();
  test_points_that_move_alike();
  test_bad_calls();
  return check_summary();
}
