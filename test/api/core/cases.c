/* Load cases in fuge_core.h: columns, statuses, states, reports and messages of each, envelopes. */
#include "table1.h"

enum { N = 2, CASES = 4 };
static const double ALPHA[N * N] = {0.2, 0.1, 0.1, 0.2};
static const double GAP[N] = {0.0, 1.0};
/* The load of Tabelle 1, a larger one, one that no contact can resist, and none. */
static const double LOAD[CASES] = {2.0, 20.0, -1.0, 0.0};

static void test_loads(void) {
  double force[N * CASES], gap[N * CASES], motion[CASES];
  int status[CASES], state[N];
  char message[300];
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(ALPHA, N, NULL, &op);
  for (int k = 0; k < N * CASES; k++) force[k] = gap[k] = SENTINEL;
  for (int k = 0; k < CASES; k++) motion[k] = SENTINEL;
  CHECK_DONE(fuge_set_gap(solver, GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, 1.0));
  CHECK_STATUS(fuge_solve_cases(solver, CASES, NULL, LOAD, force, gap, motion, status), FUGE_WARN_CASES);
  CHECK_DONE(fuge_solver_message(solver, message, sizeof message));
  CHECK_CONTAINS(message, "1 of 4 load cases failed, 0 have a warning; load case 2: ");
  CHECK_VALUES(force, EXACT, 2.0, 0.0, 15.0, 5.0, SENTINEL, SENTINEL, 0.0, 0.0);
  CHECK_VALUES(motion, EXACT, 0.4, 3.5, SENTINEL, 0.0);
  CHECK_VALUES(gap, EXACT, 0.0, 0.8, 0.0, 0.0, SENTINEL, SENTINEL, 0.0, 1.0);
  CHECK_INT(status[0], FUGE_DONE);
  CHECK_INT(status[1], FUGE_DONE);
  CHECK_INT(status[2], FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_INT(status[3], FUGE_DONE);
  CHECK_DONE(fuge_get_case_states(solver, 0, state));
  CHECK_INT(state[0], FUGE_AT_LOWER_STOP);
  CHECK_INT(state[1], FUGE_OPEN);
  CHECK_DONE(fuge_get_case_info(solver, 1, &info));
  CHECK_INT(info.contacts, 2);
  CHECK_DONE(fuge_get_case_info(solver, 2, &info));
  CHECK_INT(info.status, FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_case_message(solver, 2, message, sizeof message));
  CHECK_CONTAINS(message, "load");
  CHECK_DONE(fuge_case_message(solver, 0, message, sizeof message));
  CHECK_STRING(message, "");
  CHECK_STATUS(fuge_get_force(solver, force), FUGE_ERR_CALL_ORDER);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

/* Results may take the place of the data, and each may be left out. */
static void test_gaps(void) {
  double gap[N * 2] = {0.0, 1.0, 1.0, 0.0};
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(ALPHA, N, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_DONE(fuge_solve_cases(solver, 2, gap, NULL, gap, NULL, NULL, NULL));
  CHECK_VALUES(gap, EXACT, 2.0, 0.0, 0.0, 2.0);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

static int cancel(int iteration, double residual, int contacts, void *user) {
  (void)residual;
  (void)contacts;
  *(int *)user = iteration;
  return iteration == 2;
}

static void test_refusals(void) {
  double force[N * CASES];
  int state[N], heard = 0;
  char message[300];
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(ALPHA, N, NULL, &op);
  for (int k = 0; k < N * CASES; k++) force[k] = SENTINEL;
  CHECK_STATUS(fuge_solve_cases(NULL, 1, NULL, LOAD, force, NULL, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solve_cases(solver, CASES, NULL, LOAD, force, NULL, NULL, NULL), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_set_gap(solver, GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, 1.0));
  CHECK_STATUS(fuge_get_case_states(solver, 0, state), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_solve_cases(solver, 0, NULL, LOAD, force, NULL, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_solve_cases(solver, CASES, NULL, NULL, force, NULL, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_DONE(fuge_solver_message(solver, message, sizeof message));
  CHECK_CONTAINS(message, "set gap or load");
  CHECK_DONE(fuge_set_progress(solver, cancel, &heard));
  CHECK_STATUS(fuge_solve_cases(solver, CASES, NULL, LOAD, force, NULL, NULL, NULL), FUGE_ERR_CANCELLED);
  CHECK_INT(heard, 2);
  CHECK_UNTOUCHED(force, N * CASES);
  CHECK_DONE(fuge_set_progress(solver, NULL, NULL));
  CHECK_DONE(fuge_solve_cases(solver, 2, NULL, LOAD, force, NULL, NULL, NULL));
  CHECK_STATUS(fuge_get_case_states(solver, 2, state), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_get_case_states(solver, -1, state), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_get_case_info(solver, 0, NULL), FUGE_ERR_POINTER);
  /* A refused call leaves the cases of the one before. */
  CHECK_STATUS(fuge_solve_cases(solver, CASES, NULL, NULL, force, NULL, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_DONE(fuge_get_case_states(solver, 1, state));
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(fuge_get_case_states(solver, 0, state), FUGE_ERR_CALL_ORDER);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

static void test_envelope(void) {
  const double values[N * 3] = {1.0, NAN, -2.0, NAN, 3.0, NAN};
  double smallest[N], largest[N];
  int least[N], most[N];
  char message[300];
  CHECK_DONE(fuge_find_envelope(N, 3, values, smallest, largest, least, most, message, sizeof message));
  CHECK_NEAR(smallest[0], -2.0, 0.0);
  CHECK_NEAR(largest[0], 3.0, 0.0);
  CHECK_INT(least[0], 1);
  CHECK_INT(most[0], 2);
  CHECK_INT(least[1], -1);
  CHECK_STATUS(fuge_find_envelope(N, 0, values, NULL, NULL, NULL, NULL, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_find_envelope(N, 3, NULL, NULL, NULL, NULL, NULL, message, sizeof message), FUGE_ERR_POINTER);
}

int main(void) {
  test_loads();
  test_gaps();
  test_refusals();
  test_envelope();
  return check_summary();
}
