/* Sections "round punches" and "contacts of punches" of fuge_punches.h; smooth.c has what its getters refuse. */
#include "check.h"

static const double PI = 3.14159265358979324;

/* x^2 times what user points to; returns 5 beyond x = 10. */
static int paraboloid(int n, const double *x, double *gap, double *slope, void *user) {
  const double factor = *(const double *)user;
  for (int k = 0; k < n; k++) {
    if (x[k] > 10.0) return 5;
    gap[k] = factor * x[k] * x[k];
    slope[k] = 2.0 * factor * x[k];
  }
  return 0;
}

/* A ring touches first; user is allowed to be NULL. */
static int dimpled(int n, const double *x, double *gap, double *slope, void *user) {
  CHECK(user == NULL);
  for (int k = 0; k < n; k++) {
    gap[k] = x[k] * x[k] * (x[k] * x[k] - 1.0);
    slope[k] = 2.0 * x[k] * (2.0 * x[k] * x[k] - 1.0);
  }
  return 0;
}

/* Hertz, R = 1/(2 factor): a = 0.6 under the load 4 e_star a^3/(3 R). */
static void test_sphere(void) {
  double factor = 0.25;
  const double a = 0.6, load = 4.0 * 3.0 * 0.216 / 6.0;
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  double r[3] = {0.0, 0.3, 1.2}, gap[3], pressure[3], coefficients[3];
  CHECK_MESSAGE(fuge_solve_round_punch(paraboloid, &factor, 3.0, 3.0, &load, NULL, NULL, &contact, message,
                                       sizeof message), FUGE_DONE, message, "");
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.half_width, a, 1e-14);
  CHECK_NEAR(report.left, -report.half_width, 0.0);
  CHECK_NEAR(report.right, report.half_width, 0.0);
  CHECK_NEAR(report.force, load, 0.0);
  CHECK_NEAR(report.moment, 0.0, 0.0);
  CHECK_NEAR(report.tilt, 0.0, 0.0);
  CHECK_NEAR(report.approach, 0.18, 1e-14);
  CHECK_NEAR(report.residual, 0.0, 1e-12);
  CHECK_NEAR(report.end_error, 0.0, 1e-12);
  CHECK_NEAR(report.pressure_error, 0.0, 1e-12);
  CHECK(report.iterations > 0 && report.coefficients > 0 && report.coefficients < 8);
  CHECK_DONE(fuge_punch_get_pressure(contact, 3, r, pressure, NULL, 0));
  CHECK_VALUES(pressure, 1e-13, 1.5 * load / (PI * a * a), 1.5 * load / (PI * a * a) * sqrt(0.75));
  CHECK_NEAR(pressure[2], 0.0, 0.0);
  for (int k = 0; k < 3; k++) gap[k] = factor * r[k] * r[k];
  CHECK_DONE(fuge_punch_get_gap(contact, 3, r, gap, gap, NULL, 0));
  CHECK_NEAR(gap[1], 0.0, 0.0);
  CHECK_NEAR(gap[2], 0.36 - 0.18 + 0.36 * (-2.0 * PI / 6.0 + sqrt(3.0)) / (2.0 * PI), 1e-13);
  fill(coefficients, 3);
  CHECK_DONE(fuge_punch_get_coefficients(contact, 1, coefficients, NULL, 0));
  CHECK(coefficients[0] > 0.0);
  CHECK_UNTOUCHED(coefficients + 1, 2);
  fuge_punch_free(&contact);
}

/* A cone by its approach: a = 2 approach/(pi slope); r^1.5 by its radius. */
static void test_powers(void) {
  const double factor[2] = {0.1, 0.0}, powers[2] = {1.0, 1.5}, approach = 0.02, radius = 0.5, one = 1.0;
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  double r = 0.0, pressure;
  CHECK_DONE(fuge_solve_round_powers(1, factor, powers, NULL, 3.0, 3.0, NULL, &approach, NULL, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.half_width, 0.4 / PI, 1e-14);
  CHECK_NEAR(report.approach, approach, 0.0);
  CHECK_DONE(fuge_punch_get_pressure(contact, 1, &r, &pressure, NULL, 0));
  CHECK(pressure > 1e300);
  fuge_punch_free(&contact);
  CHECK_DONE(fuge_solve_round_powers(1, &one, powers + 1, NULL, 3.0, 3.0, NULL, NULL, &radius, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.half_width, radius, 0.0);
  CHECK_NEAR(report.force, 2.0 * 3.0 * 1.5 / 2.5 * report.approach * radius, 1e-13);
  fuge_punch_free(&contact);
}

/* A flat end of radius b with a rounded edge: with cos(theta) = b/a the approach is 2 a^2 c (sin(theta) - theta
 * cos(theta)). */
static void test_edge(void) {
  const double factor = 0.25, power = 2.0, start = 0.5, radius = 1.0, wrong = 1.5, theta = acos(0.5);
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  CHECK_DONE(fuge_solve_round_powers(1, &factor, &power, &start, 3.0, 3.0, NULL, NULL, &radius, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.approach, 0.5 * (sin(theta) - theta * cos(theta)), 1e-15);
  fuge_punch_free(&contact);
  CHECK_STATUS(fuge_solve_round_powers(1, &factor, &wrong, &start, 3.0, 3.0, NULL, NULL, &radius, &contact, NULL, 0),
               FUGE_ERR_WIDTH);
}

static void test_no_load(void) {
  double factor = 1.0;
  const double none = 0.0;
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  CHECK_DONE(fuge_solve_round_punch(paraboloid, &factor, 3.0, 3.0, &none, NULL, NULL, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.half_width, 0.0, 0.0);
  CHECK_INT(report.coefficients, 0);
  fuge_punch_free(&contact);
}

static void test_refusals(void) {
  double factor = 1.0;
  const double load = 0.01, negative = -1.0, half = 0.5;
  fuge_punch *contact = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_SAYS(fuge_solve_round_punch(dimpled, NULL, 2.0, 1.0, &load, NULL, NULL, &contact, message, sizeof message),
             FUGE_ERR_UNSUPPORTED, message, "fuge_ring_matrix");
  CHECK_SAYS(fuge_solve_round_punch(paraboloid, &factor, 20.0, 1.0, &load, NULL, NULL, &contact, message,
                                    sizeof message), FUGE_ERR_CALLBACK, message, "status 5");
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 2.0, 1.0, NULL, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 2.0, 1.0, &load, &load, NULL, &contact, NULL, 0),
               FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 0.0, 1.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 2.0, 0.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 2.0, 1.0, &negative, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_STATUS(fuge_solve_round_punch(NULL, &factor, 2.0, 1.0, &load, NULL, NULL, &contact, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_round_punch(paraboloid, &factor, 2.0, 1.0, &load, NULL, NULL, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_round_powers(1, &factor, &half, NULL, 2.0, 1.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_solve_round_powers(0, &factor, &half, NULL, 2.0, 1.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_solve_round_powers(1, NULL, &half, NULL, 2.0, 1.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_round_powers(1, &factor, NULL, NULL, 2.0, 1.0, &load, NULL, NULL, &contact, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK(contact == NULL);
}

int main(void) {
  test_sphere();
  test_powers();
  test_edge();
  test_no_load();
  test_refusals();
  return check_summary();
}
