/* A ball on a plane, on a grid of cells: an area of contact from C, against Hertz.
 *
 *     c_ball [cells]
 *
 * A grid of cells x cells, 256 unless given, a little larger than the contact.  Point i + n*j is
 * the cell i along x and j along y.  The load is raised step by step; each solve starts from the
 * contact of the one before. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "fuge.h"

/* Steel on steel, N and mm. */
static const double E_STAR = 1.15e5, RADIUS = 10.0, LARGEST_LOAD = 100.0;
/* The grid ends this many radii of the largest contact from the middle. */
static const double COVERED = 1.2;
enum { LOADS = 5 };

static char message[FUGE_MESSAGE_LENGTH + 1];
/* Of the values compared with Hertz. */
static int right = 0;
static double worst = 0.0;

/* Prints what went wrong, if anything did.  solver: NULL if the call has written to message. */
static int failed(int status, const fuge_solver *solver) {
  if (status == FUGE_DONE) return 0;
  if (solver) fuge_solver_message(solver, message, sizeof message);
  fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
  return 1;
}

/* The gap is that in the mean over each cell, as FUGE_MEAN needs. */
static void fill_gap(int n, double spacing, double *gap) {
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      double x = spacing * (i - 0.5 * (n - 1)), y = spacing * (j - 0.5 * (n - 1));
      gap[i + (size_t)n * j] = (x * x + y * y + spacing * spacing / 6.0) / (2.0 * RADIUS);
    }
}

/* The radius of the contact from the second moment of the forces: the mean of x^2 + y^2 under
 * the pressure of Hertz is 2/5 of its square. */
static double contact_radius(int n, double spacing, const double *force) {
  double sum = 0.0, moment = 0.0;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      double x = spacing * (i - 0.5 * (n - 1)), y = spacing * (j - 0.5 * (n - 1));
      double f = force[i + (size_t)n * j];
      sum += f;
      moment += f * (x * x + y * y + spacing * spacing / 6.0);
    }
  return sqrt(2.5 * moment / sum);
}

static double largest_of(int n, const double *force) {
  double largest = 0.0;
  for (int k = 0; k < n; k++) largest = fmax(largest, force[k]);
  return largest;
}

/* What is allowed is between two and ten times what is observed. */
static void compare(double error, int n) {
  if (fabs(error) <= 8.0 / pow(n, 1.5)) right++;
  if (!(fabs(error) <= worst)) worst = fabs(error);
}

/* A line of the table; not 0 if something failed. */
static int press(fuge_solver *solver, int n, double spacing, double load, double *force) {
  double approach, radius, pressure, a, delta, p0;
  fuge_info info;
  if (failed(fuge_hertz_ellipse(RADIUS, RADIUS, E_STAR, load, &a, NULL, &delta, &p0, message, sizeof message), NULL)
      || failed(fuge_set_load(solver, load), solver) || failed(fuge_solve(solver), solver)
      || failed(fuge_get_force(solver, force), solver) || failed(fuge_get_motion(solver, &approach), solver)
      || failed(fuge_get_info(solver, &info), solver)) return 1;
  radius = contact_radius(n, spacing, force);
  pressure = largest_of(n * n, force) / (spacing * spacing);
  printf("%8.1f %9d %12.6f %8.1e %14.6f %8.1e %14.4f %8.1e %10d\n", load, info.contacts, radius, radius / a - 1.0,
         approach, approach / delta - 1.0, pressure / 1e3, pressure / p0 - 1.0, info.products);
  compare(radius / a - 1.0, n);
  compare(approach / delta - 1.0, n);
  compare(pressure / p0 - 1.0, n);
  return 0;
}

int main(int argc, char **argv) {
  int n = argc > 1 ? atoi(argv[1]) : 256, bad;
  double a, spacing, *gap, *force;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  if (n < 16 || n > 8192) {
    fprintf(stderr, "usage: c_ball [cells, 16 to 8192]\n");
    return EXIT_FAILURE;
  }
  gap = malloc((size_t)n * n * sizeof *gap);
  force = malloc((size_t)n * n * sizeof *force);
  bad = !gap || !force;
  if (bad) fprintf(stderr, "no memory for %d x %d cells\n", n, n);
  if (!bad) bad = failed(fuge_hertz_ellipse(RADIUS, RADIUS, E_STAR, LARGEST_LOAD, &a, NULL, NULL, NULL, message,
                                            sizeof message), NULL);
  if (!bad) {
    spacing = 2.0 * COVERED * a / n;
    fill_gap(n, spacing, gap);
    bad = failed(fuge_operator_halfspace(n, n, spacing, spacing, E_STAR, FUGE_MEAN, FUGE_FREE, &op, message,
                                         sizeof message), NULL)
          || failed(fuge_solver_new(op, NULL, &solver, message, sizeof message), NULL)
          || failed(fuge_set_gap(solver, gap, NULL), solver);
  }
  if (!bad) {
    printf("%d x %d cells of %.5f mm\n", n, n, spacing);
    printf("%8s %9s %12s %8s %14s %8s %14s %8s %10s\n", "load [N]", "contacts", "radius [mm]", "error",
           "approach [mm]", "error", "pressure [GPa]", "error", "products");
  }
  for (int k = 1; k <= LOADS && !bad; k++) bad = press(solver, n, spacing, LARGEST_LOAD * k / LOADS, force);
  if (!bad) {
    printf("\nverdict: %d of %d against Hertz, worst %.1E\n", right, 3 * LOADS, worst);
    bad = right != 3 * LOADS;
  }
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  free(gap);
  free(force);
  return bad ? EXIT_FAILURE : EXIT_SUCCESS;
}
