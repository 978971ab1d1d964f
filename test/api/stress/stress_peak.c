/* Section "largest stresses" of fuge_stress.h. */
#include "check.h"

enum { N = 40 };

static fuge_stress_peak untouched(void) {
  fuge_stress_peak peak;
  memset(&peak, 0, sizeof peak);
  peak.value = SENTINEL;
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

/* (x - 2)^2/2 */
static int parabola(int n, const double *x, double *gap, double *slope, void *user) {
  double middle = *(double *)user;
  for (int k = 0; k < n; k++) {
    gap[k] = 0.5 * (x[k] - middle) * (x[k] - middle);
    slope[k] = x[k] - middle;
  }
  return 0;
}

static void test_halfplane(void) {
  double x[N], width[N], force[N];
  fuge_stress_peak peak = untouched();
  char message[256] = "old";
  press(x, width, force);
  CHECK_MESSAGE(fuge_halfplane_peak(N, x, width, force, FUGE_MEAN, FUGE_PLANE_STRAIN, 0.3, 1, FUGE_MEASURE_TRESCA,
                                    &peak, message, sizeof message), FUGE_DONE, message, "");
  CHECK_NEAR(peak.value, 0.600566, 1e-3);
  CHECK_NEAR(peak.place[0], 0.0, 1e-6);
  CHECK_NEAR(peak.place[1], 0.0, 0.0);
  CHECK_NEAR(peak.place[2], 0.786151, 1e-2);
  CHECK_INT(peak.location, FUGE_PEAK_INSIDE);
  CHECK_NEAR(fabs(peak.tensor[0] - peak.tensor[2]), peak.value, 1e-12);
  /* One half alone: a strip of half of the width. */
  CHECK_DONE(fuge_halfplane_peak(N, x, width, force, FUGE_MEAN, FUGE_PLANE_STRAIN, 0.3, 0, FUGE_MEASURE_VON_MISES,
                                 &peak, NULL, 0));
  CHECK(peak.place[0] > 0.0 && peak.place[0] < 1.0);
}

static void test_flat(void) {
  static double alpha[N * N], gap[N];
  double x[N], width[N], force[N], open[N], approach;
  fuge_stress_peak peak = untouched();
  press(x, width, force);
  CHECK_DONE(fuge_halfplane_matrix(N, x, width, 1.0, FUGE_MEAN, 0, alpha, N, NULL, 0));
  CHECK_DONE(fuge_solve_dense(N, alpha, N, gap, 1.0, force, open, &approach, NULL, 0));
  CHECK_DONE(fuge_halfplane_peak(N, x, width, force, FUGE_MEAN, FUGE_PLANE_STRAIN, 0.3, 0, FUGE_MEASURE_TRESCA, &peak,
                                 NULL, 0));
  CHECK_INT(peak.location, FUGE_PEAK_SINGULAR);
  CHECK(isinf(peak.value) && isnan(peak.tensor[5]));
  CHECK_NEAR(fabs(peak.place[0] - 0.5), 0.5, 1e-15);
}

static void test_punches(void) {
  double middle = 2.0, radius = 1.0;
  fuge_smooth *smooth = NULL;
  fuge_round *round = NULL;
  fuge_stress_peak peak = untouched();
  CHECK_DONE(fuge_solve_smooth_punch(parabola, &middle, -1.0, 5.0, 1.0, acos(-1.0) / 4.0, NULL, &smooth, NULL, 0));
  CHECK_DONE(fuge_smooth_peak(smooth, FUGE_PLANE_STRAIN, 0.3, FUGE_MEASURE_TRESCA, &peak, NULL, 0));
  CHECK_NEAR(peak.value, 0.300283, 1e-6);
  CHECK_NEAR(peak.place[0], 2.0, 1e-6);
  CHECK_NEAR(peak.place[2], 0.786151, 1e-6);
  middle = 0.0;
  CHECK_DONE(fuge_solve_round_punch(parabola, &middle, 5.0, 1.0, NULL, NULL, &radius, &round, NULL, 0));
  CHECK_DONE(fuge_round_peak(round, 0.3, FUGE_MEASURE_VON_MISES, &peak, NULL, 0));
  CHECK_NEAR(peak.value * acos(-1.0) / 2.0, 0.620, 5e-4);
  CHECK_NEAR(peak.place[2], 0.481, 5e-4);
  CHECK_INT(peak.location, FUGE_PEAK_INSIDE);
  peak = untouched();
  CHECK_STATUS(fuge_smooth_peak(smooth, 7, 0.3, FUGE_MEASURE_TRESCA, &peak, NULL, 0), FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_smooth_peak(NULL, FUGE_PLANE_STRAIN, 0.3, FUGE_MEASURE_TRESCA, &peak, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_smooth_peak(smooth, FUGE_PLANE_STRAIN, 0.3, FUGE_MEASURE_TRESCA, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_round_peak(round, 0.7, FUGE_MEASURE_TRESCA, &peak, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_round_peak(NULL, 0.3, FUGE_MEASURE_TRESCA, &peak, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&peak.value, 1);
  fuge_smooth_free(&smooth);
  fuge_round_free(&round);
}

/* A square under uniform pressure, the same as a quarter. */
static void test_square(void) {
  static const double x[4] = {-0.5, 0.5, -0.5, 0.5}, y[4] = {-0.5, -0.5, 0.5, 0.5}, one[4] = {1, 1, 1, 1};
  static const double four = 4.0;
  fuge_stress_peak whole = untouched(), quarter = untouched();
  CHECK_DONE(fuge_halfspace_peak(4, x, y, one, one, one, 0.3, 0, 0, FUGE_MEASURE_TRESCA, &whole, NULL, 0));
  CHECK_INT(whole.location, FUGE_PEAK_INSIDE);
  CHECK(whole.value > 0.6 && whole.value < 0.8);
  CHECK_DONE(fuge_halfspace_peak(1, x + 3, y + 3, one, one, &four, 0.3, 1, 1, FUGE_MEASURE_TRESCA, &quarter, NULL, 0));
  CHECK_NEAR(quarter.value, whole.value, 1e-10);
  CHECK(quarter.place[0] >= 0.0 && quarter.place[1] >= 0.0);
}

/* The pressure of a sphere with a = 1 and p_0 = 1 on rings. */
static void test_rings(void) {
  double radius[N + 1], force[N];
  fuge_stress_peak peak = untouched();
  for (int k = 0; k <= N; k++) radius[k] = (double)k / N;
  for (int k = 0; k < N; k++) {
    double inner = 1.0 - radius[k] * radius[k], outer = 1.0 - radius[k + 1] * radius[k + 1];
    force[k] = 2.0 / 3.0 * acos(-1.0) * (pow(inner, 1.5) - pow(outer, 1.5));
  }
  CHECK_DONE(fuge_ring_peak(N, radius, force, 0.3, FUGE_MEASURE_VON_MISES, &peak, NULL, 0));
  CHECK_NEAR(peak.value, 0.620, 1e-3);
  CHECK_NEAR(peak.place[2], 0.481, 2e-3);
  CHECK_NEAR(peak.place[0], 0.0, 1e-3);
}

static void test_refusals(void) {
  static const double one[2] = {1, 2}, minus[1] = {-1};
  fuge_stress_peak peak = untouched();
  char message[256] = "";
  CHECK_STATUS(fuge_halfplane_peak(0, one, one, one, FUGE_HAT, FUGE_PLANE_STRAIN, 0.3, 0, 0, &peak, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_halfplane_peak(1, NULL, one, one, FUGE_HAT, FUGE_PLANE_STRAIN, 0.3, 0, 0, &peak, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_SAYS(fuge_halfplane_peak(1, one, one, one, FUGE_HAT, FUGE_PLANE_STRAIN, 0.3, 0, 2, &peak, message,
                                 sizeof message), FUGE_ERR_OPTION, message, "measure = 2");
  CHECK_SAYS(fuge_halfplane_peak(1, one, one, one, FUGE_HAT, FUGE_PLANE_STRAIN, 0.3, 0, 0, NULL, message,
                                 sizeof message), FUGE_ERR_POINTER, message, "peak is NULL");
  CHECK_STATUS(fuge_halfspace_peak(1, one, one, minus, one, one, 0.3, 0, 0, 0, &peak, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_halfspace_peak(1, one, one, one, one, NULL, 0.3, 0, 0, 0, &peak, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_peak(0, one, one, 0.3, 0, &peak, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_ring_peak(1, one, NULL, 0.3, 0, &peak, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_peak(1, one, one, 0.3, 9, &peak, NULL, 0), FUGE_ERR_OPTION);
  CHECK_UNTOUCHED(&peak.value, 1);
}

int main(void) {
  test_halfplane();
  test_flat();
  test_punches();
  test_square();
  test_rings();
  test_refusals();
  return check_summary();
}
