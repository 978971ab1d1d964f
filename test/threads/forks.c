/* Processes that are forked after solves in several threads, in the middle of one, and while other threads solve and
 * plan, solve in several threads themselves.  Answers must be those of the first process, bit for bit.
 *
 * POSIX lets a child of a process with several threads call very little; with the C libraries that let it allocate
 * memory fuge works.  A child that does not end within its time limit is killed, and has failed. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include "check.h"

enum { CELLS = 16384, SIDE = 96, SMALL = 600, THREADS = 2, LIMIT = 20, ROUNDS = 20 };

/* The address sanitizer's allocator may be locked by another thread at a fork, for ever. */
#ifdef __SANITIZE_ADDRESS__
enum { FORKS_BESIDE_THREADS = 0 };
#else
enum { FORKS_BESIDE_THREADS = 1 };
#endif

static fuge_operator *line, *area;
static double line_force[CELLS], area_force[SIDE * SIDE], small_force[SMALL];

static void make_gap(int n, double *gap) {
  for (int k = 0; k < n; k++) {
    double x = (k - 0.5 * (n - 1)) / n;
    gap[k] = x * x;
  }
}

/* Forces of the load 0.01, by a solve that calls `progress`; 0 if all went well. */
static int solve_with(fuge_progress progress, const fuge_operator *op, int n, double *force) {
  fuge_options options;
  fuge_solver *s = NULL;
  double *gap = malloc((size_t)n * sizeof *gap);
  int failed = gap == NULL;
  if (failed) return failed;
  make_gap(n, gap);
  fuge_default_options(&options);
  options.threads = THREADS;
  failed = fuge_solver_new(op, &options, &s, NULL, 0) || fuge_set_progress(s, progress, NULL) ||
           fuge_set_gap(s, gap, NULL) || fuge_set_load(s, 1.0e-2) || fuge_solve(s) || fuge_get_force(s, force);
  fuge_solver_free(&s);
  free(gap);
  return failed;
}

static int solve(const fuge_operator *op, int n, double *force) { return solve_with(NULL, op, n, force); }

static int new_line(int n, fuge_operator **op) {
  return fuge_operator_halfplane(n, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, op, NULL, 0);
}

static int new_area(fuge_operator **op) {
  return fuge_operator_halfspace(SIDE, SIDE, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, op, NULL, 0);
}

static int differs_with(fuge_progress progress, const fuge_operator *op, int n, const double *expected) {
  double *force = malloc((size_t)n * sizeof *force);
  int bad = force == NULL || solve_with(progress, op, n, force) ||
            memcmp(force, expected, (size_t)n * sizeof *force) != 0;
  free(force);
  return bad;
}

static int differs(const fuge_operator *op, int n, const double *expected) {
  return differs_with(NULL, op, n, expected);
}

/* Does a run with operators of its own give the same answers? */
static int differs_anew(void) {
  fuge_operator *own_line = NULL, *own_area = NULL;
  int bad = new_line(CELLS, &own_line) || new_area(&own_area) || differs(own_line, CELLS, line_force) ||
            differs(own_area, SIDE * SIDE, area_force);
  fuge_operator_free(&own_line);
  fuge_operator_free(&own_area);
  return bad;
}

/* With the operators of the parent, which the child frees, and with its own. */
static int solve_all(void) {
  int bad = differs(line, CELLS, line_force) || differs(area, SIDE * SIDE, area_force) || differs_anew();
  fuge_operator_free(&line);
  fuge_operator_free(&area);
  return bad;
}

/* Fork, run `work` in the child, and return what it returns; -1 if it had to be killed. */
static int in_child(int (*work)(void)) {
  int status = 0;
  pid_t child;
  fflush(stdout);
  child = fork();
  if (child == 0) {
    alarm(LIMIT);
    _exit(work());
  }
  if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

/* Is this a process that fork_in_solve has forked? How many there are, and how many of them have failed. */
static int is_forked, forks, failed_forks;

/* A progress monitor that forks in each iteration; both processes go on with the solve. */
static int fork_in_solve(int iteration, double residual, int contacts, void *user) {
  int status = 0;
  pid_t child;
  (void)iteration;
  (void)residual;
  (void)contacts;
  (void)user;
  if (is_forked) return 0;
  fflush(stdout);
  child = fork();
  if (child == 0) {
    is_forked = 1;
    alarm(LIMIT);
    return 0;
  }
  forks++;
  failed_forks += child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  return 0;
}

/* A child that is forked in the middle of a solve finishes it alone, and solves again in threads of its own. */
static void fork_during_solve(const fuge_operator *op, int n, const double *expected) {
  int bad = differs_with(fork_in_solve, op, n, expected);
  if (is_forked) _exit(bad || differs(op, n, expected));
  CHECK_INT(bad, 0);
  CHECK(forks > 2);
  CHECK_INT(failed_forks, 0);
  forks = 0;
}

static int solve_in_grandchild(void) { return differs(line, CELLS, line_force) || in_child(solve_all) != 0; }

/* Small plans, which are made, used and destroyed often. */
static int solve_small(void) {
  fuge_operator *own = NULL;
  int bad = new_line(SMALL, &own) || differs(own, SMALL, small_force);
  fuge_operator_free(&own);
  return bad;
}

typedef struct {
  pthread_t thread;
  pthread_mutex_t lock;
  int stop, failures;
  int (*work)(void);
} worker;

static int stopped(worker *w) {
  pthread_mutex_lock(&w->lock);
  int stop = w->stop;
  pthread_mutex_unlock(&w->lock);
  return stop;
}

static void *repeat(void *data) {
  worker *w = data;
  while (!stopped(w)) w->failures += w->work() != 0;
  return NULL;
}

static int solve_shared(void) { return differs(line, CELLS, line_force); }

/* Forks while other threads plan and solve. */
static void fork_beside_threads(void) {
  worker workers[2] = {{.work = solve_small}, {.work = solve_shared}};
  for (int k = 0; k < 2; k++) {
    pthread_mutex_init(&workers[k].lock, NULL);
    CHECK_INT(pthread_create(&workers[k].thread, NULL, repeat, &workers[k]), 0);
  }
  int failed = 0;
  for (int round = 0; round < ROUNDS && !failed; round++) failed = in_child(solve_small) != 0;
  CHECK_INT(failed, 0);
  CHECK_INT(in_child(differs_anew), 0);
  for (int k = 0; k < 2; k++) {
    pthread_mutex_lock(&workers[k].lock);
    workers[k].stop = 1;
    pthread_mutex_unlock(&workers[k].lock);
    CHECK_INT(pthread_join(workers[k].thread, NULL), 0);
    CHECK_INT(workers[k].failures, 0);
  }
}

int main(void) {
  fuge_operator *own = NULL;
  CHECK_INT(new_line(CELLS, &line), 0);
  CHECK_INT(new_area(&area), 0);
  CHECK_INT(new_line(SMALL, &own), 0);
  CHECK_INT(solve(line, CELLS, line_force), 0);
  CHECK_INT(solve(area, SIDE * SIDE, area_force), 0);
  CHECK_INT(solve(own, SMALL, small_force), 0);
  CHECK_INT(in_child(solve_all), 0);
  CHECK_INT(in_child(differs_anew), 0);
  CHECK_INT(in_child(solve_in_grandchild), 0);
  fork_during_solve(line, CELLS, line_force);
  fork_during_solve(area, SIDE * SIDE, area_force);
  if (FORKS_BESIDE_THREADS) fork_beside_threads();
  CHECK_INT(solve_all(), 0);
  fuge_operator_free(&own);
  return check_summary();
}
