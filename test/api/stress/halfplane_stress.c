/* Cells in the section "stresses of a half-plane" of fuge_stress.h. */
#include "check.h"

enum { N = 3, POINTS = 4 };
static const double PI = 3.14159265358979323846;
static const double X[N] = {0.5, 1.5, 2.5}, WIDTH[N] = {1.0, 1.0, 1.0}, FORCE[N] = {2.0, 0.0, 3.0};
static const double PX[POINTS] = {0.5, 1.0, 2.75, -1.5}, PZ[POINTS] = {0.75, 0.0, 0.0, 4.0};
static const double YOUNG = 2.0, POISSON = 0.25;

/* Stresses zz and xx on the axis of one strip: -(p/pi)(a +- sin a), a the angle of view. */
static void test_one_strip(void) {
  const double angle = 2.0 * atan(0.5 / 0.75);
  double stress[3], z = 0.75;
  CHECK_DONE(fuge_halfplane_stress(1, X, WIDTH, FORCE, FUGE_MEAN, 0, 1, X, &z, stress, NULL, 0));
  CHECK_VALUES(stress, 1e-15, -2.0 / PI * (angle - sin(angle)), -2.0 / PI * (angle + sin(angle)));
  CHECK_NEAR(stress[2], 0.0, 0.0);
}

/* The pressure, its mean at an end, and order in memory. */
static void test_surface(void) {
  double stress[3 * POINTS + 1];
  fill(stress, 3 * POINTS + 1);
  CHECK_DONE(fuge_halfplane_stress(N, X, WIDTH, FORCE, FUGE_CENTRE, 0, POINTS, PX, PZ, stress, NULL, 0));
  for (int k = 0; k < 2; k++) {
    CHECK_NEAR(stress[3 + k], -1.0, 1e-15);
    CHECK_NEAR(stress[6 + k], -3.0, 1e-15);
  }
  CHECK_NEAR(stress[5], 0.0, 0.0);
  CHECK_UNTOUCHED(stress + 3 * POINTS, 1);
  CHECK_DONE(fuge_halfplane_stress(N, X, WIDTH, FORCE, FUGE_HAT, 0, POINTS, PX, PZ, stress, NULL, 0));
  CHECK_NEAR(stress[3], -1.0, 1e-15);
  CHECK_NEAR(stress[7], -0.75 * 3.0, 1e-15);
}

/* Half a force on a cell and half on its image. */
static void test_symmetric(void) {
  const double both_x[2] = {0.5, -0.5}, half[2] = {1.0, 1.0};
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++) {
    double folded[3 * POINTS], whole[3 * POINTS], folded_motion[2 * POINTS], motion[2 * POINTS];
    CHECK_DONE(fuge_halfplane_stress(1, X, WIDTH, FORCE, element, 1, POINTS, PX, PZ, folded, NULL, 0));
    CHECK_DONE(fuge_halfplane_stress(2, both_x, WIDTH, half, element, 0, POINTS, PX, PZ, whole, NULL, 0));
    for (int k = 0; k < 3 * POINTS; k++) CHECK_NEAR(folded[k], whole[k], 1e-15);
    CHECK_DONE(fuge_halfplane_displacement(1, X, WIDTH, FORCE, element, YOUNG, POISSON, FUGE_PLANE_STRESS, 1, POINTS,
                                           PX, PZ, folded_motion, NULL, 0));
    CHECK_DONE(fuge_halfplane_displacement(2, both_x, WIDTH, half, element, YOUNG, POISSON, FUGE_PLANE_STRESS, 0,
                                           POINTS, PX, PZ, motion, NULL, 0));
    for (int k = 0; k < 2 * POINTS; k++) CHECK_NEAR(folded_motion[k], motion[k], 2e-15);
  }
}

/* At the centres, at the surface: the influence matrix times the forces. */
static void test_displacement_of_the_matrix(void) {
  const double zero[N] = {0.0, 0.0, 0.0};
  double alpha[N * N], modulus, displacement[2 * N];
  CHECK_DONE(fuge_plane_modulus(YOUNG, POISSON, FUGE_PLANE_STRAIN, &modulus, NULL, 0));
  CHECK_DONE(fuge_halfplane_matrix(N, X, WIDTH, modulus, FUGE_HAT, 0, alpha, N, NULL, 0));
  CHECK_DONE(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_HAT, YOUNG, POISSON, FUGE_PLANE_STRAIN, 0, N, X, zero,
                                         displacement, NULL, 0));
  for (int i = 0; i < N; i++) {
    double expected = 0.0;
    for (int k = 0; k < N; k++) expected += alpha[i + k * N] * FORCE[k];
    CHECK_NEAR(displacement[2 * i + 1], expected, 1e-14);
  }
}

static void test_no_points(void) {
  double stress[1];
  fill(stress, 1);
  CHECK_DONE(fuge_halfplane_stress(N, X, WIDTH, FORCE, FUGE_MEAN, 0, 0, PX, PZ, stress, NULL, 0));
  CHECK_UNTOUCHED(stress, 1);
}

static void check_refusal(int n, const double *x, const double *force, int points, const double *px, const double *pz,
                          int element, int status, const char *part) {
  for (int folded = 0; folded < 2; folded++) {
    double result[3 * POINTS];
    char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
    fill(result, 3 * POINTS);
    CHECK_SAYS(fuge_halfplane_stress(n, x, WIDTH, force, element, folded, points, px, pz, result, message,
                                     sizeof message), status, message, part);
    CHECK_SAYS(fuge_halfplane_displacement(n, x, WIDTH, force, element, YOUNG, POISSON, FUGE_PLANE_STRAIN, folded,
                                           points, px, pz, result, message, sizeof message), status, message, part);
    CHECK_UNTOUCHED(result, 3 * POINTS);
  }
}

static void test_refusals(void) {
  const double above[POINTS] = {0.0, 1.0, -0.5, 0.0}, bad[N] = {1.0, NAN, 1.0};
  check_refusal(0, X, FORCE, POINTS, PX, PZ, FUGE_MEAN, FUGE_ERR_SIZE, "n = 0");
  check_refusal(N, X, FORCE, -1, PX, PZ, FUGE_MEAN, FUGE_ERR_SIZE, "points = -1");
  check_refusal(N, NULL, FORCE, POINTS, PX, PZ, FUGE_MEAN, FUGE_ERR_POINTER, "x is NULL");
  check_refusal(N, X, NULL, POINTS, PX, PZ, FUGE_MEAN, FUGE_ERR_POINTER, "force is NULL");
  check_refusal(N, X, FORCE, POINTS, NULL, PZ, FUGE_MEAN, FUGE_ERR_POINTER, "px is NULL");
  check_refusal(N, X, FORCE, POINTS, PX, NULL, FUGE_MEAN, FUGE_ERR_POINTER, "pz is NULL");
  check_refusal(N, X, bad, POINTS, PX, PZ, FUGE_MEAN, FUGE_ERR_NOT_FINITE, "force(1)");
  check_refusal(N, X, FORCE, POINTS, PX, above, FUGE_MEAN, FUGE_ERR_GRID, "pz(2) = -0.5");
  check_refusal(N, X, FORCE, POINTS, PX, PZ, FUGE_HAT + 1, FUGE_ERR_ELEMENT, "element = 3");
  for (int folded = 0; folded < 2; folded++) {
    CHECK_STATUS(fuge_halfplane_stress(N, X, WIDTH, FORCE, FUGE_MEAN, folded, POINTS, PX, PZ, NULL, NULL, 0),
                 FUGE_ERR_POINTER);
    CHECK_STATUS(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_MEAN, YOUNG, POISSON, FUGE_PLANE_STRAIN, folded,
                                             POINTS, PX, PZ, NULL, NULL, 0), FUGE_ERR_POINTER);
  }
}

static void test_materials(void) {
  double displacement[2 * POINTS];
  fill(displacement, 2 * POINTS);
  CHECK_STATUS(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_MEAN, 0.0, POISSON, FUGE_PLANE_STRAIN, 0, POINTS,
                                           PX, PZ, displacement, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_MEAN, YOUNG, 0.6, FUGE_PLANE_STRAIN, 0, POINTS, PX,
                                           PZ, displacement, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_MEAN, YOUNG, POISSON, 7, 0, POINTS, PX, PZ,
                                           displacement, NULL, 0), FUGE_ERR_OPTION);
  CHECK_UNTOUCHED(displacement, 2 * POINTS);
  CHECK_DONE(fuge_halfplane_displacement(N, X, WIDTH, FORCE, FUGE_MEAN, INFINITY, POISSON, FUGE_PLANE_STRAIN, 0, POINTS,
                                         PX, PZ, displacement, NULL, 0));
  for (int k = 0; k < 2 * POINTS; k++) CHECK_NEAR(displacement[k], 0.0, 0.0);
}

int main(void) {
  test_one_strip();
  test_surface();
  test_symmetric();
  test_displacement_of_the_matrix();
  test_no_points();
  test_refusals();
  test_materials();
  return check_summary();
}
