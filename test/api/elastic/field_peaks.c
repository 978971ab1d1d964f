/* Section "fields" of fuge_elastic.h: the largest stresses. */
#include "check.h"

enum { N = 40 };
static const double PI = 3.14159265358979323846;

/* The largest stress of a field, which is freed. */
static fuge_stress_peak largest(fuge_field *field, int measure) {
  fuge_stress_peak peak = {0};
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_MESSAGE(fuge_field_largest(field, measure, &peak, message, sizeof message), FUGE_DONE, message, "");
  CHECK(peak.layer == -1 && peak.cell == -1);
  fuge_field_free(&field);
  return peak;
}

/* The pressure of a cylinder with a = 1 and p_0 = 1 on the half x >= 0, both halves together. */
static void press(double *x, double *width, double *force) {
  for (int k = 0; k < N; k++) {
    x[k] = (k + 0.5) / N;
    width[k] = 1.0 / N;
    force[k] = 2.0 * sqrt(1.0 - x[k] * x[k]) * width[k];
  }
}

static fuge_field *line(const double *x, const double *width, const double *force, int symmetric) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_halfplane(N, x, width, force, FUGE_MEAN, symmetric, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, NULL,
                                  0));
  return field;
}

static void test_halfplane(void) {
  double x[N], width[N], force[N];
  press(x, width, force);
  fuge_stress_peak peak = largest(line(x, width, force, 1), FUGE_MEASURE_TRESCA);
  CHECK_NEAR(peak.value, 0.600566, 1e-3);
  CHECK_NEAR(peak.place[0], 0.0, 1e-6);
  CHECK_NEAR(peak.place[1], 0.0, 0.0);
  CHECK_NEAR(peak.place[2], 0.786151, 1e-2);
  CHECK_INT(peak.location, FUGE_PEAK_INSIDE);
  CHECK_NEAR(fabs(peak.tensor[0] - peak.tensor[2]), peak.value, 1e-12);
  /* One half alone: a strip of half of the width. */
  peak = largest(line(x, width, force, 0), FUGE_MEASURE_VON_MISES);
  CHECK(peak.place[0] > 0.0 && peak.place[0] < 1.0);
}

static void test_flat(void) {
  static double alpha[N * N], gap[N];
  double x[N], width[N], force[N], open[N], approach;
  press(x, width, force);
  CHECK_DONE(fuge_halfplane_matrix(N, x, width, 1.0, FUGE_MEAN, 0, alpha, N, NULL, 0));
  CHECK_DONE(fuge_solve_dense(N, alpha, N, gap, 1.0, force, open, &approach, NULL, 0));
  fuge_stress_peak peak = largest(line(x, width, force, 0), FUGE_MEASURE_TRESCA);
  CHECK_INT(peak.location, FUGE_PEAK_SINGULAR);
  CHECK(isinf(peak.value) && isnan(peak.tensor[5]));
  CHECK_NEAR(fabs(peak.place[0] - 0.5), 0.5, 1e-15);
}

/* (x - middle)^2/2 */
static int parabola(int n, const double *x, double *gap, double *slope, void *user) {
  const double middle = *(double *)user;
  for (int k = 0; k < n; k++) {
    gap[k] = 0.5 * (x[k] - middle) * (x[k] - middle);
    slope[k] = x[k] - middle;
  }
  return 0;
}

static void test_punches(void) {
  double middle = 2.0, radius = 1.0;
  fuge_punch *smooth = NULL;
  fuge_punch *round = NULL;
  fuge_field *field = NULL;
  CHECK_DONE(fuge_solve_smooth_punch(parabola, &middle, -1.0, 5.0, 1.0, PI / 4.0, NULL, &smooth, NULL, 0));
  CHECK_DONE(fuge_field_punch(smooth, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, NULL, 0));
  fuge_stress_peak peak = largest(field, FUGE_MEASURE_TRESCA);
  CHECK_NEAR(peak.value, 0.300283, 1e-6);
  CHECK_NEAR(peak.place[0], 2.0, 1e-6);
  CHECK_NEAR(peak.place[2], 0.786151, 1e-6);
  middle = 0.0;
  CHECK_DONE(fuge_solve_round_punch(parabola, &middle, 5.0, 1.0, NULL, NULL, &radius, &round, NULL, 0));
  CHECK_DONE(fuge_field_punch(round, 1.0, 0.3, 0, &field, NULL, 0));
  peak = largest(field, FUGE_MEASURE_VON_MISES);
  CHECK_NEAR(peak.value * PI / 2.0, 0.620, 5e-4);
  CHECK_NEAR(peak.place[2], 0.481, 5e-4);
  CHECK_INT(peak.location, FUGE_PEAK_INSIDE);
  fuge_punch_free(&smooth);
  fuge_punch_free(&round);
}

/* A square under uniform pressure, the same as a quarter. */
static void test_square(void) {
  static const double x[4] = {-0.5, 0.5, -0.5, 0.5}, y[4] = {-0.5, -0.5, 0.5, 0.5}, one[4] = {1, 1, 1, 1};
  static const double four = 4.0;
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_halfspace(4, x, y, one, one, one, 0, 0, 1.0, 0.3, &field, NULL, 0));
  const fuge_stress_peak whole = largest(field, FUGE_MEASURE_TRESCA);
  CHECK_INT(whole.location, FUGE_PEAK_INSIDE);
  CHECK(whole.value > 0.6 && whole.value < 0.8);
  CHECK_DONE(fuge_field_halfspace(1, x + 3, y + 3, one, one, &four, 1, 1, 1.0, 0.3, &field, NULL, 0));
  const fuge_stress_peak quarter = largest(field, FUGE_MEASURE_TRESCA);
  CHECK_NEAR(quarter.value, whole.value, 1e-10);
  CHECK(quarter.place[0] >= 0.0 && quarter.place[1] >= 0.0);
}

/* The pressure of a sphere with a = 1 and p_0 = 1 on rings. */
static void test_rings(void) {
  double radius[N + 1], force[N];
  fuge_field *field = NULL;
  for (int k = 0; k <= N; k++) radius[k] = (double)k / N;
  for (int k = 0; k < N; k++) {
    const double inner = 1.0 - radius[k] * radius[k], outer = 1.0 - radius[k + 1] * radius[k + 1];
    force[k] = 2.0 / 3.0 * PI * (pow(inner, 1.5) - pow(outer, 1.5));
  }
  CHECK_DONE(fuge_field_rings(N, radius, force, 1.0, 0.3, &field, NULL, 0));
  const fuge_stress_peak peak = largest(field, FUGE_MEASURE_VON_MISES);
  CHECK_NEAR(peak.value, 0.620, 1e-3);
  CHECK_NEAR(peak.place[2], 0.481, 2e-3);
  CHECK_NEAR(peak.place[0], 0.0, 1e-3);
}

/* Without forces all is 0; what is refused. */
static void test_nothing_and_refusals(void) {
  double x[N], width[N], force[N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_stress_peak peak;
  press(x, width, force);
  fuge_field *field = line(x, width, force, 1);
  peak.value = SENTINEL;
  CHECK_SAYS(fuge_field_largest(field, 2, &peak, message, sizeof message), FUGE_ERR_OPTION, message, "measure = 2");
  CHECK_SAYS(fuge_field_largest(field, 0, NULL, message, sizeof message), FUGE_ERR_POINTER, message, "peak is NULL");
  CHECK_SAYS(fuge_field_largest(NULL, 0, &peak, message, sizeof message), FUGE_ERR_POINTER, message, "field is NULL");
  CHECK_UNTOUCHED(&peak.value, 1);
  fuge_field_free(&field);
  memset(force, 0, sizeof force);
  peak = largest(line(x, width, force, 1), FUGE_MEASURE_TRESCA);
  CHECK_NEAR(peak.value, 0.0, 0.0);
  for (int k = 0; k < 3; k++) CHECK_NEAR(peak.place[k], 0.0, 0.0);
  for (int k = 0; k < 6; k++) CHECK_NEAR(peak.tensor[k], 0.0, 0.0);
}

int main(void) {
  test_halfplane();
  test_flat();
  test_punches();
  test_square();
  test_rings();
  test_nothing_and_refusals();
  return check_summary();
}
