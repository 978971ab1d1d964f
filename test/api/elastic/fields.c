/* Section "fields" of fuge_elastic.h: at places under cells, rectangles, rings and punches. */
#include "check.h"

enum { N = 3, MOST = 8 };
static const double PI = 3.14159265358979323846, YOUNG = 2.0, POISSON = 0.25;
/* Strips side by side, of which one is free; in a plane y does not count. */
static const double X[N] = {0.5, 1.5, 2.5}, ONES[4] = {1, 1, 1, 1}, FORCE[N] = {2.0, 0.0, 3.0};
static const double PLACE[12] = {0.5, 9.0, 0.75, 1.0, 0.0, 0.0, 2.75, NAN, 0.0, -1.5, -9.0, 4.0};

typedef struct {
  double stress[6 * MOST], u[3 * MOST];
} values;

/* Stresses and displacements, and nothing behind them; the field is freed. */
static values ask(fuge_field *field, int points, const double *place) {
  values v;
  fill(v.stress, 6 * MOST);
  fill(v.u, 3 * MOST);
  CHECK_DONE(fuge_field_stress(field, points, place, NULL, v.stress, NULL, 0));
  CHECK_DONE(fuge_field_displacement(field, points, place, NULL, v.u, NULL, 0));
  CHECK_UNTOUCHED(v.stress + 6 * points, 6 * (MOST - points));
  CHECK_UNTOUCHED(v.u + 3 * points, 3 * (MOST - points));
  fuge_field_free(&field);
  CHECK(field == NULL);
  return v;
}

static fuge_field *line(int n, const double *x, const double *force, int element, int symmetric, int plane_state) {
  fuge_field *field = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_MESSAGE(fuge_field_halfplane(n, x, ONES, force, element, symmetric, YOUNG, POISSON, plane_state, &field,
                                     message, sizeof message), FUGE_DONE, message, "");
  return field;
}

/* Stresses on the axis of one strip: zz and xx are -(p/pi)(a +- sin a), a the angle of view. */
static void test_one_strip(void) {
  const double a = 2.0 * atan(0.5 / 0.75), xx = -2.0 / PI * (a - sin(a)), zz = -2.0 / PI * (a + sin(a));
  values v = ask(line(1, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRAIN), 1, PLACE);
  CHECK_VALUES(v.stress, 1e-15, xx, POISSON * (xx + zz), zz, 0.0, 0.0, 0.0);
  v = ask(line(1, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRESS), 1, PLACE);
  CHECK_VALUES(v.stress, 1e-15, xx, 0.0, zz, 0.0, 0.0, 0.0);
  CHECK_NEAR(v.u[1], 0.0, 0.0);
}

/* The pressure, and its mean at an end. */
static void test_surface(void) {
  values v = ask(line(N, X, FORCE, FUGE_CENTRE, 0, FUGE_PLANE_STRAIN), 4, PLACE);
  CHECK_VALUES(v.stress + 6, 1e-15, -1.0, -0.5, -1.0, 0.0);
  CHECK_VALUES(v.stress + 12, 1e-15, -3.0, -1.5, -3.0, 0.0, 0.0);
  CHECK_NEAR(v.stress[10], v.stress[11], 0.0);
  v = ask(line(N, X, FORCE, FUGE_HAT, 0, FUGE_PLANE_STRAIN), 4, PLACE);
  CHECK_NEAR(v.stress[6], -1.0, 1e-15);
  CHECK_NEAR(v.stress[14], -0.75 * 3.0, 1e-15);
}

static void compare(values found, values expected, int points, double tolerance) {
  for (int k = 0; k < 6 * points; k++) CHECK_NEAR(found.stress[k], expected.stress[k], tolerance);
  for (int k = 0; k < 3 * points; k++) CHECK_NEAR(found.u[k], expected.u[k], tolerance);
}

/* Half a force on a cell and half on its image. */
static void test_symmetric(void) {
  const double both[2] = {0.5, -0.5}, half[2] = {1.0, 1.0};
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++)
    compare(ask(line(1, X, FORCE, element, 1, FUGE_PLANE_STRESS), 4, PLACE),
            ask(line(2, both, half, element, 0, FUGE_PLANE_STRESS), 4, PLACE), 4, 2e-15);
}

/* At the centres, at the surface: the influence matrix times the forces. */
static void test_matrix(void) {
  const double centre[9] = {0.5, 0, 0, 1.5, 0, 0, 2.5, 0, 0};
  double alpha[N * N], modulus;
  values v = ask(line(N, X, FORCE, FUGE_HAT, 0, FUGE_PLANE_STRAIN), N, centre);
  CHECK_DONE(fuge_plane_modulus(YOUNG, POISSON, FUGE_PLANE_STRAIN, &modulus, NULL, 0));
  CHECK_DONE(fuge_halfplane_matrix(N, X, ONES, modulus, FUGE_HAT, 0, alpha, N, NULL, 0));
  for (int i = 0; i < N; i++) {
    double expected = 0.0;
    for (int k = 0; k < N; k++) expected += alpha[i + k * N] * FORCE[k];
    CHECK_NEAR(v.u[3 * i + 2], expected, 1e-14);
  }
}

/* No points are a valid request, no forces give zero, a rigid body does not move. */
static void test_nothing(void) {
  const double zero[N] = {0.0, 0.0, 0.0};
  fuge_field *field = NULL;
  values v = ask(line(N, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRAIN), 0, PLACE);
  v = ask(line(N, X, zero, FUGE_MEAN, 0, FUGE_PLANE_STRAIN), 4, PLACE);
  for (int k = 0; k < 24; k++) CHECK_NEAR(v.stress[k], 0.0, 0.0);
  for (int k = 0; k < 12; k++) CHECK_NEAR(v.u[k], 0.0, 0.0);
  CHECK_DONE(fuge_field_halfplane(N, X, ONES, FORCE, FUGE_MEAN, 0, INFINITY, POISSON, FUGE_PLANE_STRAIN, &field, NULL,
                                  0));
  v = ask(field, 4, PLACE);
  for (int k = 0; k < 12; k++) CHECK_NEAR(v.u[k], 0.0, 0.0);
  fuge_field_free(NULL);
}

/* The field keeps copies. */
static void test_copies(void) {
  double x[N] = {0.5, 1.5, 2.5}, force[N] = {2.0, 0.0, 3.0};
  fuge_field *field = line(N, x, force, FUGE_MEAN, 0, FUGE_PLANE_STRAIN);
  for (int k = 0; k < N; k++) x[k] = force[k] = NAN;
  compare(ask(field, 4, PLACE), ask(line(N, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRAIN), 4, PLACE), 4, 0.0);
}

/* Four unit squares around the origin, of which two have no mirror image of the same force. */
static const double SQUARE_X[4] = {0.5, -0.5, 0.5, -0.5}, SQUARE_Y[4] = {0.5, 0.5, -0.5, -0.5};
static const double SQUARE_PLACE[9] = {0, 0, 0, 0.3, -0.2, 0.75, -7, 2, 1e-3};

static fuge_field *squares(int n, const double *x, const double *y, const double *force, int symmetric_x,
                           int symmetric_y) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_halfspace(n, x, y, ONES, ONES, force, symmetric_x, symmetric_y, YOUNG, POISSON, &field, NULL,
                                  0));
  return field;
}

/* A square of side 2 under unit pressure: on the surface xx = yy = -(1 + 2 nu)/2, zz = -1, and the centre sinks by
 * 8 ln(1 + sqrt 2)/(pi E*). */
static void test_square(void) {
  values v = ask(squares(4, SQUARE_X, SQUARE_Y, ONES, 0, 0), 3, SQUARE_PLACE);
  CHECK_VALUES(v.stress, 1e-15, -0.75, -0.75, -1.0, 0.0, 0.0, 0.0);
  CHECK_VALUES(v.u, 2e-15, 0.0, 0.0, 8.0 * log(1.0 + sqrt(2.0)) / PI * (1.0 - POISSON * POISSON) / YOUNG);
}

/* The forces of a quarter and of a half are sums over the images. */
static void test_folded(void) {
  const double whole[4] = {1, 1, 2, 2}, half[2] = {2, 4}, quarter = 4.0, half_x[2] = {0.5, 0.5};
  const double half_y[2] = {0.5, -0.5};
  compare(ask(squares(2, half_x, half_y, half, 1, 0), 3, SQUARE_PLACE),
          ask(squares(4, SQUARE_X, SQUARE_Y, whole, 0, 0), 3, SQUARE_PLACE), 3, 2e-15);
  compare(ask(squares(1, SQUARE_X, SQUARE_Y, &quarter, 1, 1), 3, SQUARE_PLACE),
          ask(squares(4, SQUARE_X, SQUARE_Y, ONES, 0, 0), 3, SQUARE_PLACE), 3, 2e-15);
}

/* Both rings together are a disc of radius 2 under the pressure 1/pi (Johnson, equation 3.33). */
static const double RADIUS[3] = {0.0, 1.0, 2.0}, RING_FORCE[2] = {1.0, 3.0};

static fuge_field *rings(void) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_rings(2, RADIUS, RING_FORCE, YOUNG, POISSON, &field, NULL, 0));
  return field;
}

static void test_disc(void) {
  const double place[12] = {0, 0, 1.5, 0.5, 0, 0, 4, 0, 0, 0, 0, 0}, radius[4] = {0.0, 0.5, 4.0, 0.0};
  const double radial = 0.5 * 4.0 / (2.0 * PI * 16.0);
  double surface[4];
  values v = ask(rings(), 4, place);
  CHECK_VALUES(v.stress, 1e-15, -(0.75 - 1.25 * 0.6 + 0.5 * 0.216) / PI, v.stress[0], -(1.0 - 0.216) / PI, 0, 0, 0);
  CHECK_VALUES(v.stress + 6, 1e-15, -0.75 / PI, v.stress[6], -1.0 / PI, 0.0, 0.0, 0.0);
  CHECK_VALUES(v.stress + 12, 1e-16, radial, -radial, 0.0, 0.0, 0.0, 0.0);
  CHECK_DONE(fuge_ring_displacement(2, RADIUS, RING_FORCE, YOUNG / (1.0 - POISSON * POISSON), 4, radius, surface, NULL,
                                    0));
  for (int k = 1; k < 4; k++) CHECK_NEAR(v.u[3 * k + 2], surface[k], 2e-15);
  CHECK_NEAR(v.u[0], 0.0, 0.0);
  CHECK_VALUES(v.u + 6, 1e-16, -0.5 * 1.25 / (2.0 * PI * YOUNG) * 4.0 / 4.0, 0.0);
}

static int parabola(int n, const double *x, double *gap, double *slope, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) {
    gap[k] = x[k] * x[k];
    slope[k] = 2.0 * x[k];
  }
  return 0;
}

/* The field outlives the contact. */
static fuge_field *smooth(double force, int plane_state, fuge_punch_report *report) {
  fuge_punch *contact = NULL;
  fuge_field *field = NULL;
  CHECK_DONE(fuge_solve_smooth_punch(parabola, NULL, -5.0, 5.0, YOUNG, force, NULL, &contact, NULL, 0));
  CHECK_DONE(fuge_punch_get_report(contact, report, NULL, 0));
  CHECK_DONE(fuge_field_punch(contact, YOUNG, POISSON, plane_state, &field, NULL, 0));
  fuge_punch_free(&contact);
  return field;
}

/* On the axis zz = -p0 a/sqrt(a^2 + z^2); at the surface -p. */
static void test_cylinder(void) {
  const double force = 0.7, root = sqrt(1.64);
  fuge_punch_report report;
  fuge_field *field = smooth(force, FUGE_PLANE_STRESS, &report);
  const double a = report.half_width, p0 = 2.0 * force / (PI * a), p = p0 * sqrt(0.75);
  const double place[9] = {0, 0, 0.8 * a, 0.5 * a, 0, 0, 2.0 * a, 0, 0};
  values v = ask(field, 3, place);
  CHECK_VALUES(v.stress, 1e-14, -p0 * (root - 0.8) * (root - 0.8) / root, 0.0, -p0 / root);
  CHECK_VALUES(v.stress + 6, 1e-14, -p, 0.0, -p);
  for (int k = 9; k < 18; k++) CHECK_NEAR(v.stress[k], 0.0, 0.0);
  CHECK_NEAR(v.u[0], 0.0, 1e-15);
  CHECK_NEAR(v.u[5], report.approach - 0.25 * a * a, 1e-13);
  CHECK_NEAR(v.u[6], -(1.0 - POISSON) / (2.0 * YOUNG) * force, 1e-14);
  v = ask(smooth(0.0, FUGE_PLANE_STRAIN, &report), 3, place);
  for (int k = 0; k < 18; k++) CHECK_NEAR(v.stress[k], 0.0, 0.0);
}

/* r^2/2, pressed to a contact of this radius, or r, a cone. */
static fuge_punch *pressed(double power, double radius) {
  const double coefficient = 1.0 / power;
  fuge_punch *contact = NULL;
  CHECK_DONE(fuge_solve_round_powers(1, &coefficient, &power, NULL, 5.0, 1.0, NULL, NULL, &radius, &contact, NULL, 0));
  return contact;
}

static fuge_field *round_field(double power, double radius, double poisson) {
  fuge_punch *contact = pressed(power, radius);
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_punch(contact, 1.0 - poisson * poisson, poisson, 0, &field, NULL, 0));
  fuge_punch_free(&contact);
  return field;
}

/* On the axis zz = -p0/(1 + z^2); at the surface -p and, beside the contact, the approach less the height. */
static void test_sphere(void) {
  const double place[9] = {0, 0, 0.5, 0.6, 0, 0, 0, 0, 0}, p0 = 2.0 / PI;
  values v = ask(round_field(2.0, 1.0, POISSON), 3, place);
  CHECK_VALUES(v.stress, 5e-15, -p0 * (1.25 * (1.0 - 0.5 * atan(2.0)) - 0.5 / 1.25), v.stress[0], -p0 / 1.25);
  CHECK_NEAR(v.stress[8], -0.8 * p0, 5e-15);
  CHECK_NEAR(v.stress[12], -0.75 * p0, 5e-15);
  CHECK_NEAR(v.u[5], 1.0 - 0.18, 5e-15);
  CHECK_NEAR(v.u[8], 1.0, 5e-15);
  v = ask(round_field(2.0, 0.0, POISSON), 3, place);
  for (int k = 0; k < 18; k++) CHECK_NEAR(v.stress[k], 0.0, 0.0);
}

static void test_cone(void) {
  const double tip[3] = {0, 0, 0};
  values v = ask(round_field(1.0, 1.0, 0.5), 1, tip);
  for (int k = 0; k < 3; k++) CHECK(v.stress[k] < -1e308);
  CHECK_VALUES(v.stress + 3, 0.0, 0.0, 0.0, 0.0);
}

/* No field with this status and message; `field` is what it was. */
static fuge_field *field, *kept;
static char message[FUGE_MESSAGE_LENGTH + 1];
#define CHECK_REFUSED(call, status, part) \
  do { \
    CHECK_SAYS(call, status, message, part); \
    CHECK(field == kept); \
  } while (0)

static int plane(int n, const double *x, const double *width, const double *force, int element, double young,
                 double poisson, int plane_state) {
  return fuge_field_halfplane(n, x, width, force, element, 0, young, poisson, plane_state, &field, message,
                              sizeof message);
}

static void test_refused_cells(void) {
  const double bad[N] = {1.0, NAN, 1.0};
  field = kept = line(N, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRAIN);
  CHECK_REFUSED(plane(0, X, ONES, FORCE, FUGE_MEAN, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_SIZE, "n = 0");
  CHECK_REFUSED(plane(N, NULL, ONES, FORCE, FUGE_MEAN, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_POINTER, "x is NULL");
  CHECK_REFUSED(plane(N, X, NULL, FORCE, FUGE_MEAN, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_POINTER, "width is NULL");
  CHECK_REFUSED(plane(N, X, ONES, NULL, FUGE_MEAN, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_POINTER, "force is NULL");
  CHECK_REFUSED(plane(N, X, ONES, bad, FUGE_MEAN, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_NOT_FINITE, "force(1)");
  CHECK_REFUSED(plane(N, X, ONES, FORCE, FUGE_HAT + 1, 1.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_ELEMENT, "element = 3");
  CHECK_REFUSED(plane(N, X, ONES, FORCE, FUGE_MEAN, 0.0, 0.3, FUGE_PLANE_STRAIN), FUGE_ERR_MODULUS, "young = 0.");
  CHECK_REFUSED(plane(N, X, ONES, FORCE, FUGE_MEAN, 1.0, 0.6, FUGE_PLANE_STRAIN), FUGE_ERR_MODULUS, "poisson = 0.6");
  CHECK_REFUSED(plane(N, X, ONES, FORCE, FUGE_MEAN, 1.0, 0.3, 7), FUGE_ERR_OPTION, "plane_state = 7");
  CHECK_SAYS(fuge_field_halfplane(N, X, ONES, FORCE, FUGE_MEAN, 1, 1.0, 0.3, FUGE_PLANE_STRAIN, NULL, message,
                                  sizeof message), FUGE_ERR_POINTER, message, "field is NULL");
  fuge_field_free(&field);
}

static int area(int n, const double *width_y, const double *force, int symmetric_x, double young, double poisson) {
  return fuge_field_halfspace(n, SQUARE_X, SQUARE_Y, ONES, width_y, force, symmetric_x, 0, young, poisson, &field,
                              message, sizeof message);
}

static void test_refused_rectangles_and_rings(void) {
  const double flat[4] = {1, 0, 1, 1};
  field = kept = rings();
  CHECK_REFUSED(area(0, ONES, ONES, 0, 1.0, 0.3), FUGE_ERR_SIZE, "n = 0");
  CHECK_REFUSED(area(4, ONES, NULL, 0, 1.0, 0.3), FUGE_ERR_POINTER, "force is NULL");
  CHECK_REFUSED(area(4, flat, ONES, 0, 1.0, 0.3), FUGE_ERR_WIDTH, "width_y(1) = 0.");
  CHECK_REFUSED(area(4, ONES, ONES, 1, 1.0, 0.3), FUGE_ERR_WIDTH, "x(1) = -0.5");
  CHECK_REFUSED(area(4, ONES, ONES, 0, 0.0, 0.3), FUGE_ERR_MODULUS, "young = 0.");
  CHECK_REFUSED(area(4, ONES, ONES, 0, 1.0, 0.6), FUGE_ERR_MODULUS, "poisson = 0.6");
  CHECK_REFUSED(fuge_field_rings(0, RADIUS, RING_FORCE, 1.0, 0.3, &field, message, sizeof message), FUGE_ERR_SIZE,
                "n = 0");
  CHECK_REFUSED(fuge_field_rings(2, NULL, RING_FORCE, 1.0, 0.3, &field, message, sizeof message), FUGE_ERR_POINTER,
                "radius is NULL");
  CHECK_REFUSED(fuge_field_rings(2, RADIUS, NULL, 1.0, 0.3, &field, message, sizeof message), FUGE_ERR_POINTER,
                "force is NULL");
  CHECK_REFUSED(fuge_field_rings(2, RADIUS, RING_FORCE, 1.0, -1.0, &field, message, sizeof message), FUGE_ERR_MODULUS,
                "poisson = -1.");
  fuge_field_free(&field);
}

static void test_refused_punches(void) {
  fuge_punch *cylinder = NULL;
  fuge_punch *sphere = pressed(2.0, 1.0);
  CHECK_DONE(fuge_solve_smooth_punch(parabola, NULL, -5.0, 5.0, YOUNG, 1.0, NULL, &cylinder, NULL, 0));
  field = kept = rings();
  CHECK_REFUSED(fuge_field_punch(NULL, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, message, sizeof message), FUGE_ERR_POINTER,
                "contact is NULL");
  CHECK_REFUSED(fuge_field_punch(cylinder, 1.0, 0.6, FUGE_PLANE_STRAIN, &field, message, sizeof message),
                FUGE_ERR_MODULUS, "poisson = 0.6");
  CHECK_REFUSED(fuge_field_punch(cylinder, 1.0, 0.3, 7, &field, message, sizeof message), FUGE_ERR_OPTION,
                "plane_state = 7");
  CHECK_REFUSED(fuge_field_punch(sphere, 1.0, 0.6, 0, &field, message, sizeof message), FUGE_ERR_MODULUS,
                "poisson = 0.6");
  CHECK_REFUSED(fuge_field_punch(sphere, -1.0, 0.3, 0, &field, message, sizeof message), FUGE_ERR_MODULUS,
                "young = -1.");
  fuge_field_free(&field);
  fuge_punch_free(&cylinder);
  fuge_punch_free(&sphere);
}

static void check_place(const fuge_field *asked, int points, const double *place, int status, const char *part) {
  double result[18];
  fill(result, 18);
  CHECK_SAYS(fuge_field_stress(asked, points, place, NULL, result, message, sizeof message), status, message, part);
  CHECK_SAYS(fuge_field_displacement(asked, points, place, NULL, result, message, sizeof message), status, message,
             part);
  CHECK_UNTOUCHED(result, 18);
}

/* Indices in messages count from 0; all fields refuse the same. */
static void test_refused_places(void) {
  const double above[6] = {0, 0, 1, 1, 0, -0.5}, nowhere[6] = {0, 0, 1, 1, 0, NAN}, left[6] = {0, 0, 1, -1, 0, 1};
  fuge_punch_report report;
  fuge_field *all[] = {line(N, X, FORCE, FUGE_MEAN, 0, FUGE_PLANE_STRAIN),
                       line(N, X, FORCE, FUGE_HAT, 1, FUGE_PLANE_STRESS),
                       squares(4, SQUARE_X, SQUARE_Y, ONES, 0, 0), smooth(0.7, FUGE_PLANE_STRAIN, &report), rings(),
                       round_field(2.0, 1.0, POISSON)};
  check_place(NULL, 2, left, FUGE_ERR_POINTER, "field is NULL");
  for (int k = 0; k < 6; k++) {
    check_place(all[k], -1, left, FUGE_ERR_SIZE, "points = -1");
    check_place(all[k], 2, NULL, FUGE_ERR_POINTER, "place is NULL");
    check_place(all[k], 2, above, FUGE_ERR_GRID, "z(1) = -0.5");
    check_place(all[k], 2, nowhere, FUGE_ERR_NOT_FINITE, "z(1) = NaN");
    if (k > 3) check_place(all[k], 2, left, FUGE_ERR_WIDTH, "(1) = -1.0");
    CHECK_SAYS(fuge_field_stress(all[k], 2, left, NULL, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
               "tensor is NULL");
    CHECK_SAYS(fuge_field_displacement(all[k], 2, left, NULL, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
               "displacement is NULL");
    fuge_field_free(&all[k]);
  }
}

int main(void) {
  test_one_strip();
  test_surface();
  test_symmetric();
  test_matrix();
  test_nothing();
  test_copies();
  test_square();
  test_folded();
  test_disc();
  test_cylinder();
  test_sphere();
  test_cone();
  test_refused_cells();
  test_refused_rectangles_and_rings();
  test_refused_punches();
  test_refused_places();
  return check_summary();
}
