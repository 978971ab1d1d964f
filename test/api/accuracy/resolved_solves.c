/* Section "solves to a wanted error" of fuge_accuracy.h. */
#include <limits.h>
#include <stdlib.h>
#include "check.h"

static const double PI = 3.14159265358979324;

enum { WHOLE, STATUS, MEMORY, FORGETS, INFINITE };

/* What the callback sees as user: the gap (x - x0)^2/(2 radius) + (y - y0)^2/(2 radius), for an infinite radius 0. */
typedef struct ball {
  double radius, x0, y0;
  int fails; /* WHOLE .. */
  int calls;
  double least, most; /* of all x */
} ball;

static int round_gap(int n, const double *x, const double *y, double *gap, void *user) {
  ball *b = user;
  b->calls++;
  for (int k = 0; k < n; k++) {
    const double dx = x[k] - b->x0, dy = y[k] - b->y0;
    if (b->fails != FORGETS || k < n - 1) gap[k] = 0.5 * (dx * dx + dy * dy) / b->radius;
    if (x[k] < b->least) b->least = x[k];
    if (x[k] > b->most) b->most = x[k];
  }
  if (b->fails == INFINITE) gap[0] = HUGE_VAL;
  /* Harms nobody. */
  for (int k = 0; k < n; k++) ((double *)x)[k] = ((double *)y)[k] = 1e9;
  if (b->fails == STATUS) return 5;
  return b->fails == MEMORY ? FUGE_ERR_MEMORY : 0;
}

/* One wave per unit length; user is allowed to be NULL. */
static int wave(int n, const double *x, const double *y, double *gap, void *user) {
  (void)y;
  CHECK(user == NULL);
  for (int k = 0; k < n; k++) gap[k] = 0.1 * (1.0 - cos(2.0 * PI * x[k]));
  return 0;
}

static const ball CYLINDER = {2.0, 0.0, 0.0, WHOLE, 0, 0.0, 0.0};
static const double E_STAR = 3.0, LOAD = 0.7;

/* Half the length of the contact of a cylinder. */
static double half_width(void) { return sqrt(4.0 * LOAD * CYLINDER.radius / (PI * E_STAR)); }

/* A line without an error, which the caller frees. */
static fuge_resolved *line(ball *b, double left, double right, const fuge_pressing *pressing,
                           fuge_resolved_report *report) {
  fuge_resolved *contact = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_MESSAGE(fuge_solve_line(round_gap, b, left, right, pressing, &contact, message, sizeof message), FUGE_DONE,
                message, "");
  CHECK_DONE(fuge_resolved_get_report(contact, report, NULL, 0));
  return contact;
}

/* Zeros are the defaults of all members but the modulus and what presses. */
static void test_cylinder(void) {
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved_report report;
  const double a = half_width(), approach = 2.0 * LOAD / (PI * E_STAR) * (log(20.0 / a) + 0.5);
  double edges[2];
  fuge_resolved *contact;
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  contact = line(&b, -2.0, 3.0, &pressing, &report);
  CHECK(b.calls > 0 && b.least >= -2.0 && b.most <= 3.0);
  CHECK_NEAR(report.load, LOAD, 1e-9);
  CHECK_NEAR(report.tilt, 0.0, 0.0);
  CHECK(report.pressure_error <= 1e-3);
  CHECK_NEAR(report.approach, approach, report.approach_error + 1e-12);
  CHECK_NEAR(report.largest, 2.0 * LOAD / (PI * a), report.largest_error + 1e-12);
  CHECK_NEAR(report.size, 2.0 * a, report.size_error + 1e-12);
  CHECK(report.approach_error <= 0.01 * approach && report.size_error <= 0.02 * a);
  CHECK_INT(report.intervals, 1);
  CHECK_DONE(fuge_resolved_get_cells(contact, NULL, NULL, NULL, NULL, NULL, NULL, edges, NULL, 0));
  CHECK_NEAR(edges[0], -a, report.edge_error + 1e-12);
  CHECK_NEAR(edges[1], a, report.edge_error + 1e-12);
  fuge_resolved_free(&contact);
  CHECK(contact == NULL);
}

/* By the approach of a load. */
static void test_approach(void) {
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved_report report;
  const double a = half_width(), approach = 2.0 * LOAD / (PI * E_STAR) * (log(20.0 / a) + 0.5);
  fuge_resolved *contact;
  pressing.e_star = E_STAR;
  pressing.approach = &approach;
  contact = line(&b, -2.0, 3.0, &pressing, &report);
  CHECK_NEAR(report.approach, approach, 1e-12);
  CHECK_NEAR(report.load, LOAD, 3e-3 * LOAD);
  fuge_resolved_free(&contact);
}

/* A cylinder that tilts moves its contact to the line of action. */
static void test_moment(void) {
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved_report report;
  const double moment = LOAD * 0.25;
  double edges[2];
  fuge_resolved *contact;
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  pressing.moment = &moment;
  contact = line(&b, -2.0, 3.0, &pressing, &report);
  CHECK_DONE(fuge_resolved_get_cells(contact, NULL, NULL, NULL, NULL, NULL, NULL, edges, NULL, 0));
  CHECK_NEAR(0.5 * (edges[0] + edges[1]), 0.25, report.edge_error + 1e-12);
  CHECK_NEAR(report.tilt, 0.25 / CYLINDER.radius, 2e-3);
  fuge_resolved_free(&contact);
}

/* The bodies end where the interval ends. */
static void test_flat_face(void) {
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved_report report;
  const double half = 1.5, approach = 2.0 * LOAD / (PI * E_STAR) * log(8.0);
  fuge_resolved *contact;
  b.radius = HUGE_VAL;
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  pressing.accuracy = 0.01;
  contact = line(&b, 1.0, 1.0 + 2.0 * half, &pressing, &report);
  CHECK(report.at_rim[0] == 1 && report.at_rim[1] == 1 && report.at_rim[2] == 0 && report.at_rim[3] == 0);
  CHECK_NEAR(report.size, 2.0 * half, report.size_error + 1e-12);
  CHECK_NEAR(report.approach, approach, report.approach_error + 1e-12);
  CHECK(report.pressure_error <= 0.01);
  fuge_resolved_free(&contact);
}

/* Westergaard's waves. */
static void test_periodic(void) {
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  fuge_resolved_report report;
  const double load = 0.5 * PI * E_STAR * 0.1;
  pressing.boundary = FUGE_PERIODIC;
  pressing.e_star = E_STAR;
  pressing.load = &load;
  CHECK_DONE(fuge_solve_line(wave, NULL, -0.5, 0.5, &pressing, &contact, NULL, 0));
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.size, 0.5, report.size_error + 1e-12);
  CHECK(report.at_rim[0] == 0 && report.at_rim[1] == 0);
  fuge_resolved_free(&contact);
}

/* Of one material, with and without layers; then they have no e_star, and a rigid body on the other side. */
static void test_layers(void) {
  static const double THICKNESS[2] = {0.2, 0.5}, YOUNG[3] = {2.73, 2.73, 2.73}, POISSON[3] = {0.3, 0.3, 0.3};
  const double a = half_width();
  for (int layers = 0; layers < 3; layers += 2) {
    ball b = CYLINDER;
    fuge_pressing pressing = {0};
    fuge_resolved_report report;
    fuge_resolved *contact;
    pressing.e_star = NAN;
    pressing.load = &LOAD;
    pressing.layers = layers;
    pressing.bonded = layers > 0;
    if (layers > 0) pressing.thickness = THICKNESS;
    pressing.young = YOUNG;
    pressing.poisson = POISSON;
    contact = line(&b, -2.0, 3.0, &pressing, &report);
    CHECK_NEAR(report.size, 2.0 * a, report.size_error + 1e-9);
    fuge_resolved_free(&contact);
    /* A soft body on the other side: twice the contact. */
    pressing.e_star_other = 1.0;
    contact = line(&b, -2.0, 3.0, &pressing, &report);
    CHECK_NEAR(report.size, 4.0 * a, report.size_error + 1e-9);
    fuge_resolved_free(&contact);
  }
}

/* A ball off centre; x runs first. */
static void test_ball(void) {
  const double lower[2] = {-1.0, -0.5}, upper[2] = {1.5, 1.0};
  ball b = {2.0, 0.4, 0.1, WHOLE, 0, 0.0, 0.0};
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  fuge_resolved_report report;
  double a, approach, peak, *x, *y, *force;
  int largest = 0;
  CHECK_DONE(fuge_hertz_ellipse(2.0, 2.0, E_STAR, LOAD / 10.0, &a, NULL, &approach, &peak, NULL, 0));
  const double load = LOAD / 10.0;
  pressing.e_star = E_STAR;
  pressing.load = &load;
  pressing.accuracy = 0.03;
  CHECK_DONE(fuge_solve_area(round_gap, &b, lower, upper, &pressing, &contact, NULL, 0));
  CHECK(b.calls > 0 && b.least >= -1.0 && b.most <= 1.5);
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  CHECK_INT(report.intervals, 0);
  CHECK_NEAR(report.load, load, 1e-9);
  CHECK(report.pressure_error <= 0.03);
  CHECK_NEAR(report.approach, approach, report.approach_error + 1e-12);
  CHECK_NEAR(report.largest, peak, report.largest_error + 1e-12);
  CHECK_NEAR(report.size, PI * a * a, report.size_error + 1e-12);
  CHECK(report.at_rim[0] + report.at_rim[1] + report.at_rim[2] + report.at_rim[3] == 0);
  x = malloc(sizeof(double) * (size_t)report.nx);
  y = malloc(sizeof(double) * (size_t)report.ny);
  force = malloc(sizeof(double) * (size_t)report.nx * (size_t)report.ny);
  CHECK_DONE(fuge_resolved_get_cells(contact, x, NULL, y, NULL, force, NULL, NULL, NULL, 0));
  for (int k = 1; k < report.nx * report.ny; k++)
    if (force[k] > force[largest]) largest = k;
  CHECK_NEAR(x[largest % report.nx], 0.4, 0.2 * a);
  CHECK_NEAR(y[largest / report.nx], 0.1, 0.2 * a);
  free(x);
  free(y);
  free(force);
  fuge_resolved_free(&contact);
  /* By its approach. */
  pressing.load = NULL;
  pressing.approach = &approach;
  CHECK_DONE(fuge_solve_area(round_gap, &b, lower, upper, &pressing, &contact, NULL, 0));
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  CHECK_NEAR(report.load, load, 0.05 * load);
  fuge_resolved_free(&contact);
}

/* Bodies that touch without a load: at their lowest place, and nothing is pressed. */
static void test_no_load(void) {
  static const double LOWER[2] = {-1.0, -1.0}, UPPER[2] = {1.0, 1.0}, NO_LOAD = 0.0;
  for (int area = 0; area < 2; area++) {
    ball b = CYLINDER;
    fuge_pressing pressing = {0};
    fuge_resolved *contact = NULL;
    fuge_resolved_report report;
    pressing.e_star = E_STAR;
    pressing.load = &NO_LOAD;
    if (area)
      CHECK_DONE(fuge_solve_area(round_gap, &b, LOWER, UPPER, &pressing, &contact, NULL, 0));
    else
      CHECK_DONE(fuge_solve_line(round_gap, &b, -1.0, 1.0, &pressing, &contact, NULL, 0));
    CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
    CHECK_NEAR(report.load, 0.0, 0.0);
    CHECK_NEAR(report.largest, 0.0, 0.0);
    CHECK_NEAR(report.approach, 0.0, 1e-2);
    CHECK(report.nx > 0 && report.ny > 0 && report.levels > 0);
    CHECK_DONE(fuge_resolved_get_cells(contact, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0));
    fuge_resolved_free(&contact);
  }
}

/* Less exactly than wanted: a warning, and the contact. */
static void test_few_cells(void) {
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  fuge_resolved_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  pressing.accuracy = 1e-9;
  pressing.most_cells = 4096;
  CHECK_STATUS(fuge_solve_line(wave, NULL, -1.6, 1.6, &pressing, &contact, message, sizeof message),
               FUGE_WARN_ACCURACY);
  CHECK_CONTAINS(message, "most_cells");
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  CHECK(report.pressure_error > 1e-9 && report.pressure_error < 1.0);
  CHECK(report.nx > 0 && report.nx <= 4096);
  fuge_resolved_free(&contact);
}

static void test_threads(void) {
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved_report one, report;
  fuge_resolved *contact;
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  for (int threads = 1; threads >= 0; threads--) {
    pressing.threads = threads;
    contact = line(&b, -2.0, 3.0, &pressing, &report);
    if (threads == 1) one = report;
    CHECK_NEAR(report.approach, one.approach, 0.0);
    CHECK_NEAR(report.largest, one.largest, 0.0);
    fuge_resolved_free(&contact);
  }
}

static void test_callbacks_that_fail(void) {
  static const double LOWER[2] = {-1.0, -1.0}, UPPER[2] = {1.0, 1.0};
  static const char *const SAYS[] = {"", "status 5", "status", "NaN", "Infinity"};
  for (int fails = STATUS; fails <= INFINITE; fails++) {
    ball b = CYLINDER;
    fuge_pressing pressing = {0};
    fuge_resolved *contact = NULL;
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    b.fails = fails;
    pressing.e_star = E_STAR;
    pressing.load = &LOAD;
    CHECK_SAYS(fuge_solve_line(round_gap, &b, -2.0, 3.0, &pressing, &contact, message, sizeof message),
               FUGE_ERR_CALLBACK, message, SAYS[fails]);
    CHECK_SAYS(fuge_solve_area(round_gap, &b, LOWER, UPPER, &pressing, &contact, message, sizeof message),
               FUGE_ERR_CALLBACK, message, SAYS[fails]);
    CHECK(contact == NULL);
  }
}

/* Solve both ways, as the status is expected of both. */
static void refuse(const fuge_pressing *pressing, int expected) {
  static const double LOWER[2] = {-2.0, -2.0}, UPPER[2] = {3.0, 3.0};
  ball b = CYLINDER;
  fuge_resolved *contact = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_STATUS(fuge_solve_line(round_gap, &b, -2.0, 3.0, pressing, &contact, message, sizeof message), expected);
  CHECK(strlen(message) > 0);
  message[0] = '\0';
  CHECK_STATUS(fuge_solve_area(round_gap, &b, LOWER, UPPER, pressing, &contact, message, sizeof message), expected);
  CHECK(strlen(message) > 0);
  CHECK(contact == NULL);
}

static void test_members_out_of_range(void) {
  static const double NUMBER = 0.1, MINUS = -1.0, NOT = NAN;
  static const double YOUNG[2] = {1.0, 1.0}, POISSON[2] = {0.3, 0.3};
  const fuge_pressing good = {.e_star = 3.0, .load = &NUMBER};
  fuge_pressing pressing;
#define REFUSE(changes, expected) \
  do { \
    pressing = good; \
    changes; \
    refuse(&pressing, expected); \
  } while (0)
  REFUSE(pressing.boundary = 7, FUGE_ERR_OPTION);
  REFUSE(pressing.most_cells = -1, FUGE_ERR_OPTION);
  REFUSE(pressing.threads = -1, FUGE_ERR_OPTION);
  REFUSE(pressing.accuracy = -1e-3, FUGE_ERR_OPTION);
  REFUSE(pressing.accuracy = 1.0, FUGE_ERR_OPTION);
  REFUSE(pressing.accuracy = NAN, FUGE_ERR_OPTION);
  REFUSE(pressing.most_seconds = NAN, FUGE_ERR_OPTION);
  REFUSE(pressing.e_star = 0.0, FUGE_ERR_MODULUS);
  REFUSE(pressing.e_star = -1.0, FUGE_ERR_MODULUS);
  REFUSE(pressing.load = NULL, FUGE_ERR_OPTION);
  REFUSE(pressing.approach = &NUMBER, FUGE_ERR_OPTION);
  REFUSE(pressing.load = &MINUS, FUGE_ERR_NO_EQUILIBRIUM);
  REFUSE(pressing.load = &NOT, FUGE_ERR_NOT_FINITE);
  REFUSE(pressing.load = NULL; pressing.approach = &NOT, FUGE_ERR_NOT_FINITE);
  REFUSE(pressing.load = NULL; pressing.approach = &NUMBER; pressing.moment = &NUMBER, FUGE_ERR_UNSUPPORTED);
  REFUSE(pressing.boundary = FUGE_PERIODIC; pressing.moment = &NUMBER, FUGE_ERR_UNSUPPORTED);
  /* Layers. */
  REFUSE(pressing.layers = -1, FUGE_ERR_SIZE);
  REFUSE(pressing.layers = INT_MAX, FUGE_ERR_SIZE);
  REFUSE(pressing.layers = 1, FUGE_ERR_POINTER);
  REFUSE(pressing.layers = 1; pressing.thickness = &NUMBER, FUGE_ERR_POINTER);
  REFUSE(pressing.young = YOUNG, FUGE_ERR_POINTER);
  REFUSE(pressing.young = YOUNG; pressing.poisson = POISSON; pressing.bonded = 2, FUGE_ERR_OPTION);
  REFUSE(pressing.young = &MINUS; pressing.poisson = POISSON, FUGE_ERR_MODULUS);
  REFUSE(pressing.young = YOUNG; pressing.poisson = POISSON; pressing.e_star_other = -1.0, FUGE_ERR_MODULUS);
#undef REFUSE
}

static void test_refusals(void) {
  static const double LOWER[2] = {-1.0, -1.0}, UPPER[2] = {1.0, 1.0}, LOW[2] = {1.0, -2.0}, NONE[2] = {NAN, 1.0};
  const double moment = 0.1;
  ball b = CYLINDER;
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  pressing.e_star = E_STAR;
  pressing.load = &LOAD;
  CHECK_MESSAGE(fuge_solve_line(NULL, &b, -1.0, 1.0, &pressing, &contact, message, sizeof message), FUGE_ERR_POINTER,
                message, "gap is NULL");
  CHECK_MESSAGE(fuge_solve_line(round_gap, &b, -1.0, 1.0, NULL, &contact, message, sizeof message), FUGE_ERR_POINTER,
                message, "pressing is NULL");
  CHECK_MESSAGE(fuge_solve_line(round_gap, &b, -1.0, 1.0, &pressing, NULL, message, sizeof message), FUGE_ERR_POINTER,
                message, "contact is NULL");
  CHECK_STATUS(fuge_solve_line(round_gap, &b, 1.0, 1.0, &pressing, &contact, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_solve_line(round_gap, &b, 1.0, -1.0, &pressing, &contact, NULL, 0), FUGE_ERR_WIDTH);
  CHECK(fuge_solve_line(round_gap, &b, NAN, 1.0, &pressing, &contact, NULL, 0) < 0);
  CHECK(fuge_solve_line(round_gap, &b, -1.0, HUGE_VAL, &pressing, &contact, NULL, 0) < 0);
  CHECK_STATUS(fuge_solve_area(NULL, &b, LOWER, UPPER, &pressing, &contact, NULL, 0), FUGE_ERR_POINTER);
  CHECK_MESSAGE(fuge_solve_area(round_gap, &b, NULL, UPPER, &pressing, &contact, message, sizeof message),
                FUGE_ERR_POINTER, message, "lower is NULL");
  CHECK_MESSAGE(fuge_solve_area(round_gap, &b, LOWER, NULL, &pressing, &contact, message, sizeof message),
                FUGE_ERR_POINTER, message, "upper is NULL");
  CHECK_STATUS(fuge_solve_area(round_gap, &b, LOWER, UPPER, NULL, &contact, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_area(round_gap, &b, LOWER, UPPER, &pressing, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_area(round_gap, &b, UPPER, LOWER, &pressing, &contact, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_solve_area(round_gap, &b, LOWER, LOW, &pressing, &contact, NULL, 0), FUGE_ERR_WIDTH);
  CHECK(fuge_solve_area(round_gap, &b, LOWER, NONE, &pressing, &contact, NULL, 0) < 0);
  pressing.moment = &moment;
  CHECK_STATUS(fuge_solve_area(round_gap, &b, LOWER, UPPER, &pressing, &contact, NULL, 0), FUGE_ERR_UNSUPPORTED);
  CHECK(contact == NULL);
  CHECK_INT(b.calls, 0);
}

int main(void) {
  test_cylinder();
  test_approach();
  test_moment();
  test_flat_face();
  test_periodic();
  test_layers();
  test_ball();
  test_no_load();
  test_few_cells();
  test_threads();
  test_callbacks_that_fail();
  test_members_out_of_range();
  test_refusals();
  return check_summary();
}
