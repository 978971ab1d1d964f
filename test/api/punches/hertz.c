/* Section "Hertz" of fuge_punches.h. */
#include "check.h"

static void test_sphere(void) {
  const double radius = 10.0, e_star = 1.1e5, load = 40.0, a = cbrt(0.75 * load * radius / e_star);
  double axis_x, axis_y, approach, peak;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_MESSAGE(fuge_hertz_ellipse(radius, radius, e_star, load, &axis_x, &axis_y, &approach, &peak, message,
                                   sizeof message), FUGE_DONE, message, "");
  CHECK_NEAR(axis_x, a, 1e-14 * a);
  CHECK_NEAR(axis_y, axis_x, 0.0);
  CHECK_NEAR(approach, a * a / radius, 1e-14 * a * a / radius);
  CHECK_NEAR(peak, 1.5 * load / (acos(-1.0) * a * a), 1e-14 * peak);
}

/* The longer axis lies in the direction of the greater radius. */
static void test_ellipse(void) {
  double axis_x, axis_y, peak;
  CHECK_DONE(fuge_hertz_ellipse(10.0, 1.0, 1.0, 1.0, &axis_x, &axis_y, NULL, &peak, NULL, 0));
  CHECK_NEAR(axis_x, 2.6508501071522376, 1e-14);
  CHECK_NEAR(axis_y, 0.58915016190837923, 1e-14);
  CHECK_NEAR(peak, 0.30572447918727691, 1e-14);
  CHECK_DONE(fuge_hertz_ellipse(1.0, 10.0, 1.0, 1.0, NULL, &axis_y, NULL, NULL, NULL, 0));
  CHECK_NEAR(axis_y, axis_x, 0.0);
}

static void check_refused(double radius_y, double e_star, double load, int status, const char *part) {
  double values[4];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fill(values, 4);
  CHECK_SAYS(fuge_hertz_ellipse(1.0, radius_y, e_star, load, values, values + 1, values + 2, values + 3, message,
                                sizeof message), status, message, part);
  CHECK_UNTOUCHED(values, 4);
}

int main(void) {
  test_sphere();
  test_ellipse();
  check_refused(-1.0, 1.0, 1.0, FUGE_ERR_WIDTH, "radius_y = -1.");
  check_refused(NAN, 1.0, 1.0, FUGE_ERR_NOT_FINITE, "radius_y = NaN");
  check_refused(1.0, 0.0, 1.0, FUGE_ERR_MODULUS, "e_star = 0.");
  check_refused(1.0, 1.0, -1.0, FUGE_ERR_NO_EQUILIBRIUM, "load = -1.");
  check_refused(1.0, 1.0, 1e-320, FUGE_ERR_OVERFLOW, "smaller unit of force");
  check_refused(1.0, 1e90, 1.0, FUGE_ERR_OVERFLOW, "e_star = 1.");
  return check_summary();
}
