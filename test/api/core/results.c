/* Section "results" of fuge_core.h: numbers, proof, report, history, messages. */
#include <limits.h>
#include "table1.h"

enum { ROWS = 3 };

static fuge_solver *solved_table1(int keep_history, fuge_operator **op) {
  fuge_options options;
  fuge_default_options(&options);
  options.method = FUGE_TABLEAU;
  options.keep_history = keep_history;
  fuge_solver *solver = table1_solver(&options, op);
  CHECK_DONE(fuge_solve(solver));
  return solver;
}

static void test_numbers(void) {
  double force[2], gap[2], approach, resultant;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(0, &op);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_gap(solver, gap));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  check_table1(force, gap, approach);
  CHECK_DONE(fuge_get_resultant(solver, &resultant));
  CHECK_NEAR(resultant, TABLE1_LOAD, EXACT);
  free_both(&solver, &op);
}

static void test_info(void) {
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(0, &op);
  memset(&info, 0xff, sizeof info);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.status, FUGE_DONE);
  CHECK_INT(info.iterations, 3);
  CHECK_INT(info.contacts, 1);
  CHECK_INT(info.products, 1);
  CHECK_INT(info.preconditionings, 0);
  CHECK(info.residual >= 0.0 && info.residual <= 1e-15);
  for (int k = 0; k < 3; k++) CHECK_INT(info.reserved_int[k], 0);
  CHECK(info.force_error > 0.0 && info.force_error <= 1e-15);
  CHECK_NEAR(info.energy, 0.5 * TABLE1_FORCE[0] * TABLE1_ALPHA[0] * TABLE1_FORCE[0], EXACT);
  for (int k = 0; k < 5; k++) CHECK_NEAR(info.reserved[k], 0.0, 0.0);
  free_both(&solver, &op);
}

/* Each getter with NULL for the solver, then for the place. */
static void test_null_pointers(void) {
  double value = SENTINEL;
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  CHECK_STATUS(fuge_get_force(NULL, &value), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_gap(NULL, &value), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_motion(NULL, &value), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_resultant(NULL, &value), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&value, 1);
  CHECK_STATUS(fuge_get_info(NULL, &info), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_force(solver, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_gap(solver, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_motion(solver, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_resultant(solver, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_info(solver, NULL), FUGE_ERR_POINTER);
  free_both(&solver, &op);
}

/* Before any solve. */
static void test_too_early(void) {
  double z = SENTINEL;
  int basis[ROWS] = {-1, -1, -1}, available = -1;
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  info.residual = SENTINEL;
  CHECK_STATUS(fuge_get_info(solver, &info), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(&info.residual, 1);
  CHECK_STATUS(fuge_get_history(solver, 0, 1, basis, &z, &available), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(&z, 1);
  CHECK_INT(basis[0], -1);
  CHECK_INT(available, -1);
  free_both(&solver, &op);
}

/* ---- proof -------------------------------------------------------------- */

static void test_proof(void) {
  double force[2] = {-1.0, -1.0}, gap[2] = {-1.0, -1.0}, motion = -1.0;
  int proved[2] = {-1, -1};
  char message[16] = "not yet written";
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(0, &op);
  CHECK_DONE(fuge_prove(solver, force, gap, &motion, proved));
  CHECK_MESSAGE(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "");
  for (int k = 0; k < 2; k++) {
    CHECK(force[k] >= 0.0 && force[k] <= EXACT);
    CHECK(gap[k] >= 0.0 && gap[k] <= EXACT);
    CHECK_INT(proved[k], 1);
  }
  CHECK(motion > 0.0 && motion <= EXACT);
  CHECK_DONE(fuge_prove(solver, NULL, NULL, NULL, NULL));
  motion = -1.0;
  CHECK_DONE(fuge_prove(solver, NULL, NULL, &motion, NULL));
  CHECK(motion > 0.0 && motion <= EXACT);
  free_both(&solver, &op);
}

/* Two points in the same place share the force as they like. */
static void test_no_proof(void) {
  const double alpha[4] = {1.0, 1.0, 1.0, 1.0}, gap[2] = {0.0, 0.0};
  double bounds[2] = {-1.0, -1.0}, force[2] = {-1.0, -1.0}, motion = -1.0;
  int proved[2] = {-1, -1};
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(alpha, 2, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_load(solver, 2.0));
  CHECK_STATUS(fuge_solve(solver), FUGE_WARN_NOT_UNIQUE);
  CHECK_STATUS(fuge_prove(solver, bounds, NULL, &motion, proved), FUGE_WARN_NOT_PROVED);
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "positive definite");
  for (int k = 0; k < 2; k++) {
    CHECK(bounds[k] == HUGE_VAL);
    CHECK_INT(proved[k], 0);
  }
  CHECK(motion == HUGE_VAL);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_NEAR(force[0] + force[1], 2.0, EXACT);
  free_both(&solver, &op);
}

/* Before the first solve, and after a change of the problem. */
static void test_proof_too_early(void) {
  double force[2], motion = SENTINEL;
  int proved[2] = {-1, -1};
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  fill(force, 2);
  CHECK_STATUS(fuge_prove(NULL, force, NULL, &motion, proved), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_prove(solver, force, NULL, &motion, proved), FUGE_ERR_CALL_ORDER);
  CHECK_SAYS(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "call fuge_solve");
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_set_load(solver, 1.0));
  CHECK_STATUS(fuge_prove(solver, force, NULL, &motion, proved), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(force, 2);
  CHECK_UNTOUCHED(&motion, 1);
  CHECK_INT(proved[0], -1);
  free_both(&solver, &op);
}

/* ---- history ------------------------------------------------------------ */

static void test_whole_history(void) {
  double z[TABLE1_STEPS];
  int basis[TABLE1_STEPS * ROWS], available = 0;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  CHECK_DONE(fuge_get_history(solver, 0, TABLE1_STEPS, basis, z, &available));
  CHECK_INT(available, TABLE1_STEPS);
  for (int k = 0; k < TABLE1_STEPS * ROWS; k++) CHECK_INT(basis[k], TABLE1_BASIS[k]);
  for (int k = 0; k < TABLE1_STEPS; k++) CHECK_NEAR(z[k], TABLE1_Z[k], EXACT);
  free_both(&solver, &op);
}

/* Steps 1 and 2, and not a byte more. */
static void test_part_of_history(void) {
  double z[3];
  int basis[3 * ROWS], available = 0;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  fill(z, 3);
  memset(basis, 0xff, sizeof basis);
  CHECK_DONE(fuge_get_history(solver, 1, 2, basis, z, &available));
  for (int k = 0; k < 2 * ROWS; k++) CHECK_INT(basis[k], TABLE1_BASIS[ROWS + k]);
  for (int k = 2 * ROWS; k < 3 * ROWS; k++) CHECK_INT(basis[k], -1);
  for (int k = 0; k < 2; k++) CHECK_NEAR(z[k], TABLE1_Z[1 + k], EXACT);
  CHECK_UNTOUCHED(&z[2], 1);
  free_both(&solver, &op);
}

static void check_range(const fuge_solver *solver, int first, int count, int status) {
  double z[TABLE1_STEPS];
  int basis[TABLE1_STEPS * ROWS], available = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  basis[0] = -1;
  fill(z, TABLE1_STEPS);
  CHECK_STATUS(fuge_get_history(solver, first, count, basis, z, &available), status);
  if (status == FUGE_DONE) return;
  CHECK_INT(basis[0], -1);
  CHECK_UNTOUCHED(z, TABLE1_STEPS);
  CHECK_INT(available, -1);
  fuge_solver_message(solver, message, sizeof message);
  CHECK_CONTAINS(message, "count");
}

static void test_history_ranges(void) {
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  check_range(solver, 3, 1, FUGE_DONE);
  check_range(solver, TABLE1_STEPS, 0, FUGE_DONE);
  check_range(solver, -1, 1, FUGE_ERR_SIZE);
  check_range(solver, -1, 0, FUGE_ERR_SIZE);
  check_range(solver, 0, -1, FUGE_ERR_SIZE);
  check_range(solver, 0, TABLE1_STEPS + 1, FUGE_ERR_SIZE);
  check_range(solver, 3, 2, FUGE_ERR_SIZE);
  check_range(solver, TABLE1_STEPS, 1, FUGE_ERR_SIZE);
  check_range(solver, INT_MAX, 1, FUGE_ERR_SIZE);
  check_range(solver, 1, INT_MAX, FUGE_ERR_SIZE);
  check_range(solver, INT_MAX, INT_MAX, FUGE_ERR_SIZE);
  check_range(solver, INT_MIN, INT_MAX, FUGE_ERR_SIZE);
  free_both(&solver, &op);
}

static void test_history_null_pointers(void) {
  double z = SENTINEL;
  int basis[ROWS] = {-1, -1, -1}, available = -1;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  CHECK_STATUS(fuge_get_history(NULL, 0, 1, basis, &z, &available), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_history(solver, 0, 1, NULL, &z, &available), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_history(solver, 0, 1, basis, NULL, &available), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_history(solver, 0, 1, basis, &z, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_history(solver, 0, 0, NULL, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&z, 1);
  CHECK_INT(basis[0], -1);
  CHECK_INT(available, -1);
  CHECK_DONE(fuge_get_history(solver, 0, 0, NULL, NULL, &available));
  CHECK_INT(available, TABLE1_STEPS);
  free_both(&solver, &op);
}

static void test_history_not_kept(void) {
  double z = SENTINEL;
  int basis[ROWS] = {-1, -1, -1}, available = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(0, &op);
  CHECK_DONE(fuge_get_history(solver, 0, 0, NULL, NULL, &available));
  CHECK_INT(available, 0);
  CHECK_STATUS(fuge_get_history(solver, 0, 1, basis, &z, &available), FUGE_ERR_SIZE);
  CHECK_UNTOUCHED(&z, 1);
  CHECK_INT(basis[0], -1);
  fuge_solver_message(solver, message, sizeof message);
  CHECK_CONTAINS(message, "keep_history");
  free_both(&solver, &op);
}

static void test_history_of_zero_load(void) {
  int available = -1;
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  CHECK_DONE(fuge_set_load(solver, 0.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_history(solver, 0, 0, NULL, NULL, &available));
  CHECK_INT(available, 0);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.iterations, 0);
  CHECK_INT(info.contacts, 0);
  free_both(&solver, &op);
}

/* Each solve starts a history of its own. */
static void test_history_of_second_solve(void) {
  int available = -1;
  fuge_operator *op = NULL;
  fuge_solver *solver = solved_table1(1, &op);
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_history(solver, 0, 0, NULL, NULL, &available));
  CHECK_INT(available, TABLE1_STEPS);
  free_both(&solver, &op);
}

/* The steps up to the limit, to see where a solve was going. */
static void test_history_of_failed_solve(void) {
  double z[2];
  int basis[2 * ROWS], available = -1;
  fuge_options options;
  fuge_operator *op = NULL;
  fuge_default_options(&options);
  options.method = FUGE_TABLEAU;
  options.keep_history = 1;
  options.max_iterations = 1;
  fuge_solver *solver = table1_solver(&options, &op);
  CHECK_STATUS(fuge_solve(solver), FUGE_ERR_ITERATION_LIMIT);
  CHECK_DONE(fuge_get_history(solver, 0, 2, basis, z, &available));
  CHECK_INT(available, 2);
  for (int k = 0; k < 2 * ROWS; k++) CHECK_INT(basis[k], TABLE1_BASIS[k]);
  CHECK_NEAR(z[1], TABLE1_Z[1], EXACT);
  free_both(&solver, &op);
}

/* ---- messages ----------------------------------------------------------- */

static void test_message_is_empty_when_done(void) {
  char message[16] = "not yet written";
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  CHECK_STATUS(fuge_set_load(solver, -1.0), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_solve(solver));
  CHECK_MESSAGE(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "");
  free_both(&solver, &op);
}

static void test_message_of_new_solver(void) {
  char message[16] = "not yet written";
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_MESSAGE(fuge_solver_message(solver, message, sizeof message), FUGE_DONE, message, "");
  free_both(&solver, &op);
}

/* The bytes before and beyond stay as they are. */
static void test_message_is_cut(void) {
  char whole[256], store[9] = "########", *buffer = store + 1;
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  CHECK_STATUS(fuge_set_load(solver, -1.0), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_solver_message(solver, whole, sizeof whole));
  CHECK_MESSAGE(fuge_solver_message(solver, buffer, 0), FUGE_DONE, buffer, "#######");
  CHECK_DONE(fuge_solver_message(solver, buffer, 5));
  CHECK_INT(strlen(buffer), 4);
  CHECK(strncmp(buffer, whole, 4) == 0);
  CHECK_STRING(buffer + 5, "##");
  CHECK_MESSAGE(fuge_solver_message(solver, buffer, 1), FUGE_DONE, buffer, "");
  CHECK(store[0] == '#');
  CHECK(strlen(whole) > 8 && whole[strlen(whole) - 1] != ' ');
  free_both(&solver, &op);
}

static void test_message_null_pointers(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fuge_solver *solver = table1_solver(NULL, &op);
  CHECK_STATUS(fuge_solver_message(NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solver_message(solver, NULL, 10), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_solver_message(solver, NULL, 0), FUGE_ERR_POINTER);
  free_both(&solver, &op);
}

int main(void) {
  test_numbers();
  test_info();
  test_null_pointers();
  test_too_early();
  test_proof();
  test_no_proof();
  test_proof_too_early();
  test_whole_history();
  test_part_of_history();
  test_history_ranges();
  test_history_null_pointers();
  test_history_not_kept();
  test_history_of_zero_load();
  test_history_of_second_solve();
  test_history_of_failed_solve();
  test_message_is_empty_when_done();
  test_message_of_new_solver();
  test_message_is_cut();
  test_message_null_pointers();
  return check_summary();
}
