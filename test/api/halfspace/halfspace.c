/* Section "half-space" of fuge_halfspace.h. */
#include <limits.h>
#include "check.h"

enum { N = 4, LDA = 5 };
static const double E_STAR = 3.0, TOLERANCE = 4e-16;
/* Four unit squares around the origin. */
static const double X[N] = {-0.5, 0.5, -0.5, 0.5}, Y[N] = {-0.5, -0.5, 0.5, 0.5}, ONES[N] = {1, 1, 1, 1};
/* Three rectangles of different sizes, side by side from the axes. */
static const double QUARTER_X[3] = {0.5, 1.5, 1.0}, QUARTER_Y[3] = {0.25, 0.25, 1.0};
static const double QUARTER_WIDTH_X[3] = {1.0, 1.0, 2.0}, QUARTER_WIDTH_Y[3] = {0.5, 0.5, 1.0};

static int matrix(int n, const double *x, int element, double *alpha, int lda, char *message, size_t len) {
  return fuge_halfspace_matrix(n, x, Y, ONES, ONES, E_STAR, element, 0, 0, alpha, lda, message, len);
}

/* The mean of 1/r over a unit square from its centre is 4 ln(1 + sqrt 2); over all pairs of its points
 * it is 4 (ln(1 + sqrt 2) + (1 - sqrt 2)/3). */
static void test_one_square(void) {
  const double pi = acos(-1.0), root = sqrt(2.0);
  double alpha;
  CHECK_DONE(matrix(1, X, FUGE_CENTRE, &alpha, 1, NULL, 0));
  CHECK_NEAR(alpha, 4.0 * log(1.0 + root) / (pi * E_STAR), 2.0 * TOLERANCE);
  CHECK_DONE(matrix(1, X, FUGE_MEAN, &alpha, 1, NULL, 0));
  CHECK_NEAR(alpha, 4.0 * (log(1.0 + root) + (1.0 - root) / 3.0) / (pi * E_STAR), 2.0 * TOLERANCE);
}

/* Symmetric, the nearer the larger; rows beyond n are padding. */
static void test_four_squares(int element) {
  double alpha[LDA * N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(alpha, LDA * N);
  CHECK_MESSAGE(matrix(N, X, element, alpha, LDA, message, sizeof message), FUGE_DONE, message, "");
  for (int k = 0; k < N; k++) {
    CHECK_NEAR(alpha[k + LDA * k], alpha[0], 0.0);
    CHECK_NEAR(alpha[k + LDA * (k ^ 1)], alpha[1], 0.0);
    CHECK_NEAR(alpha[k + LDA * (k ^ 2)], alpha[1], 0.0);
    CHECK_NEAR(alpha[k + LDA * (k ^ 3)], alpha[3], 0.0);
    CHECK_UNTOUCHED(alpha + N + LDA * k, 1);
  }
  CHECK(alpha[0] > alpha[1] && alpha[1] > alpha[3] && alpha[3] > 0.0);
}

/* A quarter of a force on a rectangle and on each of its images. */
static void test_folded(void) {
  double x[12], y[12], width_x[12], width_y[12], whole[144], quarter[9], half[36];
  for (int k = 0; k < 12; k++) {
    x[k] = QUARTER_X[k % 3] * (k < 6 ? 1.0 : -1.0);
    y[k] = QUARTER_Y[k % 3] * (k % 6 < 3 ? 1.0 : -1.0);
    width_x[k] = QUARTER_WIDTH_X[k % 3];
    width_y[k] = QUARTER_WIDTH_Y[k % 3];
  }
  CHECK_DONE(fuge_halfspace_matrix(12, x, y, width_x, width_y, E_STAR, FUGE_MEAN, 0, 0, whole, 12, NULL, 0));
  CHECK_DONE(fuge_halfspace_matrix(3, x, y, width_x, width_y, E_STAR, FUGE_MEAN, 1, 1, quarter, 3, NULL, 0));
  CHECK_DONE(fuge_halfspace_matrix(6, x, y, width_x, width_y, E_STAR, FUGE_MEAN, 1, 0, half, 6, NULL, 0));
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) {
      double sum = 0.0;
      for (int image = 0; image < 4; image++) sum += whole[i + 12 * (j + 3 * image)];
      CHECK_NEAR(quarter[i + 3 * j], 0.25 * sum, TOLERANCE);
      CHECK_NEAR(half[i + 6 * j], 0.5 * (whole[i + 12 * j] + whole[i + 12 * (j + 6)]), TOLERANCE);
    }
}

/* Indices in messages count from 0. */
static void test_refusals(void) {
  static const double zero[N] = {1, 1, 0, 1}, nan[N] = {0, 1, 2, NAN};
  double alpha[N * N];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fill(alpha, N * N);
  CHECK_STATUS(matrix(0, X, FUGE_MEAN, alpha, N, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_STATUS(matrix(N, X, FUGE_MEAN, alpha, N - 1, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_MESSAGE(matrix(N, NULL, FUGE_MEAN, alpha, N, message, sizeof message), FUGE_ERR_POINTER, message, "x is NULL");
  CHECK_STATUS(matrix(N, X, FUGE_MEAN, NULL, N, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(matrix(N, X, FUGE_HAT, alpha, N, message, sizeof message), FUGE_ERR_ELEMENT);
  CHECK_SAYS(matrix(N, nan, FUGE_MEAN, alpha, N, message, sizeof message), FUGE_ERR_NOT_FINITE, message, "x(3) = NaN");
  CHECK_SAYS(fuge_halfspace_matrix(N, X, X, ONES, ONES, E_STAR, FUGE_MEAN, 0, 0, alpha, N, message, sizeof message),
             FUGE_ERR_WIDTH, message, "rectangles 0 and 2 overlap");
  CHECK_SAYS(fuge_halfspace_matrix(N, X, Y, ONES, zero, E_STAR, FUGE_MEAN, 0, 0, alpha, N, message, sizeof message),
             FUGE_ERR_WIDTH, message, "width_y(2) = 0.");
  CHECK_STATUS(fuge_halfspace_matrix(N, X, Y, ONES, ONES, 0.0, FUGE_MEAN, 0, 0, alpha, N, message, sizeof message),
               FUGE_ERR_MODULUS);
  CHECK_SAYS(fuge_halfspace_matrix(N, X, Y, ONES, ONES, E_STAR, FUGE_MEAN, 0, 1, alpha, N, message, sizeof message),
             FUGE_ERR_WIDTH, message, "y(0) = -0.5");
  CHECK_UNTOUCHED(alpha, N * N);
}

static fuge_solver *ball_on_grid(fuge_operator *op, const double *gap) {
  fuge_solver *solver = NULL;
  CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_DONE(fuge_solve(solver));
  return solver;
}

enum { NX = 9, NY = 7, CELLS = NX * NY };

/* A ball off the middle: the same forces by products and by the matrix. */
static void test_grid(int element) {
  static double alpha[CELLS * CELLS];
  double x[CELLS], y[CELLS], width_x[CELLS], width_y[CELLS], gap[CELLS], force[CELLS], right[CELLS];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fuge_operator *op = NULL, *dense = NULL;
  fuge_solver *solver;
  for (int k = 0; k < CELLS; k++) {
    x[k] = 0.5 * (k % NX) - 1.8;
    y[k] = 0.75 * (k / NX) - 2.0;
    width_x[k] = 0.5;
    width_y[k] = 0.75;
    gap[k] = 0.3 * (x[k] * x[k] + y[k] * y[k]);
  }
  CHECK_MESSAGE(fuge_operator_halfspace(NX, NY, 0.5, 0.75, E_STAR, element, FUGE_FREE, &op, message, sizeof message),
                FUGE_DONE, message, "");
  solver = ball_on_grid(op, gap);
  CHECK_DONE(fuge_get_force(solver, force));
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  CHECK_DONE(fuge_halfspace_matrix(CELLS, x, y, width_x, width_y, E_STAR, element, 0, 0, alpha, CELLS, NULL, 0));
  CHECK_DONE(fuge_operator_dense(CELLS, alpha, CELLS, &dense, NULL, 0));
  solver = ball_on_grid(dense, gap);
  CHECK_DONE(fuge_get_force(solver, right));
  fuge_solver_free(&solver);
  fuge_operator_free(&dense);
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(force[k], right[k], 1e-8);
}

enum { SIDE = 128, LARGE = SIDE * SIDE };

/* A ball on a free surface, or waves that repeat without end. */
static void make_large_gap(int boundary, double *gap) {
  const double pi = acos(-1.0);
  for (int k = 0; k < LARGE; k++) {
    const double x = (k % SIDE + 0.5) / SIDE - 0.5, y = (k / SIDE + 0.5) / SIDE - 0.5;
    gap[k] = x * x + y * y;
    if (boundary == FUGE_FREE) continue;
    gap[k] = 0.1;
    for (int wave = 1; wave < 40; wave += 2)
      gap[k] += 0.02 / wave * cos(2.0 * pi * (wave * x + (3 * wave % 29) * y) + wave * wave);
  }
}

/* Forces and gaps, one after the other, and the derivative of the forces. */
static void solve_large(const fuge_operator *op, const double *gap, int threads, double *result) {
  fuge_options options;
  fuge_solver *solver = NULL;
  fuge_default_options(&options);
  options.threads = threads;
  CHECK_DONE(fuge_solver_new(op, &options, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 0.05));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, result));
  CHECK_DONE(fuge_get_gap(solver, result + LARGE));
  CHECK_DONE(fuge_get_derivatives(solver, NULL, &ONE, result + 2 * LARGE, NULL, NULL));
  fuge_solver_free(&solver);
}

/* Any number of threads gives the same results, to the last bit. */
static void test_threads(int boundary) {
  static const int numbers[] = {2, 3, 5, 0};
  static double gap[LARGE], one[3 * LARGE], more[3 * LARGE];
  fuge_operator *op = NULL;
  make_large_gap(boundary, gap);
  CHECK_DONE(fuge_operator_halfspace(SIDE, SIDE, 1.0 / SIDE, 1.0 / SIDE, E_STAR, FUGE_MEAN, boundary, &op, NULL, 0));
  solve_large(op, gap, 1, one);
  for (int k = 0; k < 4; k++) {
    solve_large(op, gap, numbers[k], more);
    CHECK(memcmp(more, one, sizeof one) == 0);
  }
  fuge_operator_free(&op);
}

/* All boundaries give an operator, also with one row. */
static void test_boundaries(void) {
  for (int boundary = FUGE_FREE; boundary <= FUGE_PERIODIC_Y; boundary++)
    for (int ny = 1; ny <= 5; ny += 4) {
      fuge_operator *op = NULL;
      CHECK_DONE(fuge_operator_halfspace(6, ny, 1.0, 2.0, E_STAR, FUGE_MEAN, boundary, &op, NULL, 0));
      CHECK(op != NULL);
      fuge_operator_free(&op);
      CHECK(op == NULL);
    }
}

typedef struct bad_grid {
  int nx, ny;
  double spacing_x, spacing_y, e_star;
  int element, boundary, status;
  const char *part;
} bad_grid;

static const bad_grid BAD_GRIDS[] = {
  {0, 3, 1, 1, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_SIZE, "nx = 0"},
  {3, -1, 1, 1, 3, FUGE_MEAN, FUGE_PERIODIC, FUGE_ERR_SIZE, "ny = -1"},
  {65536, 65536, 1, 1, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_SIZE, "nx = 65536 times ny = 65536"},
  {INT_MAX, INT_MAX, 1, 1, 3, FUGE_MEAN, FUGE_PERIODIC, FUGE_ERR_SIZE, "points"},
  {INT_MAX, 1, 1, 1, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_MEMORY, "nx = 2147483647"},
  {4, 4, 0, 1, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_WIDTH, "spacing_x = 0"},
  {4, 4, 1, -0.5, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_WIDTH, "spacing_y = -0.5"},
  {4, 4, 1, NAN, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_NOT_FINITE, "spacing_y = NaN"},
  {4, 4, 1, 1, INFINITY, FUGE_MEAN, FUGE_FREE, FUGE_ERR_NOT_FINITE, "e_star = Inf"},
  {4, 4, 1, 1, 0, FUGE_MEAN, FUGE_FREE, FUGE_ERR_MODULUS, "e_star = 0"},
  {4, 4, 1e-200, 1e-200, 3, FUGE_MEAN, FUGE_FREE, FUGE_ERR_OVERFLOW, "spacing_x"},
  {4, 4, 1, 1, 3, FUGE_HAT, FUGE_FREE, FUGE_ERR_ELEMENT, "element = 2"},
  {4, 4, 1, 1, 3, FUGE_MEAN, FUGE_PERIODIC_Y + 1, FUGE_ERR_OPTION, "boundary = 4"}
};

/* *op stays as it was, the message says what is wrong. */
static void test_grid_refusals(void) {
  char place, message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  for (size_t k = 0; k < sizeof BAD_GRIDS / sizeof BAD_GRIDS[0]; k++) {
    const bad_grid *bad = &BAD_GRIDS[k];
    fuge_operator *op = before;
    strcpy(message, "not written");
    CHECK_STATUS(fuge_operator_halfspace(bad->nx, bad->ny, bad->spacing_x, bad->spacing_y, bad->e_star, bad->element,
                                         bad->boundary, &op, message, sizeof message), bad->status);
    CHECK(op == before);
    CHECK_CONTAINS(message, bad->part);
  }
  CHECK_STATUS(fuge_operator_halfspace(4, 4, 1, 1, 3, FUGE_MEAN, FUGE_FREE, NULL, message, sizeof message),
               FUGE_ERR_POINTER);
}

/* An error leaves problem and results as they were; a load that is set again gives the same forces. */
static void test_grid_problems(void) {
  double gap[CELLS], bad[CELLS], force[CELLS], again[CELLS], derivative[CELLS], approach, load, sum = 0.0;
  fuge_operator *op = NULL;
  fuge_solver *solver;
  char message[FUGE_MESSAGE_LENGTH + 1];
  for (int k = 0; k < CELLS; k++) {
    const int i = k % NX, j = k / NX;
    gap[k] = 0.05 * ((i - 3) * (i - 3) + (j - 4) * (j - 4));
    bad[k] = k == NX + 2 ? NAN : gap[k];
    derivative[k] = SENTINEL;
  }
  CHECK_DONE(fuge_operator_halfspace(NX, NY, 0.5, 0.75, E_STAR, FUGE_MEAN, FUGE_PERIODIC, &op, NULL, 0));
  solver = ball_on_grid(op, gap);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  CHECK_STATUS(fuge_set_gap(solver, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_set_gap(solver, bad, NULL), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(fuge_set_load(solver, -2.0), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_STATUS(fuge_set_load(solver, NAN), FUGE_ERR_NOT_FINITE);
  CHECK_DONE(fuge_get_derivatives(solver, NULL, &ONE, derivative, NULL, NULL));
  for (int k = 0; k < CELLS; k++) {
    CHECK(force[k] > 0.0 ? derivative[k] > 0.0 : derivative[k] == 0.0);
    sum += derivative[k];
  }
  CHECK_NEAR(sum, 1.0, 1e-12);
  CHECK_DONE(fuge_get_force(solver, again));
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(again[k], force[k], 0.0);
  CHECK_DONE(fuge_set_approach(solver, approach));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_resultant(solver, &load));
  CHECK_NEAR(load, 2.0, 1e-7);
  /* The mean gap is less than 1: nothing holds a periodic surface there. */
  CHECK_DONE(fuge_set_approach(solver, 2.0));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "periodic surface");
  CHECK_STATUS(fuge_get_force(solver, again), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, again));
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(again[k], force[k], 1e-8);
  /* No point can open by more than the ball has before it is pressed. */
  CHECK_DONE(fuge_set_gap(solver, gap, gap));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_gap(solver, again));
  for (int k = 0; k < CELLS; k++) CHECK(again[k] >= 0.0 && again[k] <= gap[k]);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

int main(void) {
  test_one_square();
  test_four_squares(FUGE_CENTRE);
  test_four_squares(FUGE_MEAN);
  test_folded();
  test_refusals();
  test_grid(FUGE_CENTRE);
  test_grid(FUGE_MEAN);
  test_threads(FUGE_FREE);
  test_threads(FUGE_PERIODIC);
  test_boundaries();
  test_grid_refusals();
  test_grid_problems();
  return check_summary();
}
