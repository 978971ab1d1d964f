/* Solvers in several threads at once: every engine, with operators of their own and shared ones, the paths,
 * files and refusals.  All answers and messages must be those of a run alone, bit for bit.
 *
 * The threads go first, so that whatever is prepared at a first call is prepared by several at once.
 * `threads_pthreads rounds` sets how often each thread does all of it. */
#define _POSIX_C_SOURCE 200112L
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include "check.h"

/* The area of LARGE cells along each side is large enough for threads of its solves. */
enum { THREADS = 4, N = 48, CELLS = 256, SIDE = 16, LARGE = 72, VALUES = 2400, TEXT = 2048 };
static const double LOAD = 1.0e-3;

typedef struct {
  int used, letters, failures;
  double value[VALUES];
  char text[TEXT];
} record;

/* Shared by all threads, which only read. */
typedef struct {
  double alpha[N * N];
  fuge_operator *dense, *cells, *area, *springs;
} ground;
static ground shared;

/* What one thread does, and its answers. */
typedef struct {
  int number, rounds;
  record answer;
  pthread_t thread;
} job;

static void put(record *r, const double *value, int n) {
  if (r->used + n > VALUES) n = VALUES - r->used;
  memcpy(r->value + r->used, value, (size_t)n * sizeof *value);
  r->used += n;
}

static void put_text(record *r, const char *text) {
  size_t n = strlen(text) + 1;
  if (r->letters + n > TEXT) return;
  memcpy(r->text + r->letters, text, n);
  r->letters += (int)n;
}

static void expect(record *r, int status, int expected) {
  if (status != expected) r->failures++;
}

static void make_gap(int n, int number, double *gap) {
  for (int k = 0; k < n; k++) {
    double x = k - 0.5 * (n - 1);
    gap[k] = 0.1 * (1.0 + 0.1 * number) * x * x / n / n + 1.0e-3 * sin(0.7 * k + number);
  }
}

static int spring(int n, const double *f, double *u, void *user) {
  const double *flexibility = user;
  for (int k = 0; k < n; k++) u[k] = *flexibility * f[k];
  return 0;
}

/* Three loads one after the other by one solver, whose solves have `threads` threads; results at N points about the
 * middle. */
static void solve_by(record *r, const fuge_operator *op, int n, int method, int threads, int number) {
  double gap[LARGE * LARGE], force[LARGE * LARGE], open[LARGE * LARGE], approach, rate;
  const int first = (n - N) / 2;
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_options options;
  fuge_solver *s = NULL;
  fuge_info info;
  fuge_default_options(&options);
  options.method = method;
  options.keep_history = method == FUGE_TABLEAU;
  options.threads = threads;
  make_gap(n, number, gap);
  expect(r, fuge_solver_new(op, &options, &s, NULL, 0), FUGE_DONE);
  expect(r, fuge_set_gap(s, gap, NULL), FUGE_DONE);
  for (int k = 1; k <= 3; k++) {
    expect(r, fuge_set_load(s, k * LOAD * (1.0 + 0.01 * number)), FUGE_DONE);
    expect(r, fuge_solve(s), FUGE_DONE);
    expect(r, fuge_get_force(s, force), FUGE_DONE);
    expect(r, fuge_get_gap(s, open), FUGE_DONE);
    expect(r, fuge_get_motion(s, &approach), FUGE_DONE);
    expect(r, fuge_get_info(s, &info), FUGE_DONE);
  }
  put(r, force + first, N);
  put(r, open + first, N);
  put(r, &approach, 1);
  put(r, &info.residual, 1);
  if (method != FUGE_ITERATIVE || threads > 1) {
    expect(r, fuge_get_derivatives(s, NULL, &ONE, force, NULL, &rate), FUGE_DONE);
    put(r, force + first, N);
    put(r, &rate, 1);
  }
  /* A refusal, with numbers in its message. */
  gap[number] = NAN;
  expect(r, fuge_set_gap(s, gap, NULL), FUGE_ERR_NOT_FINITE);
  fuge_solver_message(s, message, sizeof message);
  put_text(r, message);
  fuge_solver_free(&s);
}

static void solve(record *r, const fuge_operator *op, int n, int method, int number) {
  solve_by(r, op, n, method, 1, number);
}

static void follow(record *r, int number) {
  double gap[N], loads[2 * N], approach[2 * N], parameter[2 * N];
  double end = 3.0 * LOAD;
  int path_entries = 0, entries = 0;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_solver *s = NULL;
  make_gap(N, number, gap);
  expect(r, fuge_load_path(shared.dense, gap, end, 2 * N, loads, approach, NULL, NULL, NULL, NULL, &path_entries,
                           message, sizeof message), FUGE_DONE);
  put(r, loads, path_entries);
  put(r, approach, path_entries);
  expect(r, fuge_solver_new(shared.dense, NULL, &s, NULL, 0), FUGE_DONE);
  expect(r, fuge_set_gap(s, gap, NULL), FUGE_DONE);
  expect(r, fuge_set_load(s, LOAD), FUGE_DONE);
  expect(r, fuge_follow_path(s, &end, 2 * N, parameter, NULL, NULL, NULL, NULL, NULL, &entries), FUGE_DONE);
  put(r, parameter, entries);
  end = -(1.0 + number);
  expect(r, fuge_follow_path(s, &end, 2 * N, parameter, NULL, NULL, NULL, NULL, NULL, &entries),
         FUGE_ERR_NO_EQUILIBRIUM);
  fuge_solver_message(s, message, sizeof message);
  put_text(r, message);
  fuge_solver_free(&s);
}

/* Files have a lock of their own. */
static void write_grid(record *r, int number) {
  const double spacing[2] = {1.0, 1.0}, values[2] = {number, 0.5};
  const double *const results[1] = {values};
  const char *const names[1] = {"p"};
  char message[FUGE_MESSAGE_LENGTH + 1] = "", path[64];
  snprintf(path, sizeof path, "threads_scratch_%d.vti", number);
  expect(r, fuge_write_results(path, 2, 1, spacing, NULL, 1, names, results, message, sizeof message), FUGE_DONE);
  remove(path);
  snprintf(path, sizeof path, "there_is_no_folder_%d/p.vti", number);
  expect(r, fuge_write_results(path, 2, 1, spacing, NULL, 1, names, results, message, sizeof message), FUGE_ERR_FILE);
  put_text(r, message);
}

/* A matrix that is refused. */
static void refuse(record *r, int number) {
  double alpha[N * N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  memcpy(alpha, shared.alpha, sizeof alpha);
  alpha[9 + number * N] += 1.0;
  expect(r, fuge_operator_dense(N, alpha, N, &op, message, sizeof message), FUGE_ERR_NOT_SYMMETRIC);
  put_text(r, message);
}

/* An operator of one's own, made and freed while others are made and used. */
static void solve_own_cells(record *r, int number) {
  fuge_operator *own = NULL;
  expect(r, fuge_operator_halfplane(CELLS - 2 * number, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &own, NULL, 0), FUGE_DONE);
  solve(r, own, CELLS - 2 * number, FUGE_ITERATIVE, number);
  fuge_operator_free(&own);
}

/* Threads of the solves of an area of one's own. One in a single round, for helgrind: it takes it for a race that glibc
 * gives the stack of a thread that has ended to another one. */
static int solve_threads = 3;

/* An area of one's own. */
static void solve_own_area(record *r, int number) {
  fuge_operator *own = NULL;
  expect(r, fuge_operator_halfspace(LARGE, LARGE - number, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_PERIODIC, &own, NULL, 0),
         FUGE_DONE);
  solve_by(r, own, LARGE * (LARGE - number), FUGE_ITERATIVE, solve_threads, number);
  fuge_operator_free(&own);
}

static void part(record *r, int which, int number) {
  switch (which) {
    case 0: solve_own_cells(r, number); break;
    case 1: solve(r, shared.dense, N, FUGE_TABLEAU, number); break;
    case 2: solve(r, shared.dense, N, FUGE_ACTIVE_SET, number); break;
    case 3: solve(r, shared.cells, CELLS, FUGE_ITERATIVE, number); break;
    case 4: solve(r, shared.springs, N, FUGE_ITERATIVE, number); break;
    case 5: follow(r, number); break;
    case 6: write_grid(r, number); break;
    case 7: solve(r, shared.area, CELLS, FUGE_ITERATIVE, number); break;
    case 8: solve_own_area(r, number); break;
    default: refuse(r, number);
  }
}

enum { PARTS = 10 };

/* The first plans that FFTW makes in this process. */
static void *make_first_plans(void *data) {
  job *j = data;
  solve_own_cells(&j->answer, j->number);
  return NULL;
}

/* In each round a thread begins with another part. */
static void *work(void *data) {
  job *j = data;
  record parts[PARTS];
  for (int round = 0; round < j->rounds; round++) {
    memset(parts, 0, sizeof parts);
    for (int k = 0; k < PARTS; k++) {
      int which = (k + round * j->number) % PARTS;
      part(&parts[which], which, j->number);
    }
    for (int which = 0; which < PARTS; which++) {
      record *r = &parts[which];
      put(&j->answer, r->value, r->used);
      for (int k = 0; k < r->letters; k += (int)strlen(r->text + k) + 1) put_text(&j->answer, r->text + k);
      j->answer.failures += r->failures;
    }
    if (round + 1 < j->rounds) j->answer.used = j->answer.letters = 0;
  }
  return NULL;
}

static void make_ground(void) {
  static double flexibility = 1.0;
  double x[N], width[N];
  for (int k = 0; k < N; k++) {
    x[k] = k;
    width[k] = 1.0;
  }
  CHECK_DONE(fuge_halfplane_matrix(N, x, width, 1.0, FUGE_MEAN, 0, shared.alpha, N, NULL, 0));
  CHECK_DONE(fuge_operator_dense(N, shared.alpha, N, &shared.dense, NULL, 0));
  CHECK_DONE(fuge_operator_halfplane(CELLS, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &shared.cells, NULL, 0));
  CHECK_DONE(fuge_operator_halfspace(SIDE, SIDE, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &shared.area, NULL, 0));
  CHECK_DONE(fuge_operator_callback(N, spring, &flexibility, &shared.springs, NULL, 0));
}

static void free_ground(void) {
  fuge_operator_free(&shared.dense);
  fuge_operator_free(&shared.springs);
  fuge_operator_free(&shared.cells);
  fuge_operator_free(&shared.area);
}

static void run_all(job *jobs, void *(*function)(void *)) {
  for (int k = 0; k < THREADS; k++) CHECK_INT(pthread_create(&jobs[k].thread, NULL, function, &jobs[k]), 0);
  for (int k = 0; k < THREADS; k++) CHECK_INT(pthread_join(jobs[k].thread, NULL), 0);
}

/* Do the same alone, and compare. */
static void compare(const job *together, void *(*function)(void *)) {
  job *alone = calloc(1, sizeof *alone);
  CHECK(alone != NULL);
  if (!alone) return;
  alone->number = together->number;
  alone->rounds = 1;
  function(alone);
  const record *a = &alone->answer, *b = &together->answer;
  CHECK_INT(a->failures, 0);
  CHECK_INT(b->failures, 0);
  CHECK(a->used > 2 * N && a->used < VALUES && a->letters > 0 && a->letters < TEXT);
  CHECK_INT(b->used, a->used);
  CHECK_INT(b->letters, a->letters);
  CHECK(memcmp(b->value, a->value, (size_t)a->used * sizeof *a->value) == 0);
  CHECK(memcmp(b->text, a->text, (size_t)a->letters) == 0);
  free(alone);
}

int main(int argc, char **argv) {
  job *first = calloc(THREADS, sizeof *first), *jobs = calloc(THREADS, sizeof *jobs);
  CHECK(first != NULL && jobs != NULL);
  if (!first || !jobs) return check_summary();
  for (int k = 0; k < THREADS; k++) {
    first[k].number = jobs[k].number = k + 1;
    jobs[k].rounds = argc > 1 ? atoi(argv[1]) : 5;
  }
  if (jobs[0].rounds == 1) solve_threads = 1;
  run_all(first, make_first_plans);
  make_ground();
  run_all(jobs, work);
  for (int k = 0; k < THREADS; k++) {
    compare(&first[k], make_first_plans);
    compare(&jobs[k], work);
  }
  free_ground();
  free(first);
  free(jobs);
  return check_summary();
}
