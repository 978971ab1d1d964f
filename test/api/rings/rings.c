/* Section "rings" of fuge_rings.h. */
#include "check.h"

enum { N = 3, LDA = 4 };
static const double PI = 3.14159265358979324, E_STAR = 3.0;
static const double RADIUS[N + 1] = {0.0, 1.0, 1.5, 4.0};

static int matrix(const double *radius, int element, double *alpha, char *message, size_t len) {
  return fuge_ring_matrix(N, radius, E_STAR, element, alpha, LDA, message, len);
}

/* A disc of radius 1 displaces itself by 16/(3 pi) f/(pi e_star) in the mean. */
static void test_matrix(void) {
  double alpha[LDA * N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(alpha, LDA * N);
  CHECK_MESSAGE(matrix(RADIUS, FUGE_MEAN, alpha, message, sizeof message), FUGE_DONE, message, "");
  CHECK_NEAR(alpha[0], 16.0 / (3.0 * PI * PI * E_STAR), 1e-16);
  for (int k = 0; k < N; k++) {
    CHECK_UNTOUCHED(alpha + N + LDA * k, 1);
    for (int i = 0; i < N; i++) CHECK_NEAR(alpha[i + LDA * k], alpha[k + LDA * i], 0.0);
  }
  CHECK(alpha[0] > alpha[1] && alpha[1] > alpha[2] && alpha[2] > 0.0);
}

/* In the middle of a disc under uniform pressure 2 f/(pi e_star), far away f/(pi e_star r). */
static void test_displacement(void) {
  const double force[N] = {2.0, 0.0, 0.0}, place[2] = {0.0, 1e9};
  double u[3];
  fill(u, 3);
  CHECK_DONE(fuge_ring_displacement(N, RADIUS, force, E_STAR, 2, place, u, NULL, 0));
  CHECK_NEAR(u[0], 4.0 / (PI * E_STAR), 1e-15);
  CHECK_NEAR(u[1], 2e-9 / (PI * E_STAR), 1e-24);
  CHECK_UNTOUCHED(u + 2, 1);
  CHECK_DONE(fuge_ring_displacement(N, RADIUS, force, E_STAR, 0, place, u, NULL, 0));
}

/* A sphere of radius 1 pressed to a contact of radius 0.5: the approach is 0.25. */
static void test_sphere(void) {
  enum { RINGS = 60 };
  static double alpha[RINGS * RINGS], radius[RINGS + 1], gap[RINGS], force[RINGS], opening[RINGS];
  const double load = 4.0 * E_STAR * 0.125 / 3.0;
  double approach;
  for (int k = 0; k <= RINGS; k++) radius[k] = (double)k / RINGS;
  for (int k = 0; k < RINGS; k++) gap[k] = 0.25 * (radius[k] * radius[k] + radius[k + 1] * radius[k + 1]);
  CHECK_DONE(fuge_ring_matrix(RINGS, radius, E_STAR, FUGE_MEAN, alpha, RINGS, NULL, 0));
  CHECK_DONE(fuge_solve_dense(RINGS, alpha, RINGS, gap, load, force, opening, &approach, NULL, 0));
  CHECK_NEAR(approach, 0.25, 1e-4);
}

static void test_refusals(void) {
  double alpha[LDA * N], u = SENTINEL;
  const double wrong[N + 1] = {0.0, 2.0, 1.5, 4.0}, force[N] = {1.0, 1.0, 1.0}, place = -1.0;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fill(alpha, LDA * N);
  CHECK_SAYS(matrix(wrong, FUGE_MEAN, alpha, message, sizeof message), FUGE_ERR_WIDTH, message, "radius(2)");
  CHECK_STATUS(matrix(RADIUS, FUGE_CENTRE, alpha, message, sizeof message), FUGE_ERR_GRID);
  CHECK_STATUS(matrix(RADIUS, FUGE_HAT, alpha, NULL, 0), FUGE_ERR_ELEMENT);
  CHECK_STATUS(matrix(NULL, FUGE_MEAN, alpha, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_matrix(N, RADIUS, E_STAR, FUGE_MEAN, NULL, LDA, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_matrix(0, RADIUS, E_STAR, FUGE_MEAN, alpha, LDA, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_ring_matrix(N, RADIUS, E_STAR, FUGE_MEAN, alpha, N - 1, NULL, 0), FUGE_ERR_SIZE);
  CHECK_UNTOUCHED(alpha, LDA * N);
  CHECK_SAYS(fuge_ring_displacement(N, RADIUS, force, E_STAR, 1, &place, &u, message, sizeof message),
             FUGE_ERR_WIDTH, message, "place(0)");
  CHECK_STATUS(fuge_ring_displacement(0, RADIUS, force, E_STAR, 1, &place, &u, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_ring_displacement(N, RADIUS, force, E_STAR, -1, &place, &u, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_ring_displacement(N, NULL, force, E_STAR, 1, &place, &u, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_displacement(N, RADIUS, NULL, E_STAR, 1, &place, &u, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_displacement(N, RADIUS, force, E_STAR, 1, NULL, &u, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_displacement(N, RADIUS, force, E_STAR, 1, &place, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&u, 1);
}

int main(void) {
  test_matrix();
  test_displacement();
  test_sphere();
  test_refusals();
  return check_summary();
}
