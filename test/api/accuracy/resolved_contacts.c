/* Section "resolved contacts" of fuge_accuracy.h. */
#include <float.h>
#include <stdlib.h>
#include "check.h"

/* A wedge. */
static int wedge(int n, const double *x, const double *y, double *gap, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) {
    CHECK_NEAR(y[k], 0.0, 0.0);
    gap[k] = 0.1 * fabs(x[k]);
  }
  return 0;
}

/* A roller: as long as the rectangle is along y. */
static int roller(int n, const double *x, const double *y, double *gap, void *user) {
  (void)y;
  (void)user;
  for (int k = 0; k < n; k++) gap[k] = 0.5 * x[k] * x[k];
  return 0;
}

static const double LOAD = 0.2;

static fuge_resolved *pressed_line(void) {
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  pressing.e_star = 3.0;
  pressing.load = &LOAD;
  pressing.accuracy = 0.01;
  CHECK_DONE(fuge_solve_line(wedge, NULL, -2.0, 2.0, &pressing, &contact, NULL, 0));
  return contact;
}

static fuge_resolved *pressed_area(void) {
  static const double LOWER[2] = {-1.0, 2.0}, UPPER[2] = {1.0, 3.0};
  fuge_pressing pressing = {0};
  fuge_resolved *contact = NULL;
  pressing.e_star = 3.0;
  pressing.load = &LOAD;
  pressing.accuracy = 0.05;
  CHECK_DONE(fuge_solve_area(roller, NULL, LOWER, UPPER, &pressing, &contact, NULL, 0));
  return contact;
}

static double sum(const double *values, int n) {
  double total = 0.0;
  for (int k = 0; k < n; k++) total += values[k];
  return total;
}

static void test_report(void) {
  fuge_resolved *contact = pressed_line();
  fuge_resolved_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  memset(&report, 0xff, sizeof report);
  CHECK_MESSAGE(fuge_resolved_get_report(contact, &report, message, sizeof message), FUGE_DONE, message, "");
  CHECK(report.nx > 1 && report.levels > 0);
  CHECK_INT(report.ny, 1);
  CHECK_INT(report.intervals, 1);
  CHECK(report.method == FUGE_BY_SERIES || report.method == FUGE_BY_GRADED_CELLS
        || report.method == FUGE_BY_EQUAL_CELLS);
  for (int k = 0; k < 4; k++) CHECK_INT(report.at_rim[k], 0);
  CHECK_NEAR(report.load, LOAD, 1e-9);
  /* Sneddon's wedge. */
  CHECK_NEAR(report.size, LOAD / 0.1 / 3.0 * 2.0, report.size_error + 1e-12);
  CHECK(report.pressure_error > 0.0 && report.pressure_error <= 0.01);
  CHECK(report.approach_error > 0.0 && report.approach_error < DBL_MAX);
  CHECK(report.edge_error > 0.0 && report.edge_error < DBL_MAX);
  CHECK(report.size_error > 0.0 && report.size_error < DBL_MAX);
  CHECK(report.largest_error > 0.0);
  CHECK(memchr(report.choice, '\0', sizeof report.choice) != NULL);
  CHECK(strlen(report.choice) > 10);
  for (int k = 0; k < 7; k++) CHECK_INT(report.reserved_int[k], 0);
  for (int k = 0; k < 6; k++) CHECK_NEAR(report.reserved[k], 0.0, 0.0);
  fuge_resolved_free(&contact);
}

/* All cells; what follows each array stays as it was. */
static void check_cells(fuge_resolved *contact, double length, double width) {
  enum { MORE = 3 };
  fuge_resolved_report report;
  double *arrays[7], *again;
  int sizes[7];
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  const int n = report.nx * report.ny;
  sizes[0] = sizes[1] = report.nx;
  sizes[2] = sizes[3] = report.ny;
  sizes[4] = sizes[5] = n;
  sizes[6] = 2 * report.intervals;
  for (int k = 0; k < 7; k++) {
    arrays[k] = malloc(sizeof(double) * (size_t)(sizes[k] + MORE));
    fill(arrays[k], sizes[k] + MORE);
  }
  CHECK_DONE(fuge_resolved_get_cells(contact, arrays[0], arrays[1], arrays[2], arrays[3], arrays[4], arrays[5],
                                     arrays[6], NULL, 0));
  for (int k = 0; k < 7; k++) CHECK_UNTOUCHED(arrays[k] + sizes[k], MORE);
  CHECK_NEAR(sum(arrays[4], n), report.load, 1e-9);
  CHECK(sum(arrays[1], report.nx) <= length * (1.0 + 1e-12));
  CHECK(sum(arrays[3], report.ny) <= width * (1.0 + 1e-12));
  for (int k = 1; k < report.nx; k++) CHECK(arrays[0][k] > arrays[0][k - 1]);
  for (int k = 0; k < n; k++) {
    CHECK(arrays[4][k] >= 0.0 && arrays[5][k] > -1e-6);
    CHECK(arrays[4][k] <= report.largest * (1.0 + 1e-9) * arrays[1][k % report.nx] * arrays[3][k / report.nx]
          || report.method != FUGE_BY_EQUAL_CELLS);
  }
  for (int k = 0; k < report.intervals; k++) CHECK(arrays[6][2 * k] < arrays[6][2 * k + 1]);
  /* One output at a time. */
  again = malloc(sizeof(double) * (size_t)(n + 2 + MORE));
  for (int k = 0; k < 7; k++) {
    double *out[7] = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    out[k] = again;
    fill(again, n + 2 + MORE);
    CHECK_DONE(fuge_resolved_get_cells(contact, out[0], out[1], out[2], out[3], out[4], out[5], out[6], NULL, 0));
    CHECK(memcmp(again, arrays[k], sizeof(double) * (size_t)sizes[k]) == 0);
    CHECK_UNTOUCHED(again + sizes[k], MORE);
  }
  free(again);
  for (int k = 0; k < 7; k++) free(arrays[k]);
  CHECK_DONE(fuge_resolved_get_cells(contact, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0));
}

static void test_cells(void) {
  fuge_resolved *contact = pressed_line();
  double y = SENTINEL, width = SENTINEL;
  check_cells(contact, 4.0, 1.0);
  CHECK_DONE(fuge_resolved_get_cells(contact, NULL, NULL, &y, &width, NULL, NULL, NULL, NULL, 0));
  CHECK_NEAR(y, 0.0, 0.0);
  CHECK_NEAR(width, 1.0, 0.0);
  fuge_resolved_free(&contact);
}

/* The ends of a roller are those of the rectangle. */
static void test_area(void) {
  fuge_resolved *contact = pressed_area();
  fuge_resolved_report report;
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  CHECK(report.nx > 1 && report.ny > 1);
  CHECK_INT(report.intervals, 0);
  CHECK(report.at_rim[0] == 0 && report.at_rim[1] == 0 && report.at_rim[2] == 1 && report.at_rim[3] == 1);
  check_cells(contact, 2.0, 1.0);
  fuge_resolved_free(&contact);
}

static void test_levels(void) {
  enum { MOST = 100 };
  fuge_resolved *contact = pressed_line();
  fuge_resolved_report report;
  int cells[MOST], method[MOST];
  double errors[3][MOST];
  CHECK_DONE(fuge_resolved_get_report(contact, &report, NULL, 0));
  const int n = report.levels;
  CHECK(n > 0 && n < MOST);
  for (int k = 0; k < 3; k++) fill(errors[k], MOST);
  cells[n] = method[n] = -7;
  CHECK_DONE(fuge_resolved_get_levels(contact, cells, method, errors[0], errors[1], errors[2], NULL, 0));
  CHECK(cells[n] == -7 && method[n] == -7);
  for (int k = 0; k < 3; k++) CHECK_UNTOUCHED(errors[k] + n, MOST - n);
  for (int k = 0; k < n; k++) {
    CHECK(cells[k] > 0 && method[k] >= FUGE_BY_SERIES && method[k] <= FUGE_BY_EQUAL_CELLS);
    CHECK(errors[0][k] >= 0.0 && errors[0][k] <= 1.0);
    CHECK(errors[1][k] >= 0.0 && errors[1][k] <= DBL_MAX);
    CHECK(errors[2][k] >= (k > 0 ? errors[2][k - 1] : 0.0));
  }
  CHECK_INT(method[n - 1], report.method);
  CHECK_NEAR(errors[0][n - 1], report.pressure_error, 0.0);
  /* One output at a time. */
  int number[MOST];
  double value[MOST];
  CHECK_DONE(fuge_resolved_get_levels(contact, number, NULL, NULL, NULL, NULL, NULL, 0));
  CHECK(memcmp(number, cells, sizeof(int) * (size_t)n) == 0);
  CHECK_DONE(fuge_resolved_get_levels(contact, NULL, number, NULL, NULL, NULL, NULL, 0));
  CHECK(memcmp(number, method, sizeof(int) * (size_t)n) == 0);
  CHECK_DONE(fuge_resolved_get_levels(contact, NULL, NULL, value, NULL, NULL, NULL, 0));
  CHECK(memcmp(value, errors[0], sizeof(double) * (size_t)n) == 0);
  CHECK_DONE(fuge_resolved_get_levels(contact, NULL, NULL, NULL, value, NULL, NULL, 0));
  CHECK(memcmp(value, errors[1], sizeof(double) * (size_t)n) == 0);
  CHECK_DONE(fuge_resolved_get_levels(contact, NULL, NULL, NULL, NULL, value, NULL, 0));
  CHECK(memcmp(value, errors[2], sizeof(double) * (size_t)n) == 0);
  CHECK_DONE(fuge_resolved_get_levels(contact, NULL, NULL, NULL, NULL, NULL, NULL, 0));
  fuge_resolved_free(&contact);
}

static void test_refusals(void) {
  fuge_resolved *contact = pressed_line(), *none = NULL;
  fuge_resolved_report report;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  double value = SENTINEL;
  int number = -7;
  report.nx = -7;
  CHECK_MESSAGE(fuge_resolved_get_report(NULL, &report, message, sizeof message), FUGE_ERR_POINTER, message,
                "contact is NULL");
  CHECK_INT(report.nx, -7);
  CHECK_MESSAGE(fuge_resolved_get_report(contact, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
                "report is NULL");
  CHECK_STATUS(fuge_resolved_get_cells(NULL, &value, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_resolved_get_levels(NULL, &number, NULL, &value, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&value, 1);
  CHECK_INT(number, -7);
  fuge_resolved_free(&contact);
  CHECK(contact == NULL);
  fuge_resolved_free(&contact);
  fuge_resolved_free(&none);
  fuge_resolved_free(NULL);
}

int main(void) {
  test_report();
  test_cells();
  test_area();
  test_levels();
  test_refusals();
  return check_summary();
}
