/* A rough profile on an elastic half-plane with an operator of your own.
 *
 *     c_rough [cells [limit]]
 *
 * The scene of examples/fortran/rough.f90: a self-affine profile with the period 1, E* = 1,
 * cells a power of two.  fuge knows the half-plane by two functions only: the product
 * u = A f, here by FFTW, and an inverse of it; and because its cells form a grid, by the same
 * functions on coarser grids.  Each saves many products.  Replace them by those of a layer, a
 * viscoelastic body, a finite element model.  The built-in operator solves the same scene:
 * forces have to agree, and it takes as many products.  limit > 0: cancel a solve after this many
 * iterations. */
#include <fftw3.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "fuge.h"

static const double PI = 3.14159265358979323846;
static const double HURST = 0.8, SLOPE = 0.1;
enum { LONGEST = 4, SHORTEST = 16, SEED = 2026 };   /* period/4 to 16 cells */
enum { MOST_GRIDS = 32, FEWEST_CELLS = 32, LOADS = 10 };

/* ---- the operator: what user points to ----------------------------------- */

typedef struct half_plane {
  int n;
  double *compliance;           /* eigenvalue of A for the wave of m periods, m = 0 .. n/2 */
  double *value;                /* n, before and after the transforms */
  fftw_complex *wave;
  fftw_plan forward, back;
} half_plane;

/* Displacement by a wave of forces, m periods on n cells, fraction = m/n.  A pressure wave
 * cos(q x) moves the surface by 2/(E* |q|) cos(q x).  Forces on cells are steps: they hold
 * all waves that look alike at the cells, (j + fraction) periods a cell, and so does the
 * mean displacement of a cell; the sine over its angle is the part of a wave in both.
 * With the wave j = 0 alone, 1/(pi fraction), it would be another element, smooth
 * pressures, and the forces would differ by some (pi fraction)^2. */
static double wave_compliance(double fraction) {
  enum { WAVES = 40 };
  double sum = 0.0;
  for (int side = 0; side < 2; side++) {
    double first = side == 0 ? fraction : 1.0 - fraction;
    for (int j = 0; j < WAVES; j++) sum += pow(first + j, -3);
    /* The rest by the formula of Euler and Maclaurin. */
    double x = first + WAVES;
    sum += 0.5 / (x * x) + 0.5 / pow(x, 3) + 0.25 / pow(x, 4) - 1.0 / (12.0 * pow(x, 6));
  }
  return pow(sin(PI * fraction), 2) / pow(PI, 3) * sum;
}

static void transform(half_plane *body, const double *from, double *to, int inverse) {
  size_t bytes = (size_t)body->n * sizeof *from;
  memcpy(body->value, from, bytes);
  fftw_execute(body->forward);
  for (int m = 0; m <= body->n / 2; m++) {
    double factor = (inverse ? 1.0 / body->compliance[m] : body->compliance[m]) / body->n;
    /* Displacements count from their mean: a force equal on all cells moves nothing. */
    if (m == 0 && !inverse) factor = 0.0;
    body->wave[m][0] *= factor;
    body->wave[m][1] *= factor;
  }
  fftw_execute(body->back);
  memcpy(to, body->value, bytes);
}

static int product(int n, const double *force, double *displacement, void *user) {
  half_plane *body = user;
  if (n != body->n) return 1;
  transform(body, force, displacement, 0);
  return 0;
}

static int preconditioner(int n, const double *length, double *force, void *user) {
  half_plane *body = user;
  if (n != body->n) return 1;
  transform(body, length, force, 1);
  return 0;
}

static void *reserve(int count, size_t size) {
  void *memory = fftw_malloc((size_t)count * size);
  if (!memory) {
    fprintf(stderr, "no memory for %d cells\n", count);
    exit(EXIT_FAILURE);
  }
  return memory;
}

static void make_half_plane(int n, half_plane *body) {
  body->n = n;
  body->compliance = reserve(n / 2 + 1, sizeof(double));
  body->value = reserve(n, sizeof(double));
  body->wave = reserve(n / 2 + 1, sizeof(fftw_complex));
  body->forward = fftw_plan_dft_r2c_1d(n, body->value, body->wave, FFTW_ESTIMATE);
  body->back = fftw_plan_dft_c2r_1d(n, body->wave, body->value, FFTW_ESTIMATE);
  for (int m = 1; m <= n / 2; m++) body->compliance[m] = wave_compliance((double)m / n);
  /* For the inverse only, which has to be positive for all lengths. */
  body->compliance[0] = body->compliance[1];
}

static void free_half_plane(half_plane *body) {
  fftw_destroy_plan(body->forward);
  fftw_destroy_plan(body->back);
  fftw_free(body->compliance);
  fftw_free(body->value);
  fftw_free(body->wave);
}

static char message[FUGE_MESSAGE_LENGTH + 1];

/* Mean size of the coefficients, from the displacements by one force.  In nearly complete contact
 * displacements are small beside these terms, and can be no more exact than they are. */
static double mean_coefficient(half_plane *body) {
  double *force = reserve(body->n, sizeof *force), *displacement = reserve(body->n, sizeof *force), sum = 0.0;
  memset(force, 0, (size_t)body->n * sizeof *force);
  force[0] = 1.0;
  product(body->n, force, displacement, body);
  for (int k = 0; k < body->n; k++) sum += fabs(displacement[k]);
  fftw_free(force);
  fftw_free(displacement);
  return sum / body->n;
}

/* The half-plane on n cells, op[0], and on n/2, n/4, ... cells of the same period, from which
 * solves get their start.  grids: how many have been made, whatever the status. */
static int make_own_operators(int n, half_plane *body, fuge_operator **op, int *grids) {
  int status = FUGE_DONE;
  for (*grids = 0; n >= FEWEST_CELLS && status == FUGE_DONE; n /= 2) {
    int k = (*grids)++;
    make_half_plane(n, &body[k]);
    status = fuge_operator_callback(n, product, &body[k], &op[k], message, sizeof message);
    if (status == FUGE_DONE) status = fuge_operator_set_preconditioner(op[k], preconditioner, message, sizeof message);
    if (status == FUGE_DONE) status = fuge_operator_set_coefficients(op[k], 0.0, mean_coefficient(&body[k]), message,
                                                                     sizeof message);
    if (status == FUGE_DONE) status = fuge_operator_set_grid(op[k], n, 1, message, sizeof message);
    if (status == FUGE_DONE && k > 0) status = fuge_operator_set_coarser(op[k - 1], op[k], message, sizeof message);
  }
  return status;
}

/* ---- the profile --------------------------------------------------------- */

/* "Minimal standard" generator, as in the Fortran example: the same profile. */
static double random_number(uint64_t *state) {
  *state = 48271u * *state % 2147483647u;
  return (double)*state / 2147483647.0;
}

/* Gap below a flat body: highest point less the height, a sum of cosines with random
 * phases and amplitudes m^-(1/2 + H).  Uses the transform's arrays. */
static void make_gap(half_plane *body, double *gap) {
  int n = body->n;
  uint64_t state = SEED;
  double square = 0.0, highest = -INFINITY;
  memset(body->wave, 0, (size_t)(n / 2 + 1) * sizeof *body->wave);
  for (int m = LONGEST; m <= n / SHORTEST; m++) {
    double amplitude = pow(m, -0.5 - HURST), phase = 2.0 * PI * random_number(&state);
    body->wave[m][0] = 0.5 * amplitude * cos(phase);
    body->wave[m][1] = 0.5 * amplitude * sin(phase);
    square += 0.5 * pow(2.0 * PI * m * amplitude, 2);
  }
  fftw_execute(body->back);
  for (int k = 0; k < n; k++) highest = fmax(highest, body->value[k]);
  for (int k = 0; k < n; k++) gap[k] = SLOPE / sqrt(square) * (highest - body->value[k]);
}

/* ---- solves -------------------------------------------------------------- */

/* Progress; user points to the limit. */
static int watch(int iteration, double residual, int contacts, void *user) {
  int limit = *(int *)user;
  if (limit > 0) fprintf(stderr, "  iteration %d: residual %.1e, %d cells touch\n", iteration, residual, contacts);
  return limit > 0 && iteration >= limit;
}

/* Prints what went wrong, if anything did.  solver: NULL if the call has written to message. */
static int explain(int status, const fuge_solver *solver) {
  if (status == FUGE_DONE) return status;
  if (solver) fuge_solver_message(solver, message, sizeof message);
  fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
  return status;
}

static int prepare(const fuge_operator *op, const double *gap, int *limit, fuge_solver **solver) {
  int status = fuge_solver_new(op, NULL, solver, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_set_gap(*solver, gap, NULL);
  if (status == FUGE_DONE) status = fuge_set_progress(*solver, watch, limit);
  return explain(status, *solver);
}

static int press(fuge_solver *solver, double load, double *force, double *approach, fuge_info *info) {
  int status = fuge_set_load(solver, load);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  if (status == FUGE_DONE) status = fuge_get_force(solver, force);
  if (status == FUGE_DONE) status = fuge_get_motion(solver, approach);
  if (status == FUGE_DONE) status = fuge_get_info(solver, info);
  return explain(status, solver);
}

static double largest_of(int n, const double *force) {
  double largest = 0.0;
  for (int k = 0; k < n; k++) largest = fmax(largest, force[k]);
  return largest;
}

static double largest_difference(int n, const double *a, const double *b) {
  double largest = 0.0;
  for (int k = 0; k < n; k++) largest = fmax(largest, fabs(a[k] - b[k]));
  return largest;
}

/* What a certificate says of the forces: its residual is that of the gaps, relative to
 * lengths of at most four approaches.  Forces that alternate from cell to cell make the
 * smallest gaps, so they are known the least. */
static double force_error(double residual, double approach) {
  return residual * 4.0 * approach / wave_compliance(0.5);
}

/* From large to small loads; forces of the last load are the start where it is near. */
static int all_loads(int n, fuge_solver *own, fuge_solver *builtin) {
  double *force = reserve(n, sizeof(double)), *expected = reserve(n, sizeof(double));
  int status = FUGE_DONE, right = 0;
  double worst = 0.0;
  puts("                                  own operator           built-in operator   largest force over it");
  puts("   p/E*  contact    approach  products  precond.     products  precond.   differs by  certified");
  for (int k = 0; k < LOADS; k++) {
    double load = 0.05 * pow(0.8, k), approach, other;   /* the period is 1: mean pressure = load */
    fuge_info info, info_builtin;
    status = press(own, load, force, &approach, &info);
    if (status == FUGE_DONE) status = press(builtin, load, expected, &other, &info_builtin);
    if (status != FUGE_DONE) break;
    double largest = largest_of(n, expected), apart = largest_difference(n, force, expected);
    double certified = force_error(info.residual + info_builtin.residual, approach);
    if (apart <= certified) right++;
    if (!(apart / largest <= worst)) worst = apart / largest;
    printf("%7.5f %8.5f %11.4e %9d %9d %12d %9d %12.1e %10.1e\n", load, (double)info.contacts / n, approach,
           info.products, info.preconditionings, info_builtin.products, info_builtin.preconditionings, apart / largest,
           certified / largest);
  }
  fftw_free(force);
  fftw_free(expected);
  if (status != FUGE_DONE) return status;
  printf("\nverdict: %d of %d forces as by the built-in operator, worst %.1E\n", right, LOADS, worst);
  return right == LOADS ? FUGE_DONE : 1;
}

int main(int argc, char **argv) {
  int n = argc > 1 ? atoi(argv[1]) : 65536, limit = argc > 2 ? atoi(argv[2]) : 0;
  if (n < 1024 || (n & (n - 1)) != 0) {
    fprintf(stderr, "usage: c_rough [cells, a power of two from 1024 on [limit]]\n");
    return EXIT_FAILURE;
  }
  static half_plane body[MOST_GRIDS];
  fuge_operator *own[MOST_GRIDS] = {NULL}, *builtin = NULL;
  fuge_solver *own_solver = NULL, *builtin_solver = NULL;
  double *gap = reserve(n, sizeof *gap);
  int grids, status = make_own_operators(n, body, own, &grids);
  if (status == FUGE_DONE) status = fuge_operator_halfplane(n, 1.0 / n, 1.0, FUGE_MEAN, FUGE_PERIODIC, &builtin,
                                                            message, sizeof message);
  explain(status, NULL);
  if (status == FUGE_DONE) make_gap(&body[0], gap);
  if (status == FUGE_DONE) status = prepare(own[0], gap, &limit, &own_solver);
  if (status == FUGE_DONE) status = prepare(builtin, gap, &limit, &builtin_solver);
  if (status == FUGE_DONE) status = all_loads(n, own_solver, builtin_solver);

  fuge_solver_free(&own_solver);
  fuge_solver_free(&builtin_solver);
  fuge_operator_free(&builtin);
  for (int k = 0; k < grids; k++) {
    fuge_operator_free(&own[k]);
    free_half_plane(&body[k]);
  }
  fftw_free(gap);
  return status == FUGE_DONE ? EXIT_SUCCESS : EXIT_FAILURE;
}
