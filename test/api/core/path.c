/* The load path from C. */
#include "check.h"
#include "fuge.h"
#include "table1.h"
#include <string.h>

enum { MOST = 8 };

/* Point 0 alone up to F = 10, then both: see test_contact_path.pf. */
static void test_two_points(void) {
  double load[MOST], approach[MOST], rate[MOST];
  int point[MOST], state[MOST], contacts[MOST], entries = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_DONE(fuge_load_path(op, TABLE1_GAP, 20.0, MOST, load, approach, rate, point, state, contacts, &entries, message,
                            sizeof message));
  CHECK_INT(entries, 3);
  CHECK_STRING(message, "");
  CHECK_INT(point[0], -1);
  CHECK_INT(point[1], 0);
  CHECK_INT(point[2], 1);
  CHECK_INT(state[0], FUGE_OPEN);
  CHECK_INT(state[1], FUGE_AT_LOWER_STOP);
  CHECK_INT(state[2], FUGE_AT_LOWER_STOP);
  CHECK_INT(contacts[1], 1);
  CHECK_INT(contacts[2], 2);
  CHECK_VALUES(load, 0.0, 0.0, 0.0);
  CHECK_NEAR(load[2], 10.0, 1e-13);
  CHECK_NEAR(approach[2], 2.0, 1e-13);
  CHECK_NEAR(1.0 / rate[1], 5.0, 1e-13);
  CHECK_NEAR(1.0 / rate[2], 20.0 / 3.0, 1e-13);
  fuge_operator_free(&op);
}

/* Only as many entries as fit, and only the arrays that are wanted. */
static void test_capacity(void) {
  double load[2] = {-1.0, -1.0};
  int entries = -1;
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_DONE(fuge_load_path(op, TABLE1_GAP, 20.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0));
  CHECK_INT(entries, 3);
  CHECK_DONE(fuge_load_path(op, TABLE1_GAP, 20.0, 1, load, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0));
  CHECK_INT(entries, 3);
  CHECK_VALUES(load, 0.0, 0.0, -1.0);
  fuge_operator_free(&op);
}

static void test_refusals(void) {
  int entries = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_STATUS(fuge_load_path(NULL, TABLE1_GAP, 1.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, NULL, 1.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 1.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 1.0, -1, NULL, NULL, NULL, NULL, NULL, NULL, &entries, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_SAYS(fuge_load_path(op, TABLE1_GAP, -3.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries, message,
                            sizeof message), FUGE_ERR_NO_EQUILIBRIUM, message, "-3.0");
  CHECK_INT(entries, -1);
  fuge_operator_free(&op);
}

/* Both in contact at F = 20: dF = (1/2, 1/2), dv_0 = 0.15 per unit of load. */
static void test_derivative(void) {
  const double unit[2] = {0.0, 1.0}, not_a_number = NAN;
  double force[2], gap[2], motion = -1.0;
  fuge_info info;
  fuge_operator *op = NULL;
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, NULL, &op);
  CHECK_DONE(fuge_set_gap(solver, TABLE1_GAP, NULL));
  CHECK_DONE(fuge_set_load(solver, 20.0));
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, &ONE, force, gap, &motion), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, &ONE, NULL, gap, &motion), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_get_derivatives(solver, NULL, &ONE, force, gap, &motion));
  CHECK_VALUES(force, 1e-14, 0.5, 0.5);
  CHECK_NEAR(gap[0], 0.0, 0.0);
  CHECK_NEAR(motion, 0.15, 1e-14);
  /* A unit of gap at point 2 moves 5 units of force to point 1 (0.2 F_1 - 0.2 F_2 = 2 .. 1). */
  CHECK_DONE(fuge_get_derivatives(solver, unit, NULL, force, NULL, NULL));
  CHECK_VALUES(force, 1e-13, 5.0, -5.0);
  /* Solution and report of the solve are still there, after a derivative that is refused too. */
  CHECK_STATUS(fuge_get_derivatives(solver, unit, &not_a_number, force, NULL, NULL), FUGE_ERR_NOT_FINITE);
  CHECK_DONE(fuge_get_info(solver, &info));
  CHECK_INT(info.status, FUGE_DONE);
  CHECK_INT(info.contacts, 2);
  CHECK(info.products > 0);
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_NEAR(force[0] + force[1], 20.0, 1e-13);
  CHECK_DONE(fuge_set_load(solver, 0.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_STATUS(fuge_get_derivatives(solver, NULL, &ONE, force, gap, &motion), FUGE_ERR_CALL_ORDER);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

/* Point 0 alone below F = 10, both above: one event on the way from 5 to 20. */
static void test_follow_path(void) {
  const double finish[1] = {20.0}, back[1] = {-1.0};
  double parameter[MOST], motion[MOST], rate[MOST];
  int point[MOST], state[MOST], contacts[MOST], entries = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fuge_operator *op = NULL;
  fuge_solver *s = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op, NULL, 0));
  CHECK_DONE(fuge_solver_new(op, NULL, &s, NULL, 0));
  CHECK_STATUS(fuge_follow_path(s, finish, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries),
               FUGE_ERR_CALL_ORDER);
  fuge_solver_message(s, message, sizeof message);
  CHECK_CONTAINS(message, "fuge_set_gap before fuge_follow_path");
  CHECK_DONE(fuge_set_gap(s, TABLE1_GAP, NULL));
  CHECK_STATUS(fuge_follow_path(s, finish, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries),
               FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_set_load(s, 5.0));
  CHECK_STATUS(fuge_follow_path(NULL, finish, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_follow_path(s, NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_follow_path(s, finish, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_follow_path(s, finish, -1, NULL, NULL, NULL, NULL, NULL, NULL, &entries), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_follow_path(s, back, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries),
               FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_INT(entries, -1);
  CHECK_DONE(fuge_follow_path(s, finish, 0, NULL, NULL, NULL, NULL, NULL, NULL, &entries));
  CHECK_INT(entries, 2);
  fuge_solver_message(s, message, sizeof message);
  CHECK_STRING(message, "");
  CHECK_DONE(fuge_follow_path(s, finish, MOST, parameter, motion, rate, point, state, contacts, &entries));
  CHECK_INT(entries, 2);
  CHECK_INT(point[0], -1);
  CHECK_INT(point[1], 1);
  CHECK_INT(state[1], FUGE_AT_LOWER_STOP);
  CHECK_INT(contacts[0], 1);
  CHECK_INT(contacts[1], 2);
  CHECK_NEAR(parameter[0], 0.0, 0.0);
  CHECK_NEAR(parameter[1], 1.0 / 3.0, 1e-14);
  CHECK_VALUES(motion, 1e-14, 1.0, 2.0);
  CHECK_VALUES(rate, 1e-13, 3.0, 2.25);
  fuge_solver_free(&s);
  fuge_operator_free(&op);
}

/* Two motions: entry k at motion + 2*k.  Points at -1 and 1, the load moves from the middle to the right. */
static void test_follow_motions(void) {
  const double alpha[4] = {1.0, 0.0, 0.0, 1.0}, gap[2] = {0.0, 0.0}, modes[4] = {1.0, 1.0, -1.0, 1.0};
  const double middle[2] = {2.0, 0.0}, right[2] = {2.0, 1.0}, beside[2] = {2.0, 4.0};
  double motion[2 * MOST], rate[2 * MOST];
  int entries = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_operator *op = NULL;
  fuge_solver *s = new_solver(alpha, 2, NULL, &op);
  CHECK_DONE(fuge_set_gap(s, gap, NULL));
  CHECK_DONE(fuge_set_modes(s, 2, modes, middle));
  CHECK_DONE(fuge_follow_path(s, right, MOST, NULL, motion, rate, NULL, NULL, NULL, &entries));
  CHECK_INT(entries, 1);
  CHECK_VALUES(motion, 1e-14, 1.0, 0.0);
  CHECK_VALUES(rate, 1e-14, 0.0, 0.5);
  /* The line of action passes point 2, at 1, half way. */
  CHECK_STATUS(fuge_follow_path(s, beside, MOST, NULL, motion, rate, NULL, NULL, NULL, &entries),
               FUGE_ERR_NO_EQUILIBRIUM);
  fuge_solver_message(s, message, sizeof message);
  CHECK_CONTAINS(message, "parameter");
  CHECK_INT(entries, 1);
  fuge_solver_free(&s);
  fuge_operator_free(&op);
}

int main(void) {
  test_two_points();
  test_capacity();
  test_refusals();
  test_derivative();
  test_follow_path();
  test_follow_motions();
  return check_summary();
}
