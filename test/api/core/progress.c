/* Section "solver" of fuge_core.h: progress and cancelling. */
#include "table1.h"

/* A cantilever under a rough surface: the active set needs several sets. */
enum { N = 30 };
static double alpha[N * N], gap[N];

static void make_scene(void) {
  for (int j = 1; j <= N; j++) {
    for (int i = 1; i <= N; i++) {
      double low = i < j ? i : j, high = i < j ? j : i;
      alpha[i - 1 + (j - 1) * N] = low * low * (3.0 * high - low) / (6.0 * N * N * N);
    }
    gap[j - 1] = 0.3 * pow(sin(7.0 * j), 2) + 0.1 * pow((double)j / N - 0.4, 2);
  }
}

typedef struct record {
  int calls;
  int cancel_at; /* iteration; 0: never */
  int last;
  int contacts;
  double residual;
} record;

static int watch(int iteration, double residual, int contacts, void *user) {
  record *r = user;
  r->calls++;
  CHECK(iteration > r->last);
  CHECK(residual >= 0.0 && residual < 1e6);
  CHECK(contacts > 0 && contacts <= N);
  r->last = iteration;
  r->residual = residual;
  r->contacts = contacts;
  return iteration == r->cancel_at ? -1 : 0;
}

static int watch_without_user(int iteration, double residual, int contacts, void *user) {
  (void)residual;
  (void)contacts;
  CHECK(user == NULL);
  return iteration == 2;
}

static fuge_solver *scene_solver(int method, fuge_operator **op) {
  fuge_options options;
  fuge_default_options(&options);
  options.method = method;
  fuge_solver *solver = new_solver(alpha, N, &options, op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 1.0));
  return solver;
}

static void check_same(fuge_solver *solver, const double *expected) {
  double force[N];
  CHECK_DONE(fuge_get_force(solver, force));
  for (int k = 0; k < N; k++) CHECK_NEAR(force[k], expected[k], EXACT);
}

static void check_cancelled(fuge_solver *solver, int iteration) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "", part[32];
  double force[N];
  fuge_info info;
  record r = {0, iteration, 0, 0, 0.0};
  CHECK_DONE(fuge_reset(solver));
  CHECK_DONE(fuge_set_progress(solver, watch, &r));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CANCELLED);
  CHECK_INT(r.calls, iteration);
  CHECK_DONE(fuge_solver_message(solver, message, sizeof message));
  snprintf(part, sizeof part, "iteration %d ", iteration);
  CHECK_CONTAINS(message, part);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.status, FUGE_ERR_CANCELLED);
  fill(force, N);
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(force, N);
}

static void test_method(int method) {
  double force[N];
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = scene_solver(method, &op);
  record all = {0, 0, 0, 0, 0.0};
  CHECK_DONE(fuge_set_progress(solver, watch, &all));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK(all.calls > (method == FUGE_ITERATIVE ? 1 : 5));
  /* The tableau ends with a set. */
  CHECK_INT(all.calls, info.iterations + (method == FUGE_TABLEAU));
  CHECK_INT(all.contacts, info.contacts);
  CHECK_NEAR(all.residual, 0.0, method == FUGE_ITERATIVE ? 1e-10 : 1e-12);
  for (int k = 1; k <= all.calls; k++) {
    check_cancelled(solver, k);
    /* NULL removes the callback. */
    CHECK_DONE(fuge_set_progress(solver, NULL, &all));
    CHECK_DONE(fuge_solve(solver));
    check_same(solver, force);
  }
  free_both(&solver, &op);
}

/* The callback stays from solve to solve and after fuge_reset; it counts from 1. */
static void test_stays(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = scene_solver(FUGE_TABLEAU, &op);
  record r = {0, 1, 0, 0, 0.0};
  CHECK_DONE(fuge_set_progress(solver, watch, &r));
  for (int k = 1; k <= 3; k++) {
    CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CANCELLED);
    CHECK_INT(r.calls, k);
    CHECK_INT(r.last, 1);
    r.last = 0;
    CHECK_DONE(fuge_reset(solver));
  }
  CHECK_DONE(fuge_set_load(solver, 0.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_INT(r.calls, 3);
  free_both(&solver, &op);
}

static void test_null_pointers(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = scene_solver(FUGE_TABLEAU, &op);
  CHECK_STATUS(fuge_set_progress(NULL, watch, NULL), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_set_progress(solver, watch_without_user, NULL));
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_CANCELLED);
  CHECK_DONE(fuge_set_progress(solver, NULL, NULL));
  CHECK_DONE(fuge_solve(solver));
  free_both(&solver, &op);
}

int main(void) {
  make_scene();
  test_method(FUGE_TABLEAU);
  test_method(FUGE_ACTIVE_SET);
  test_method(FUGE_ITERATIVE);
  test_stays();
  test_null_pointers();
  return check_summary();
}
