/* Section "links of structures" of fuge_fe.h, and load cases of a body. */
#include "check.h"

enum { D = 2, CASES = 3 };

/* A node on springs of stiffness 100 along x and y, and a cable to (3, 4): E A/L = 100. */
static const double K[D * D] = {100.0, 0.0, 0.0, 100.0};
static const int NODE[D] = {0, 1}, ANCHOR[D] = {-1, -1};
static const double AT[D] = {0.0, 0.0}, AWAY[D] = {3.0, 4.0};
static const fuge_member CABLE = {FUGE_TENSION_ONLY, 1.0, 500.0, 0.0, 0.0, {0.0}};

/* Body, links, operator and solver of one problem. */
struct structure {
  fuge_body *body;
  fuge_links *links;
  fuge_operator *op;
  fuge_solver *solver;
};

/* The operator reads it where it is. */
static double alpha[4];

static void condense(struct structure *s) {
  int n = 0;
  CHECK_DONE(fuge_body_set_links(s->body, s->links));
  CHECK_DONE(fuge_body_condense(s->body));
  CHECK_DONE(fuge_links_get_count(s->links, &n));
  CHECK_DONE(fuge_body_get_influence(s->body, alpha, n));
  CHECK_DONE(fuge_operator_dense(n, alpha, n, &s->op, NULL, 0));
  CHECK_DONE(fuge_solver_new(s->op, NULL, &s->solver, NULL, 0));
}

static void clean(struct structure *s) {
  fuge_solver_free(&s->solver);
  fuge_operator_free(&s->op);
  fuge_body_free(&s->body);
  fuge_links_free(&s->links);
  CHECK(s->links == NULL);
}

static struct structure cable(void) {
  struct structure s = {NULL, NULL, NULL, NULL};
  CHECK_DONE(fuge_body_dense(D, K, D, &s.body, NULL, 0));
  CHECK_DONE(fuge_links_create(&s.links, NULL, 0));
  CHECK_DONE(fuge_links_add_member(s.links, D, NODE, ANCHOR, AT, AWAY, &CABLE, "cable"));
  condense(&s);
  return s;
}

/* The cable takes half of a load that pulls on it, and none of one that does not. */
static void test_cable(void) {
  const double pull[D] = {-6.0, -8.0}, push[D] = {6.0, 8.0};
  double force, u[D];
  struct structure s = cable();
  CHECK_DONE(fuge_body_set_load(s.body, pull));
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_DONE(fuge_solve(s.solver));
  CHECK_DONE(fuge_get_force(s.solver, &force));
  CHECK_NEAR(force, 5.0, 1e-13);
  CHECK_DONE(fuge_body_recover(s.body, &force, NULL, u));
  CHECK_VALUES(u, 1e-15, -0.03, -0.04);
  CHECK_DONE(fuge_body_set_load(s.body, push));
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_STATUS(fuge_get_force(s.solver, &force), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_solve(s.solver));
  CHECK_DONE(fuge_get_force(s.solver, &force));
  CHECK_NEAR(force, 0.0, 0.0);
  clean(&s);
}

static void test_cases(void) {
  const double loads[D * CASES] = {-6.0, -8.0, NAN, 0.0, 6.0, 8.0};
  double b[CASES], gap = SENTINEL, force[CASES], u[D * CASES];
  int status[CASES];
  char message[300];
  struct structure s = cable();
  for (int k = 0; k < CASES; k++) force[k] = SENTINEL;
  for (int k = 0; k < D * CASES; k++) u[k] = SENTINEL;
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_STATUS(fuge_body_get_cases(s.body, CASES, loads, NULL, b, NULL, status), FUGE_WARN_CASES);
  CHECK_DONE(fuge_body_message(s.body, message, sizeof message));
  CHECK_CONTAINS(message, "1 of 3 load cases are refused; load case 1: ");
  CHECK_DONE(fuge_body_case_message(s.body, 1, message, sizeof message));
  CHECK_CONTAINS(message, "load(0) ");
  CHECK_DONE(fuge_body_case_message(s.body, 2, message, sizeof message));
  CHECK_STRING(message, "");
  CHECK_STATUS(fuge_body_case_message(s.body, 3, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_case_message(s.body, -1, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_INT(status[0], FUGE_DONE);
  CHECK_INT(status[1], FUGE_ERR_NOT_FINITE);
  CHECK_INT(status[2], FUGE_DONE);
  CHECK_NEAR(b[0], -0.1, 1e-15);
  CHECK(isnan(b[1]));
  CHECK_NEAR(b[2], 0.1, 1e-15);
  CHECK_DONE(fuge_links_get_gaps(s.links, &gap));
  CHECK_NEAR(gap, 0.0, 0.0);
  CHECK_STATUS(fuge_solve_cases(s.solver, CASES, b, NULL, force, NULL, NULL, status), FUGE_WARN_CASES);
  CHECK_INT(status[1], FUGE_ERR_NOT_FINITE);
  CHECK_VALUES(force, 1e-13, 5.0, SENTINEL, 0.0);
  CHECK_DONE(fuge_body_recover_cases(s.body, CASES, loads, NULL, force, NULL, u, status));
  CHECK_VALUES(u, 1e-15, -0.03, -0.04);
  CHECK(isnan(u[2]) && isnan(u[3]));
  CHECK_NEAR(u[4], 0.06, 1e-15);
  CHECK_NEAR(u[5], 0.08, 1e-15);
  CHECK_DONE(fuge_body_case_message(s.body, 1, message, sizeof message));
  CHECK_STRING(message, "");
  clean(&s);
}

/* A gap from a support, which moves in each load case, to a spring; and a gap that supports hold. */
static void test_displaced_supports(void) {
  const double bars[9] = {100.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  const double loads[6] = {0.0}, supports[4] = {0.25, 0.0, -0.5, 0.125}, along = 1.0;
  const int fixed[2] = {1, 2}, spring = 0, first = 1, second = 2;
  double b[4], force[4], u[6];
  char message[FUGE_MESSAGE_LENGTH + 1];
  struct structure s = {NULL, NULL, NULL, NULL};
  CHECK_DONE(fuge_body_dense(3, bars, 3, &s.body, NULL, 0));
  CHECK_DONE(fuge_body_fix(s.body, 2, fixed, NULL));
  CHECK_DONE(fuge_links_create(&s.links, NULL, 0));
  CHECK_DONE(fuge_links_add_gap(s.links, 1, &first, &spring, &along, NULL, "between"));
  CHECK_DONE(fuge_links_add_gap(s.links, 1, &second, &first, &along, NULL, "held"));
  condense(&s);
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_SAYS(fuge_links_message(s.links, message, sizeof message), FUGE_DONE, message, "held can never act");
  CHECK_DONE(fuge_body_get_cases(s.body, 2, loads, supports, b, NULL, NULL));
  CHECK_VALUES(b, 1e-15, -0.25, 0.25, 0.5, -0.625);
  b[3] += 1.0;
  CHECK_DONE(fuge_solve_cases(s.solver, 2, b, NULL, force, NULL, NULL, NULL));
  CHECK_VALUES(force, 1e-13, 25.0, 0.0, 0.0, 0.0);
  CHECK_DONE(fuge_body_recover_cases(s.body, 2, loads, supports, force, NULL, u, NULL));
  CHECK_VALUES(u, 1e-15, 0.25, 0.25, 0.0, 0.0, -0.5, 0.125);
  clean(&s);
}

/* Two nodes on a line that only a support holds, which pushes along x. */
static struct structure floating(void) {
  static const double chain[D * D] = {1.0, -1.0, -1.0, 1.0};
  const int left = 0;
  const double along = 2.0;
  fuge_link_law law;
  struct structure s = {NULL, NULL, NULL, NULL};
  CHECK_DONE(fuge_body_dense(D, chain, D, &s.body, NULL, 0));
  CHECK_DONE(fuge_body_find_rigid_modes(s.body));
  CHECK_DONE(fuge_links_create(&s.links, NULL, 0));
  fuge_default_link_law(&law);
  CHECK(isinf(law.play) && isinf(law.limit) && isinf(law.limit_upper));
  CHECK_NEAR(law.compliance, 0.0, 0.0);
  for (int k = 0; k < 7; k++) CHECK_NEAR(law.reserved[k], 0.0, 0.0);
  law.gap = 0.5;
  CHECK_DONE(fuge_links_add_support(s.links, 1, &left, &along, &law, "stop"));
  condense(&s);
  return s;
}

static void test_mechanism(void) {
  const double held[D] = {0.0, -4.0}, pulled[D] = {0.0, 4.0};
  const double position[4] = {0.0, 0.0, 1.0, 0.0};
  const int dof[4] = {0, -1, 1, -1};
  double force, motion, u[D] = {SENTINEL, SENTINEL};
  char message[300];
  struct structure s = floating();
  CHECK_STATUS(fuge_body_find_mechanism(s.body, s.solver, u), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(u, D);
  CHECK_DONE(fuge_body_set_load(s.body, held));
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_DONE(fuge_solve(s.solver));
  CHECK_DONE(fuge_get_force(s.solver, &force));
  CHECK_DONE(fuge_get_motion(s.solver, &motion));
  CHECK_NEAR(force, 4.0, 1e-13);
  CHECK_DONE(fuge_body_recover(s.body, &force, &motion, u));
  CHECK_VALUES(u, 1e-13, -0.5, -4.5);
  CHECK_DONE(fuge_body_find_mechanism(s.body, s.solver, u));
  CHECK_VALUES(u, 0.0, 0.0, 0.0);
  CHECK_DONE(fuge_body_set_load(s.body, pulled));
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_STATUS(fuge_solve(s.solver), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_body_find_mechanism(s.body, s.solver, u));
  CHECK_VALUES(u, 1e-14, 1.0, 1.0);
  CHECK_MESSAGE(fuge_links_describe(s.links, D, u, 2, 2, position, dof, message, sizeof message), FUGE_DONE, message,
                "stop opens; the structure moves along x");
  CHECK_SAYS(fuge_links_describe(s.links, 1, u, 2, 2, position, dof, message, sizeof message), FUGE_ERR_SIZE, message,
             "degrees of freedom");
  clean(&s);
}

/* Resultants of load cases, and forces back to displacements, of a body that floats. */
static void test_floating_cases(void) {
  const double loads[D * 2] = {0.0, -4.0, 0.0, 4.0};
  double b[2], w[2], force[2], motion[2], u[D * 2] = {SENTINEL, SENTINEL, SENTINEL, SENTINEL};
  int status[2];
  struct structure s = floating();
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_DONE(fuge_body_get_cases(s.body, 2, loads, NULL, b, w, status));
  CHECK_NEAR(w[0] + w[1], 0.0, 1e-13);
  CHECK(fabs(w[0]) > 1.0);
  for (int k = 0; k < 2; k++) b[k] += 0.5;
  CHECK_STATUS(fuge_solve_cases(s.solver, 2, b, w, force, NULL, motion, status), FUGE_WARN_CASES);
  CHECK_INT(status[0], FUGE_DONE);
  CHECK_INT(status[1], FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_DONE(fuge_body_recover_cases(s.body, 2, loads, NULL, force, motion, u, status));
  CHECK_VALUES(u, 1e-13, -0.5, -4.5);
  CHECK(isnan(u[2]) && isnan(u[3]));
  CHECK_STATUS(fuge_body_recover_cases(s.body, 2, loads, NULL, force, NULL, u, status), FUGE_ERR_POINTER);
  clean(&s);
}

/* A gap between two nodes closes under a load, and carries. */
static void test_gap(void) {
  const int a = 0, b = 1;
  const double along = 1.0, load[D] = {30.0, 0.0};
  double force;
  fuge_link_law law;
  struct structure s = {NULL, NULL, NULL, NULL};
  CHECK_DONE(fuge_body_dense(D, K, D, &s.body, NULL, 0));
  CHECK_DONE(fuge_links_create(&s.links, NULL, 0));
  fuge_default_link_law(&law);
  law.gap = 0.1;
  CHECK_DONE(fuge_links_add_gap(s.links, 1, &a, &b, &along, &law, NULL));
  condense(&s);
  CHECK_DONE(fuge_body_set_load(s.body, load));
  CHECK_DONE(fuge_links_pose(s.links, s.body, s.solver));
  CHECK_DONE(fuge_solve(s.solver));
  CHECK_DONE(fuge_get_force(s.solver, &force));
  /* (30 - f)/100 - f/100 = 0.1 */
  CHECK_NEAR(force, 10.0, 1e-12);
  clean(&s);
}

static void test_removal(void) {
  const int column[3] = {0, 2, 4}, row[4] = {0, 1, 0, 1}, descending[3] = {0, 4, 2};
  const double normal[D] = {0.6, 0.8};
  double value[4] = {136.0, 48.0, 48.0, 164.0};
  char message[300];
  CHECK_SAYS(fuge_remove_member(D, column, row, value, D, NODE, normal, 1000.0, message, sizeof message),
             FUGE_ERR_NOT_DEFINITE, message, "degree of freedom 0");
  CHECK_SAYS(fuge_remove_member(D, descending, row, value, D, NODE, normal, 100.0, message, sizeof message),
             FUGE_ERR_SIZE, message, "column(2)");
  CHECK_VALUES(value, 0.0, 136.0, 48.0, 48.0, 164.0);
  CHECK_DONE(fuge_remove_member(D, column, row, value, D, NODE, normal, 100.0, message, sizeof message));
  CHECK_VALUES(value, 1e-13, 100.0, 0.0, 0.0, 100.0);
  CHECK_STATUS(fuge_remove_member(D, NULL, row, value, D, NODE, normal, 1.0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_remove_member(0, column, row, value, D, NODE, normal, 1.0, NULL, 0), FUGE_ERR_SIZE);
}

static void test_refusals(void) {
  const double none[D] = {0.0, 0.0}, x[D] = {1.0, 0.0};
  const int bad[D] = {0, -2};
  fuge_member member = CABLE;
  fuge_link_law law;
  double value = SENTINEL;
  int n = -1, count = -1;
  char message[300];
  struct structure s = cable(), other = {NULL, NULL, NULL, NULL};

  CHECK_STATUS(fuge_links_create(NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_add_support(NULL, D, NODE, x, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_add_support(s.links, 0, NODE, x, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_links_add_support(s.links, D, NULL, x, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_add_support(s.links, D, NODE, NULL, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_add_support(s.links, D, NODE, none, NULL, NULL), FUGE_ERR_DOF);
  CHECK_DONE(fuge_links_message(s.links, message, sizeof message));
  CHECK_CONTAINS(message, "link 2 is zero");
  CHECK_STATUS(fuge_links_add_support(s.links, D, ANCHOR, x, NULL, NULL), FUGE_ERR_DOF);
  CHECK_STATUS(fuge_links_add_support(s.links, D, bad, x, NULL, NULL), FUGE_ERR_DOF);
  fuge_default_link_law(&law);
  law.play = -1.0;
  CHECK_STATUS(fuge_links_add_gap(s.links, D, NODE, ANCHOR, x, &law, "g"), FUGE_ERR_GAP);
  CHECK_STATUS(fuge_links_add_gap(s.links, D, NODE, NULL, x, NULL, "g"), FUGE_ERR_POINTER);
  member.kind = 0;
  CHECK_STATUS(fuge_links_add_member(s.links, D, NODE, ANCHOR, AT, AWAY, &member, NULL), FUGE_ERR_LAW);
  CHECK_STATUS(fuge_links_add_member(s.links, D, NODE, ANCHOR, AT, AT, &CABLE, NULL), FUGE_ERR_LAW);
  CHECK_STATUS(fuge_links_add_member(s.links, D, NODE, ANCHOR, AT, AWAY, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_links_get_count(s.links, &count));
  CHECK_INT(count, 1);
  CHECK_STATUS(fuge_links_get_count(s.links, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_get_gaps(NULL, &value), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_message(NULL, message, sizeof message), FUGE_ERR_POINTER);

  CHECK_DONE(fuge_links_create(&other.links, NULL, 0));
  CHECK_STATUS(fuge_body_set_links(s.body, other.links), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_body_set_links(s.body, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_pose(other.links, s.body, s.solver), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_links_pose(s.links, s.body, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_links_pose(s.links, NULL, s.solver), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_get_cases(s.body, 0, x, NULL, &value, NULL, &n), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_get_cases(s.body, 1, NULL, NULL, &value, NULL, &n), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_get_cases(NULL, 1, x, NULL, &value, NULL, &n), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_recover_cases(s.body, 1, x, NULL, NULL, NULL, &value, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_case_message(s.body, 0, message, sizeof message), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_body_case_message(s.body, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_case_message(NULL, 0, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_body_find_mechanism(s.body, NULL, &value), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(&value, 1);
  CHECK_INT(n, -1);
  fuge_default_link_law(NULL);
  fuge_links_free(NULL);
  fuge_links_free(&other.links);
  clean(&s);
}

int main(void) {
  test_cable();
  test_cases();
  test_displaced_supports();
  test_mechanism();
  test_floating_cases();
  test_gap();
  test_removal();
  test_refusals();
  return check_summary();
}
