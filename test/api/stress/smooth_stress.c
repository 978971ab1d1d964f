/* Smooth punches in the section "stresses of a half-plane" of fuge_stress.h. */
#include "check.h"

enum { POINTS = 3 };
static const double YOUNG = 3.0, POISSON = 0.25, FORCE = 0.7;

static int parabola(int n, const double *x, double *gap, double *slope, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) {
    gap[k] = x[k] * x[k];
    slope[k] = 2.0 * x[k];
  }
  return 0;
}

static fuge_smooth *solved(double force) {
  fuge_smooth *contact = NULL;
  CHECK_DONE(fuge_solve_smooth_punch(parabola, NULL, -5.0, 5.0, YOUNG, force, NULL, &contact, NULL, 0));
  return contact;
}

/* On the axis zz = -p0 a/sqrt(a^2 + z^2); at the surface -p. */
static void test_cylinder(void) {
  fuge_smooth *contact = solved(FORCE);
  fuge_smooth_report report;
  double x[POINTS], z[POINTS], stress[3 * POINTS + 1], displacement[2 * POINTS + 1], pressure[POINTS];
  CHECK_DONE(fuge_smooth_get_report(contact, &report, NULL, 0));
  const double a = report.half_width;
  x[0] = 0.0; x[1] = 0.5 * a; x[2] = 2.0 * a;
  z[0] = 0.8 * a; z[1] = z[2] = 0.0;
  CHECK_DONE(fuge_smooth_get_pressure(contact, POINTS, x, pressure, NULL, 0));
  fill(stress, 3 * POINTS + 1);
  CHECK_DONE(fuge_smooth_stress(contact, POINTS, x, z, stress, NULL, 0));
  CHECK_NEAR(stress[1], -pressure[0] / sqrt(1.64), 1e-14);
  CHECK_NEAR(stress[0], -pressure[0] * pow(sqrt(1.64) - 0.8, 2) / sqrt(1.64), 1e-14);
  CHECK_NEAR(stress[3], -pressure[1], 1e-14);
  CHECK_NEAR(stress[4], -pressure[1], 1e-14);
  for (int k = 5; k < 9; k++) CHECK_NEAR(stress[k], 0.0, 0.0);
  CHECK_UNTOUCHED(stress + 3 * POINTS, 1);
  fill(displacement, 2 * POINTS + 1);
  CHECK_DONE(fuge_smooth_displacement(contact, YOUNG, POISSON, FUGE_PLANE_STRESS, POINTS, x, z, displacement, NULL, 0));
  CHECK_NEAR(displacement[0], 0.0, 1e-15);
  CHECK_NEAR(displacement[3], report.approach - x[1] * x[1], 1e-13);
  CHECK_NEAR(displacement[4], -(1.0 - POISSON) / (2.0 * YOUNG) * FORCE, 1e-14);
  CHECK_UNTOUCHED(displacement + 2 * POINTS, 1);
  fuge_smooth_free(&contact);
}

static void test_no_force(void) {
  fuge_smooth *contact = solved(0.0);
  const double x = 0.5, z = 0.5;
  double stress[3];
  CHECK_DONE(fuge_smooth_stress(contact, 1, &x, &z, stress, NULL, 0));
  for (int k = 0; k < 3; k++) CHECK_NEAR(stress[k], 0.0, 0.0);
  CHECK_DONE(fuge_smooth_stress(contact, 0, &x, &z, stress, NULL, 0));
  fuge_smooth_free(&contact);
}

static void check_refusal(const fuge_smooth *contact, int points, const double *x, const double *z, int status,
                          const char *part) {
  double result[3];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  fill(result, 3);
  CHECK_SAYS(fuge_smooth_stress(contact, points, x, z, result, message, sizeof message), status, message, part);
  CHECK_SAYS(fuge_smooth_displacement(contact, YOUNG, POISSON, FUGE_PLANE_STRAIN, points, x, z, result, message,
                                      sizeof message), status, message, part);
  CHECK_UNTOUCHED(result, 3);
}

static void test_refusals(void) {
  fuge_smooth *contact = solved(FORCE);
  const double x = 0.5, above = -0.5;
  double result[3];
  check_refusal(NULL, 1, &x, &x, FUGE_ERR_POINTER, "contact is NULL");
  check_refusal(contact, 1, NULL, &x, FUGE_ERR_POINTER, "px is NULL");
  check_refusal(contact, 1, &x, NULL, FUGE_ERR_POINTER, "pz is NULL");
  check_refusal(contact, -1, &x, &x, FUGE_ERR_SIZE, "points = -1");
  check_refusal(contact, 1, &x, &above, FUGE_ERR_GRID, "pz(0) = -0.5");
  CHECK_STATUS(fuge_smooth_stress(contact, 1, &x, &x, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_smooth_displacement(contact, YOUNG, POISSON, FUGE_PLANE_STRAIN, 1, &x, &x, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  fill(result, 3);
  CHECK_STATUS(fuge_smooth_displacement(contact, YOUNG, 0.6, FUGE_PLANE_STRAIN, 1, &x, &x, result, NULL, 0),
               FUGE_ERR_MODULUS);
  CHECK_UNTOUCHED(result, 3);
  fuge_smooth_free(&contact);
}

int main(void) {
  test_cylinder();
  test_no_force();
  test_refusals();
  return check_summary();
}
