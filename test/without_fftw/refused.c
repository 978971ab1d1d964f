/* A library without FFTW: what needs transforms refuses, says why, and leaves its outputs alone; a matrix is solved. */
#include "check.h"

enum { N = 4 };
static const char *REASON = "this library was built without FFTW (FUGE_WITH_FFTW=OFF)";

static void test_operators(void) {
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *op = NULL;

  CHECK_STATUS(fuge_operator_halfplane(N, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &op, message, sizeof message),
               FUGE_ERR_UNSUPPORTED);
  CHECK_CONTAINS(message, REASON);
  CHECK_CONTAINS(message, "build it with FFTW, or use a matrix");
  CHECK(op == NULL);
  CHECK_STATUS(fuge_operator_halfspace(N, N, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_PERIODIC, &op, message, sizeof message),
               FUGE_ERR_UNSUPPORTED);
  CHECK_CONTAINS(message, REASON);
  CHECK(op == NULL);
  /* What is wrong for any library comes first. */
  CHECK_STATUS(fuge_operator_halfplane(0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &op, message, sizeof message),
               FUGE_ERR_SIZE);
}

static void test_stress_grids(void) {
  const double force[N] = {1.0, 2.0, 0.0, 1.0};
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_field *field = NULL;

  CHECK_SAYS(fuge_field_halfplane_grid(N, 1.0, force, FUGE_MEAN, FUGE_FREE, 1.0, 0.3, FUGE_PLANE_STRAIN, &field,
                                       message, sizeof message), FUGE_ERR_UNSUPPORTED, message, REASON);
  CHECK_SAYS(fuge_field_halfspace_grid(2, 2, 1.0, 1.0, force, FUGE_FREE, 1.0, 0.3, &field, message, sizeof message),
             FUGE_ERR_UNSUPPORTED, message, REASON);
  CHECK(field == NULL);
}

/* A matrix of the half-plane by the engine that needs products only. */
static void test_iteration(void) {
  const double x[N] = {0.0, 1.0, 2.0, 3.0}, width[N] = {1.0, 1.0, 1.0, 1.0}, gap[N] = {0.0, 0.0, 0.0, 5.0};
  double alpha[N * N], force[N], dense[N], open[N], approach;
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  fuge_options options;

  CHECK_STATUS(fuge_halfplane_matrix(N, x, width, 1.0, FUGE_MEAN, 0, alpha, N, message, sizeof message), FUGE_DONE);
  CHECK_STATUS(fuge_solve_dense(N, alpha, N, gap, 1.0, dense, open, &approach, message, sizeof message), FUGE_DONE);
  CHECK_STATUS(fuge_operator_dense(N, alpha, N, &op, message, sizeof message), FUGE_DONE);
  fuge_default_options(&options);
  options.method = FUGE_ITERATIVE;
  CHECK_STATUS(fuge_solver_new(op, &options, &solver, message, sizeof message), FUGE_DONE);
  CHECK_STATUS(fuge_set_gap(solver, gap, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_set_load(solver, 1.0), FUGE_DONE);
  CHECK_STATUS(fuge_solve(solver), FUGE_DONE);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_DONE);
  for (int k = 0; k < N; k++) CHECK_NEAR(force[k], dense[k], 1e-7);
  CHECK_NEAR(dense[3], 0.0, 0.0);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

int main(void) {
  test_operators();
  test_stress_grids();
  test_iteration();
  return check_summary();
}
