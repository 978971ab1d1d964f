/* Section "stresses of a half-space" of fuge_stress.h. */
#include "check.h"

enum { N = 4, POINTS = 3 };
static const double POISSON = 0.3, YOUNG = 2.5;
/* Four unit squares around the origin, of which two have no mirror image of the same force. */
static const double X[N] = {0.5, -0.5, 0.5, -0.5}, Y[N] = {0.5, 0.5, -0.5, -0.5}, ONES[N] = {1, 1, 1, 1};
static const double PX[POINTS] = {0.0, 0.3, -7.0}, PY[POINTS] = {0.0, -0.2, 2.0}, PZ[POINTS] = {0.0, 0.75, 1e-3};

static int stress_of(int n, const double *force, const double *pz, double *stress, char *message, size_t len) {
  return fuge_halfspace_stress(n, X, Y, ONES, ONES, force, POISSON, 0, 0, POINTS, PX, PY, pz, stress, message, len);
}

/* A square of side 2 under unit pressure: on the surface xx = yy = -(1 + 2 nu)/2, zz = -1, and the centre sinks by
 * 8 ln(1 + sqrt 2)/(pi E*). */
static void test_centre_of_a_square(void) {
  const double pi = acos(-1.0), root = sqrt(2.0);
  double stress[6 * POINTS], moved[3 * POINTS];
  char message[256] = "old";
  CHECK_MESSAGE(stress_of(N, ONES, PZ, stress, message, sizeof message), FUGE_DONE, message, "");
  CHECK_VALUES(stress, 1e-15, -0.8, -0.8, -1.0);
  for (int k = 3; k < 6; k++) CHECK_NEAR(stress[k], 0.0, 1e-15);
  CHECK_DONE(fuge_halfspace_displacement(N, X, Y, ONES, ONES, ONES, YOUNG, POISSON, 0, 0, POINTS, PX, PY, PZ, moved,
                                         message, sizeof message));
  CHECK_VALUES(moved, 1e-15, 0.0, 0.0);
  CHECK_NEAR(moved[2], 8.0 * log(1.0 + root) / pi * (1.0 - POISSON * POISSON) / YOUNG, 2e-15);
}

/* The forces of a quarter and of a half are sums over the images. */
static void test_folded(void) {
  const double whole[N] = {1, 1, 2, 2}, half[2] = {2, 4}, quarter = 4.0, half_x[2] = {0.5, 0.5},
    half_y[2] = {0.5, -0.5};
  double expected[6 * POINTS], found[6 * POINTS], moved[3 * POINTS], again[3 * POINTS];
  CHECK_DONE(stress_of(N, whole, PZ, expected, NULL, 0));
  CHECK_DONE(fuge_halfspace_stress(2, half_x, half_y, ONES, ONES, half, POISSON, 1, 0, POINTS, PX, PY, PZ, found, NULL,
                                   0));
  for (int k = 0; k < 6 * POINTS; k++) CHECK_NEAR(found[k], expected[k], 2e-15);
  CHECK_DONE(stress_of(N, ONES, PZ, expected, NULL, 0));
  CHECK_DONE(fuge_halfspace_stress(1, X, Y, ONES, ONES, &quarter, POISSON, 1, 1, POINTS, PX, PY, PZ, found, NULL, 0));
  for (int k = 0; k < 6 * POINTS; k++) CHECK_NEAR(found[k], expected[k], 2e-15);
  CHECK_DONE(fuge_halfspace_displacement(N, X, Y, ONES, ONES, whole, YOUNG, POISSON, 0, 0, POINTS, PX, PY, PZ, moved,
                                         NULL, 0));
  CHECK_DONE(fuge_halfspace_displacement(2, half_x, half_y, ONES, ONES, half, YOUNG, POISSON, 1, 0, POINTS, PX, PY, PZ,
                                         again, NULL, 0));
  for (int k = 0; k < 3 * POINTS; k++) CHECK_NEAR(again[k], moved[k], 2e-15);
}

/* No points are a valid request, no forces give zero. */
static void test_nothing(void) {
  const double zero[N] = {0, 0, 0, 0};
  double stress[6 * POINTS];
  fill(stress, 6 * POINTS);
  CHECK_DONE(fuge_halfspace_stress(N, X, Y, ONES, ONES, ONES, POISSON, 0, 0, 0, PX, PY, PZ, stress, NULL, 0));
  CHECK_UNTOUCHED(stress, 6 * POINTS);
  CHECK_DONE(stress_of(N, zero, PZ, stress, NULL, 0));
  for (int k = 0; k < 6 * POINTS; k++) CHECK_NEAR(stress[k], 0.0, 0.0);
}

/* Indices in messages count from 0. */
static void test_refusals(void) {
  const double above[POINTS] = {0, 1, -0.5}, nan[POINTS] = {0, NAN, 1}, flat[N] = {1, 0, 1, 1};
  double stress[6 * POINTS];
  char message[256];
  fill(stress, 6 * POINTS);
  CHECK_STATUS(stress_of(0, ONES, PZ, stress, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_MESSAGE(stress_of(N, NULL, PZ, stress, message, sizeof message), FUGE_ERR_POINTER, message, "force is NULL");
  CHECK_MESSAGE(stress_of(N, ONES, NULL, stress, message, sizeof message), FUGE_ERR_POINTER, message, "pz is NULL");
  CHECK_STATUS(stress_of(N, ONES, PZ, NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_SAYS(stress_of(N, ONES, above, stress, message, sizeof message), FUGE_ERR_GRID, message, "pz(2) = -0.5");
  CHECK_SAYS(stress_of(N, ONES, nan, stress, message, sizeof message), FUGE_ERR_NOT_FINITE, message, "pz(1) = NaN");
  CHECK_SAYS(fuge_halfspace_stress(N, X, Y, ONES, flat, ONES, POISSON, 0, 0, POINTS, PX, PY, PZ, stress, message,
                                   sizeof message), FUGE_ERR_WIDTH, message, "width_y(1) = 0.");
  CHECK_STATUS(fuge_halfspace_stress(N, X, Y, ONES, ONES, ONES, 0.6, 0, 0, POINTS, PX, PY, PZ, stress, message,
                                     sizeof message), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_halfspace_stress(N, X, Y, ONES, ONES, ONES, POISSON, 0, 0, -1, PX, PY, PZ, stress, message,
                                     sizeof message), FUGE_ERR_SIZE);
  CHECK_SAYS(fuge_halfspace_stress(N, X, Y, ONES, ONES, ONES, POISSON, 1, 0, POINTS, PX, PY, PZ, stress, message,
                                   sizeof message), FUGE_ERR_WIDTH, message, "x(1) = -0.5");
  CHECK_STATUS(fuge_halfspace_displacement(N, X, Y, ONES, ONES, ONES, 0.0, POISSON, 0, 0, POINTS, PX, PY, PZ, stress,
                                           message, sizeof message), FUGE_ERR_MODULUS);
  CHECK_UNTOUCHED(stress, 6 * POINTS);
}

int main(void) {
  test_centre_of_a_square();
  test_folded();
  test_nothing();
  test_refusals();
  return check_summary();
}
