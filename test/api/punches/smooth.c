/* Sections "smooth punches" and "contacts of punches" of fuge_punches.h. */
#include "check.h"

static const double PI = 3.14159265358979324;

/* What the callback sees as user. */
typedef struct punch {
  double curvature;
  int calls;
  int returns; /* what to return */
  int forget;  /* leave the slope of the last place out */
  int overwrite;
} punch;

static int parabola(int n, const double *x, double *gap, double *slope, void *user) {
  punch *p = user;
  p->calls++;
  for (int k = 0; k < n; k++) {
    gap[k] = 0.5 * p->curvature * x[k] * x[k];
    if (!p->forget || k < n - 1) slope[k] = p->curvature * x[k];
  }
  if (p->overwrite)
    for (int k = 0; k < n; k++) ((double *)x)[k] = 1e9;
  return p->returns;
}

/* User is allowed to be NULL. */
static int two_wells(int n, const double *x, double *gap, double *slope, void *user) {
  CHECK(user == NULL);
  for (int k = 0; k < n; k++) {
    gap[k] = x[k] * x[k] * (x[k] * x[k] - 1.0);
    slope[k] = 2.0 * x[k] * (2.0 * x[k] * x[k] - 1.0);
  }
  return 0;
}

static void test_cylinder(void) {
  punch p = {2.0, 0, 0, 0, 1};
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  const double a = sqrt(4.0 * 0.7 / (2.0 * PI * 3.0));
  double x[3], gap[3], pressure[3], coefficients[3];
  CHECK_MESSAGE(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, message, sizeof message),
                FUGE_DONE, message, "");
  CHECK(p.calls > 0);
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.left, -a, 1e-12);
  CHECK_NEAR(report.right, a, 1e-12);
  CHECK_NEAR(report.half_width, a, 1e-12);
  CHECK_NEAR(report.force, 0.7, 0.0);
  CHECK_NEAR(report.moment, 0.0, 1e-14);
  CHECK_NEAR(report.tilt, 0.0, 0.0);
  CHECK_NEAR(report.approach, 2.0 * 0.7 / (PI * 3.0) * (log(20.0 / a) + 0.5), 1e-12);
  CHECK_NEAR(report.residual, 0.0, 1e-12);
  CHECK_NEAR(report.pressure_error, 0.0, 1e-12);
  CHECK_NEAR(report.end_error, 0.0, 1e-12);
  CHECK(report.iterations > 0 && report.coefficients > 0 && report.coefficients < 8);
  x[0] = 0.0; x[1] = 0.5 * a; x[2] = -2.0 * a;
  for (int k = 0; k < 3; k++) gap[k] = x[k] * x[k];
  CHECK_DONE(fuge_punch_get_pressure(contact, 3, x, pressure, NULL, 0));
  CHECK_VALUES(pressure, 1e-12, 3.0 * a, 3.0 * sqrt(0.75) * a);
  CHECK_NEAR(pressure[2], 0.0, 0.0);
  CHECK_DONE(fuge_punch_get_gap(contact, 3, x, gap, gap, NULL, 0));
  CHECK_NEAR(gap[1], 0.0, 0.0);
  CHECK_NEAR(gap[2], a * a * (2.0 * sqrt(3.0) - acosh(2.0)), 1e-12);
  fill(coefficients, 3);
  CHECK_DONE(fuge_punch_get_coefficients(contact, 1, coefficients, NULL, 0));
  CHECK_NEAR(coefficients[0], 3.0 * a, 1e-12);
  CHECK_UNTOUCHED(coefficients + 1, 2);
  CHECK_DONE(fuge_punch_get_pressure(contact, 0, x, pressure, NULL, 0));
  fuge_punch_free(&contact);
  CHECK(contact == NULL);
  fuge_punch_free(&contact);
  fuge_punch_free(NULL);
}

static void test_tilt(void) {
  punch p = {2.0, 0, 0, 0, 0};
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  const double moment = 0.7 * 0.25;
  CHECK_DONE(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, &moment, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(0.5 * (report.left + report.right), 0.25, 1e-12);
  CHECK_NEAR(report.tilt, 0.5, 1e-12);
  CHECK_NEAR(report.moment, moment, 0.0);
  fuge_punch_free(&contact);
}

static void test_no_force(void) {
  punch p = {2.0, 0, 0, 0, 0};
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  const double x = 1.0, moment = 0.0;
  double value = -1.0;
  CHECK_DONE(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.0, NULL, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.left, report.right, 0.0);
  CHECK_INT(report.coefficients, 0);
  CHECK_DONE(fuge_punch_get_pressure(contact, 1, &x, &value, NULL, 0));
  CHECK_NEAR(value, 0.0, 0.0);
  value = SENTINEL;
  CHECK_DONE(fuge_punch_get_coefficients(contact, 1, &value, NULL, 0));
  CHECK_UNTOUCHED(&value, 1);
  fuge_punch_free(&contact);
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.0, &moment, &contact, NULL, 0),
               FUGE_WARN_NOT_UNIQUE);
  fuge_punch_free(&contact);
}

static void test_refusals(void) {
  punch p = {2.0, 0, 0, 0, 0};
  fuge_punch *contact = NULL;
  fuge_punch_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  const double x = 0.0;
  double value = SENTINEL;
  CHECK_SAYS(fuge_solve_smooth_punch(two_wells, NULL, -2.0, 2.0, 1.0, 0.01, NULL, &contact, message, sizeof message),
             FUGE_ERR_UNSUPPORTED, message, "FUGE_ITERATIVE");
  p.returns = 5;
  CHECK_SAYS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, message, sizeof message),
             FUGE_ERR_CALLBACK, message, "status 5");
  p.returns = FUGE_ERR_MEMORY;
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, NULL, 0), FUGE_ERR_CALLBACK);
  p.returns = 0;
  p.forget = 1;
  CHECK_SAYS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, message, sizeof message),
             FUGE_ERR_CALLBACK, message, "slope");
  p.forget = 0;
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, 3.0, 3.0, 3.0, 0.7, NULL, &contact, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 0.0, 0.7, NULL, &contact, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, -1.0, NULL, &contact, NULL, 0),
               FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_STATUS(fuge_solve_smooth_punch(NULL, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK(contact == NULL);
  CHECK_STATUS(fuge_punch_get_report(NULL, &report, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_punch_get_pressure(NULL, 1, &x, &value, NULL, 0), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_solve_smooth_punch(parabola, &p, -2.0, 3.0, 3.0, 0.7, NULL, &contact, NULL, 0));
  CHECK_STATUS(fuge_punch_get_report(contact, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_punch_get_pressure(contact, -1, &x, &value, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_punch_get_pressure(contact, 1, NULL, &value, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_punch_get_gap(contact, 1, &x, NULL, &value, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_punch_get_gap(contact, -1, &x, &x, &value, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_punch_get_coefficients(contact, -1, &value, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_punch_get_coefficients(contact, 1, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&value, 1);
  fuge_punch_free(&contact);
}

int main(void) {
  test_cylinder();
  test_tilt();
  test_no_force();
  test_refusals();
  return check_summary();
}
