/* Solves in a thread with STACK_KB of stack: 128 kB, which is what musl gives a thread, or what the manual says of the
 * compiler. Answers must be those of a large stack. */
#define _POSIX_C_SOURCE 200112L
#include <pthread.h>
#include <stdlib.h>
#include "check.h"

enum { SIDE = 12, N = SIDE * SIDE, POINTS = 40, RINGS = 6, LARGE = 4 << 20, SMALL = STACK_KB << 10 };

typedef struct {
  int failures;
  double force[3][N], stress[3][6 * POINTS];
} record;

static void expect(record *r, int status) {
  if (status != FUGE_DONE) r->failures++;
}

/* The stresses at all points; the field is freed. */
static void ask(record *r, fuge_field *field, const double *place, double *stress) {
  expect(r, fuge_field_stress(field, POINTS, place, NULL, stress, NULL, 0));
  fuge_field_free(&field);
}

static void solve(record *r, const fuge_operator *op, int method, double *force) {
  double gap[N];
  fuge_options options;
  fuge_solver *s = NULL;
  for (int k = 0; k < N; k++) {
    gap[k] = 0.01 * ((k % SIDE - 5.5) * (k % SIDE - 5.5) + (k / SIDE - 5.5) * (k / SIDE - 5.5));
  }
  fuge_default_options(&options);
  options.method = method;
  options.threads = 1;
  expect(r, fuge_solver_new(op, &options, &s, NULL, 0));
  expect(r, fuge_set_gap(s, gap, NULL));
  expect(r, fuge_set_load(s, 1.0));
  expect(r, fuge_solve(s));
  expect(r, fuge_get_force(s, force));
  fuge_solver_free(&s);
}

/* The area by a matrix, from cells of a grid and from others, and by FFT; stresses below it, a line and rings. */
static void *work(void *result) {
  record *r = result;
  double *alpha = malloc(sizeof(double) * N * N), x[N], y[N], width[N], force[N];
  double place[3 * POINTS], radius[RINGS + 1], pressure[RINGS];
  fuge_operator *op = NULL;
  fuge_field *field = NULL;
  for (int k = 0; k < N; k++) {
    x[k] = k % SIDE;
    y[k] = k / SIDE;
    width[k] = 1.0;
    force[k] = 1.0 + 0.1 * (k % 7);
  }
  for (int k = 0; k < POINTS; k++) {
    place[3 * k] = 0.3 * k;
    place[3 * k + 1] = 5.0;
    place[3 * k + 2] = 0.1 + 0.05 * k;
  }
  for (int k = 0; k <= RINGS; k++) radius[k] = 0.5 * k;
  for (int k = 0; k < RINGS; k++) pressure[k] = 1.0 + k;
  expect(r, fuge_halfspace_matrix(N, x, y, width, width, 1.0, FUGE_MEAN, 0, 0, alpha, N, NULL, 0));
  expect(r, fuge_operator_dense(N, alpha, N, &op, NULL, 0));
  solve(r, op, FUGE_ACTIVE_SET, r->force[0]);
  fuge_operator_free(&op);
  expect(r, fuge_operator_halfspace(SIDE, SIDE, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &op, NULL, 0));
  solve(r, op, FUGE_ITERATIVE, r->force[1]);
  fuge_operator_free(&op);
  width[3] = 0.5;
  expect(r, fuge_halfspace_matrix(N, x, y, width, width, 1.0, FUGE_MEAN, 0, 0, alpha, N, NULL, 0));
  expect(r, fuge_operator_dense(N, alpha, N, &op, NULL, 0));
  solve(r, op, FUGE_TABLEAU, r->force[2]);
  fuge_operator_free(&op);
  expect(r, fuge_field_halfspace(N, x, y, width, width, force, 0, 0, 1.0, 0.3, &field, NULL, 0));
  ask(r, field, place, r->stress[0]);
  expect(r, fuge_field_halfplane(SIDE, x, width, force, FUGE_MEAN, 0, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, NULL, 0));
  ask(r, field, place, r->stress[1]);
  expect(r, fuge_field_rings(RINGS, radius, pressure, 1.0, 0.3, &field, NULL, 0));
  ask(r, field, place, r->stress[2]);
  free(alpha);
  return NULL;
}

static void run(record *r, size_t stack) {
  pthread_t thread;
  pthread_attr_t attributes;
  CHECK_INT(pthread_attr_init(&attributes), 0);
  CHECK_INT(pthread_attr_setstacksize(&attributes, stack), 0);
  CHECK_INT(pthread_create(&thread, &attributes, work, r), 0);
  CHECK_INT(pthread_join(thread, NULL), 0);
  CHECK_INT(pthread_attr_destroy(&attributes), 0);
  CHECK_INT(r->failures, 0);
}

int main(void) {
  record *large = calloc(1, sizeof *large), *small = calloc(1, sizeof *small);
  CHECK(large && small);
  if (large && small) {
    run(small, SMALL);
    run(large, LARGE);
    CHECK(large->force[0][N / 2 + SIDE / 2] > 0.0 && large->stress[0][0] < 0.0 && large->stress[2][0] < 0.0);
    CHECK(memcmp(small, large, sizeof *small) == 0);
  }
  free(large);
  free(small);
  return check_summary();
}
