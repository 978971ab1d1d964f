/* A roller on a plate: the stresses in the plate and where it yields first, from C.
 *
 *     c_stress
 *
 * Half of the cells are passed, because of the symmetry.  Below the middle of the contact the
 * stresses are compared with the exact ones, and the largest von Mises stress with the known
 * one. */
#include <math.h>
#include <stdio.h>
#include "fuge.h"

enum { N = 64, POINTS = 6 };
/* Steel on steel, N and mm; the load is that of 1 mm of the roller. */
static const double RADIUS = 10.0, YOUNG = 2.1e5, POISSON = 0.3, LOAD = 500.0;
static const double PI = 3.14159265358979324;
/* For nu = 0.3 in plane strain, over p_0, and its depth over the half width. */
static const double KNOWN_MISES = 0.557516, KNOWN_DEPTH = 0.704292;

static char message[FUGE_MESSAGE_LENGTH + 1];
/* Values compared with the exact ones, and those that are right; errors over p_0. */
static int compared = 0, right = 0;
static double worst = 0.0;

static void compare(double error, double allowed) {
  compared++;
  if (fabs(error) <= allowed) right++;
  if (!(fabs(error) <= worst)) worst = fabs(error);
}

static int failed(int status) {
  if (status == FUGE_DONE) return 0;
  fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
  return 1;
}

/* Forces on cells of equal widths; each is the sum over a cell and its mirror image. */
static int press(const double *x, const double *width, double e_star, double *force) {
  static double alpha[N * N], gap[N], open[N];
  double approach;

  for (int k = 0; k < N; k++) gap[k] = x[k] * x[k] / (2.0 * RADIUS);
  return failed(fuge_halfplane_matrix(N, x, width, e_star, FUGE_HAT, 1, alpha, N, message, sizeof message))
         || failed(fuge_solve_dense(N, alpha, N, gap, LOAD, force, open, &approach, message, sizeof message));
}

/* The table; not 0 if something failed. */
static int go_down(const fuge_field *field, double a, double p0) {
  double place[3 * POINTS] = {0.0}, tensor[6 * POINTS], mises[POINTS];

  for (int k = 0; k < POINTS; k++) place[3 * k + 2] = 0.4 * a * k;
  if (failed(fuge_field_stress(field, POINTS, place, NULL, tensor, message, sizeof message))
      || failed(fuge_measure_stresses(POINTS, tensor, NULL, mises, NULL, NULL, message, sizeof message)))
    return 1;
  printf("  z/a     xx/p0   exact      zz/p0   exact   von Mises/p0\n");
  for (int k = 0; k < POINTS; k++) {
    double z = place[3 * k + 2] / a, root = sqrt(1.0 + z * z);
    double xx = 2.0 * z - (1.0 + 2.0 * z * z) / root, zz = -1.0 / root;
    printf("%5.2f %9.4f %8.4f %9.4f %8.4f %11.4f\n", z, tensor[6 * k] / p0, xx, tensor[6 * k + 2] / p0, zz,
           mises[k] / p0);
    compare(tensor[6 * k] / p0 - xx, 1e-3);
    compare(tensor[6 * k + 2] / p0 - zz, 1e-3);
  }
  return 0;
}

int main(void) {
  double x[N], width[N], force[N], e_star = 0.5 * YOUNG / (1.0 - POISSON * POISSON);
  double a = sqrt(4.0 * LOAD * RADIUS / (PI * e_star)), p0 = 2.0 * LOAD / (PI * a);
  fuge_field *field = NULL;
  fuge_stress_peak peak;

  for (int k = 0; k < N; k++) {
    width[k] = 1.2 * a / N;
    x[k] = width[k] * (k + 0.5);
  }
  if (press(x, width, e_star, force)
      || failed(fuge_field_halfplane(N, x, width, force, FUGE_HAT, 1, YOUNG, POISSON, FUGE_PLANE_STRAIN, &field,
                                     message, sizeof message))
      || go_down(field, a, p0)
      || failed(fuge_field_largest(field, FUGE_MEASURE_VON_MISES, &peak, message, sizeof message)))
    return 1;
  fuge_field_free(&field);
  printf("largest von Mises stress %7.2f N/mm2, %.6f p0 at z = %.6f a\n", peak.value, peak.value / p0,
         peak.place[2] / a);
  printf("known                    %7.2f N/mm2, %.6f p0 at z = %.6f a\n", KNOWN_MISES * p0, KNOWN_MISES, KNOWN_DEPTH);
  compare(peak.value / p0 - KNOWN_MISES, 1e-4);
  printf("\nverdict: %d of %d against exact stresses, worst %.1E\n", right, compared, worst);
  return right != compared || peak.location != FUGE_PEAK_INSIDE;
}
