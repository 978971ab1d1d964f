/* Section "edges of contact" of fuge_halfplane.h. */
#include "check.h"

enum { N = 64, MOST = 3 };
static const double H = 0.05;

/* Cylinder with E* = 1 and y = x^2 at 0.013: the contact is 1 to either side under the
 * load pi/2. */
static void press(double *x, double *width, double *force) {
  static double alpha[N * N], gap[N], open[N];
  double approach;
  for (int k = 0; k < N; k++) {
    x[k] = (k + 0.5 - N / 2) * H;
    width[k] = H;
    gap[k] = pow(x[k] - 0.013, 2);
  }
  CHECK_DONE(fuge_halfplane_matrix(N, x, width, 1.0, FUGE_CENTRE, 0, alpha, N, NULL, 0));
  CHECK_DONE(fuge_solve_dense(N, alpha, N, gap, acos(-1.0) / 2.0, force, open, &approach, NULL, 0));
}

static void test_cylinder(void) {
  double x[N], width[N], force[N], left[MOST], right[MOST], left_error[MOST], right_error[MOST];
  int left_kind[MOST] = {-1, -1, -1}, right_kind[MOST] = {-1, -1, -1}, count = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  press(x, width, force);
  fill(left, MOST);
  fill(right, MOST);
  fill(left_error, MOST);
  fill(right_error, MOST);
  CHECK_DONE(fuge_contact_edges(N, x, width, force, NULL, NULL, FUGE_CENTRE, 0, MOST, left, right, left_error,
                                right_error, left_kind, right_kind, &count, message, sizeof message));
  CHECK_INT(count, 1);
  CHECK_STRING(message, "");
  CHECK_NEAR(left[0], 0.013 - 1.0, 1e-3 * H);
  CHECK_NEAR(right[0], 0.013 + 1.0, 1e-3 * H);
  CHECK_INT(left_kind[0], FUGE_EDGE_REFINED);
  CHECK_INT(right_kind[0], FUGE_EDGE_REFINED);
  CHECK(left_error[0] >= fabs(left[0] - (0.013 - 1.0)) && left_error[0] < 1e-2 * H);
  CHECK(right_error[0] >= fabs(right[0] - (0.013 + 1.0)) && right_error[0] < 1e-2 * H);
  CHECK_UNTOUCHED(left_error + 1, MOST - 1);
  CHECK_UNTOUCHED(right_error + 1, MOST - 1);
  CHECK_UNTOUCHED(left + 1, MOST - 1);
  CHECK_UNTOUCHED(right + 1, MOST - 1);
  CHECK_INT(left_kind[1], -1);
  CHECK_INT(right_kind[1], -1);
}

/* Folded: the first interval touches the axis, the last one the end of the grid. */
static void test_kinds(void) {
  static const double x[6] = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5}, width[6] = {1, 1, 1, 1, 1, 1};
  static const double force[6] = {1, 0, 2, 2, 0, 1};
  double left[MOST], right[MOST], left_error[MOST], right_error[MOST];
  int left_kind[MOST], right_kind[MOST], count = -1;
  CHECK_DONE(fuge_contact_edges(6, x, width, force, NULL, NULL, FUGE_HAT, 1, MOST, left, right, left_error,
                                right_error, left_kind, right_kind, &count, NULL, 0));
  CHECK_INT(count, 3);
  CHECK_NEAR(left[0], -1.0, 0.0);
  CHECK_NEAR(right[0], 1.0, 0.0);
  CHECK_NEAR(left[1], 2.0, 0.0);
  CHECK_NEAR(right[2], 6.0, 0.0);
  /* An edge that is not refined is known to a cell. */
  CHECK_NEAR(left_error[1], 1.0, 0.0);
  CHECK_NEAR(right_error[2], 1.0, 0.0);
  CHECK_INT(left_kind[0], FUGE_EDGE_FEW_CELLS);
  CHECK_INT(left_kind[2], FUGE_EDGE_FEW_CELLS);
  CHECK_INT(right_kind[2], FUGE_EDGE_GRID_END);
  CHECK_DONE(fuge_contact_edges(6, x, width, force, NULL, NULL, FUGE_HAT, 0, MOST, left, right, left_error,
                                right_error, left_kind, right_kind, &count, NULL, 0));
  CHECK_NEAR(left[0], 0.0, 0.0);
  CHECK_INT(left_kind[0], FUGE_EDGE_GRID_END);
}

/* A pressure that rises towards both ends. */
static void test_singular(void) {
  double x[9], width[9], force[9], left, right;
  int left_kind = -1, count = -1;
  for (int k = 0; k < 9; k++) {
    x[k] = k;
    width[k] = 1.0;
    force[k] = k % 8 ? pow(k - 4, 2) + 1.0 : 0.0;
  }
  CHECK_DONE(fuge_contact_edges(9, x, width, force, NULL, NULL, FUGE_CENTRE, 0, 1, &left, &right, NULL, NULL,
                                &left_kind, NULL, &count, NULL, 0));
  CHECK_INT(left_kind, FUGE_EDGE_SINGULAR);
  CHECK_NEAR(left, 0.5, 0.0);
  CHECK_NEAR(right, 7.5, 0.0);
}

/* The left edges only. */
static int left_edges(int n, const double *x, const double *width, const double *force, int element, int capacity,
                      double *left, int *count, char *message, size_t len) {
  return fuge_contact_edges(n, x, width, force, NULL, NULL, element, 0, capacity, left, NULL, NULL, NULL, NULL, NULL,
                            count, message, len);
}

/* Only as much as there is room for, and only what is wanted. */
static void test_capacity(void) {
  static const double x[5] = {0, 1, 2, 3, 4}, width[5] = {1, 1, 1, 1, 1}, force[5] = {1, 0, 1, 0, 1};
  double left[MOST];
  int count = -1;
  fill(left, MOST);
  CHECK_DONE(left_edges(5, x, width, force, FUGE_MEAN, 2, left, &count, NULL, 0));
  CHECK_INT(count, 3);
  CHECK_NEAR(left[1], 1.5, 0.0);
  CHECK_UNTOUCHED(left + 2, 1);
  CHECK_DONE(left_edges(5, x, width, force, FUGE_MEAN, 0, NULL, &count, NULL, 0));
  CHECK_INT(count, 3);
}

/* The limit of the forces reaches up to the left edge; the right one is on a bed. */
static void test_laws(void) {
  static const double x[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, width[10] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  static const double force[10] = {0, 0.5, 1, 1, 1, 0.9, 0.7, 0.5, 0.3, 0.1}, negative[10] = {0, 0, -1};
  static const int state[10] = {0, 1, 2, 2, 2, 1, 1, 1, 1, 1};
  double compliance[11], cells[11], places[11], left, right, right_error;
  int left_kind = -1, right_kind = -1, count = -1;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  for (int k = 0; k < 11; k++) {
    compliance[k] = 7.0;
    cells[k] = 1.0;
    places[k] = k;
  }
  CHECK_DONE(fuge_contact_edges(10, x, width, force, state, NULL, FUGE_MEAN, 0, 1, &left, &right, NULL, NULL,
                                &left_kind, &right_kind, &count, NULL, 0));
  CHECK_INT(left_kind, FUGE_EDGE_LIMITED);
  CHECK_INT(right_kind, FUGE_EDGE_GRID_END);
  CHECK_NEAR(left, 1.0 - sqrt(1.0 / 6.0), 1e-12);
  double longer[11] = {0};
  int states[11] = {0};
  for (int k = 0; k < 10; k++) {
    longer[k] = force[k];
    states[k] = state[k];
  }
  CHECK_DONE(fuge_contact_edges(11, places, cells, longer, states, compliance, FUGE_MEAN, 0, 1, NULL, &right, NULL,
                                &right_error, NULL, &right_kind, &count, NULL, 0));
  CHECK_INT(right_kind, FUGE_EDGE_REFINED);
  CHECK_NEAR(right, 9.5, 1e-12);
  CHECK_NEAR(right_error, 0.0, 1e-12);
  CHECK_STATUS(fuge_contact_edges(10, x, width, force, NULL, negative, FUGE_MEAN, 0, 1, &left, NULL, NULL, NULL, NULL,
                                  NULL, &count, message, sizeof message), FUGE_ERR_LAW);
  CHECK_CONTAINS(message, "compliance(2)");
}

static void test_refusals(void) {
  static const double x[2] = {0.5, 1.5}, uneven[2] = {0.5, 1.75}, width[2] = {1, 1}, force[2] = {1, NAN};
  double left;
  int count = -7;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fill(&left, 1);
  CHECK_STATUS(left_edges(0, x, width, width, 0, 1, &left, &count, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(left_edges(2, x, width, width, 0, -1, &left, &count, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(left_edges(2, NULL, width, width, 0, 1, &left, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(left_edges(2, x, NULL, width, 0, 1, &left, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(left_edges(2, x, width, NULL, 0, 1, &left, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(left_edges(2, x, width, width, 0, 1, &left, NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_CONTAINS(message, "count is NULL");
  CHECK_STATUS(left_edges(2, x, width, force, 0, 1, &left, &count, NULL, 0), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(left_edges(2, x, width, width, 9, 1, &left, &count, NULL, 0), FUGE_ERR_ELEMENT);
  CHECK_STATUS(left_edges(2, uneven, width, width, 0, 1, &left, &count, message, sizeof message), FUGE_ERR_GRID);
  CHECK_CONTAINS(message, "cell 1");
  CHECK_UNTOUCHED(&left, 1);
  CHECK_INT(count, -7);
}

int main(void) {
  test_cylinder();
  test_kinds();
  test_singular();
  test_capacity();
  test_laws();
  test_refusals();
  return check_summary();
}
