/* The load path from C. */
#include "check.h"
#include "fuge.h"
#include "table1.h"
#include <string.h>

enum { MOST = 8 };

/* Point 1 alone up to F = 10, then both: see test_parametric.pf. */
static void test_two_points(void) {
  double load[MOST], approach[MOST], stiffness[MOST];
  int point[MOST], contacts[MOST], events = -1;
  char message[256] = "old";
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 20.0, MOST, load, approach, stiffness, point, contacts, &events,
                              message, sizeof message), FUGE_DONE);
  CHECK_INT(events, 2);
  CHECK_STRING(message, "");
  CHECK_INT(point[0], 1);
  CHECK_INT(point[1], 2);
  CHECK_INT(contacts[0], 1);
  CHECK_INT(contacts[1], 2);
  CHECK_NEAR(load[0], 0.0, 0.0);
  CHECK_NEAR(load[1], 10.0, 1e-13);
  CHECK_NEAR(approach[1], 2.0, 1e-13);
  CHECK_NEAR(stiffness[0], 5.0, 1e-13);
  CHECK_NEAR(stiffness[1], 20.0 / 3.0, 1e-13);
  fuge_operator_free(&op);
}

/* Only as much as there is room for, and only what is wanted. */
static void test_capacity(void) {
  double load[2] = {-1.0, -1.0};
  int events = -1;
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 20.0, 0, NULL, NULL, NULL, NULL, NULL, &events, NULL, 0), FUGE_DONE);
  CHECK_INT(events, 2);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 20.0, 1, load, NULL, NULL, NULL, NULL, &events, NULL, 0), FUGE_DONE);
  CHECK_INT(events, 2);
  CHECK_NEAR(load[0], 0.0, 0.0);
  CHECK_NEAR(load[1], -1.0, 0.0);
  fuge_operator_free(&op);
}

static void test_refusals(void) {
  int events = -1;
  char message[256] = "";
  fuge_operator *op = NULL;
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
  CHECK_STATUS(fuge_load_path(NULL, TABLE1_GAP, 1.0, 0, NULL, NULL, NULL, NULL, NULL, &events, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, NULL, 1.0, 0, NULL, NULL, NULL, NULL, NULL, &events, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 1.0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, 1.0, -1, NULL, NULL, NULL, NULL, NULL, &events, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_load_path(op, TABLE1_GAP, -3.0, 0, NULL, NULL, NULL, NULL, NULL, &events, message,
                              sizeof message), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_CONTAINS(message, "-3.0");
  CHECK_INT(events, -1);
  fuge_operator_free(&op);
}

/* Both in contact at F = 20: dF = (1/2, 1/2), dv_0 = 0.15 per unit of load. */
static void test_derivative(void) {
  const double unit[2] = {0.0, 1.0};
  double force[2], gap[2], rigid = -1.0;
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  CHECK_STATUS(fuge_operator_dense(2, TABLE1_ALPHA, 2, &op), FUGE_DONE);
  CHECK_STATUS(fuge_solver_new(op, NULL, &solver), FUGE_DONE);
  CHECK_STATUS(fuge_set_gap(solver, TABLE1_GAP, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_set_load(solver, 20.0), FUGE_DONE);
  CHECK_STATUS(fuge_get_derivative(solver, NULL, 1.0, force, gap, &rigid), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_solve(solver), FUGE_DONE);
  CHECK_STATUS(fuge_get_derivative(solver, NULL, 1.0, NULL, gap, &rigid), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_get_derivative(solver, NULL, 1.0, force, gap, &rigid), FUGE_DONE);
  CHECK_NEAR(force[0], 0.5, 1e-14);
  CHECK_NEAR(force[1], 0.5, 1e-14);
  CHECK_NEAR(gap[0], 0.0, 0.0);
  CHECK_NEAR(rigid, 0.15, 1e-14);
  /* A unit of gap at point 2 moves 5 units of force to point 1 (0.2 F_1 - 0.2 F_2 = 2 .. 1). */
  CHECK_STATUS(fuge_get_derivative(solver, unit, 0.0, force, NULL, NULL), FUGE_DONE);
  CHECK_NEAR(force[0], 5.0, 1e-13);
  CHECK_NEAR(force[1], -5.0, 1e-13);
  CHECK_STATUS(fuge_set_load(solver, 0.0), FUGE_DONE);
  CHECK_STATUS(fuge_solve(solver), FUGE_DONE);
  CHECK_STATUS(fuge_get_derivative(solver, NULL, 1.0, force, gap, &rigid), FUGE_ERR_CALL_ORDER);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

int main(void) {
  test_two_points();
  test_capacity();
  test_refusals();
  test_derivative();
  return check_summary();
}
