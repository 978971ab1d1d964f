/* The paper's punch y = 0.05 x^4 (mm) on an elastic half-plane, F = 30 kN per mm.
 *
 * The half model has 33 cells between x = 0 and 0.825 mm: cell k covers k h .. (k+1) h,
 * so the contact ends at the outer edge of the last cell with a force.  (With a cell
 * centre on the axis that edge would be an odd multiple of h/2: 0.7125 mm, not 0.700.)
 * The decrease of the pressure towards the edge gives it more accurately than the grid. */
#include <math.h>
#include <stdio.h>
#include "fuge.h"

enum { N = 33 };
static const double H = 0.025, PROFILE = 0.05;               /* mm, 1/mm^3 */
static const double E_STAR = 1.0e6 / (1.0 - 0.25 * 0.25);    /* N/mm^2, plane strain */
static const double LOAD = 30.0e3;                           /* N per mm of depth */

/* Prints what went wrong, if anything did. */
static int explain(int status, const char *message) {
  if (status != FUGE_DONE) fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
  return status;
}

static int solve(const double *alpha, const double *gap, double *force, fuge_info *info) {
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  int status = fuge_operator_dense(N, alpha, N, &op, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_solver_new(op, NULL, &solver, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_set_gap(solver, gap, NULL);
  if (status == FUGE_DONE) status = fuge_set_load(solver, LOAD);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  if (status == FUGE_DONE) status = fuge_get_force(solver, force);
  if (status == FUGE_DONE) status = fuge_get_info(solver, info);
  if (status != FUGE_DONE && solver) fuge_solver_message(solver, message, sizeof message);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  return explain(status, message);
}

int main(void) {
  double x[N], width[N], gap[N], alpha[N * N], force[N], contact_edge = 0.0, largest = 0.0, refined = 0.0;
  int kind = FUGE_EDGE_FEW_CELLS, intervals = 0;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_info info;
  for (int k = 0; k < N; k++) {
    x[k] = (k + 0.5) * H;
    width[k] = H;
    gap[k] = PROFILE * pow(x[k], 4);
  }
  int status = fuge_halfplane_matrix(N, x, width, E_STAR, FUGE_CENTRE, 1, alpha, N, message, sizeof message);
  if (explain(status, message) != FUGE_DONE || solve(alpha, gap, force, &info) != FUGE_DONE) return 1;

  /* A force is that of a cell and its mirror image. */
  for (int k = 0; k < N; k++) {
    if (force[k] > 0.0) contact_edge = x[k] + 0.5 * H;
    largest = fmax(largest, force[k] / (2.0 * H));
  }
  status = fuge_contact_edges(N, x, width, force, NULL, NULL, FUGE_CENTRE, 1, 1, NULL, &refined, NULL, NULL, NULL,
                              &kind, &intervals, message, sizeof message);
  if (explain(status, message) != FUGE_DONE || intervals != 1 || kind != FUGE_EDGE_REFINED) return 1;
  /* F = (3 pi/4) E* A a^4 and p(x) = E* A (2 x^2 + a^2) sqrt(a^2 - x^2). */
  double a = pow(LOAD / (0.75 * acos(-1.0) * E_STAR * PROFILE), 0.25), p0 = E_STAR * PROFILE * pow(a, 3);
  printf("half contact length   %9.3f mm      exact %11.6f\n", contact_edge, a);
  printf("edge of the pressure  %12.6f mm   error %9.1e\n", refined, refined - a);
  printf("pressure, first cell  %9.1f N/mm^2  exact %9.1f at x = 0\n", force[0] / (2.0 * H), p0);
  printf("largest pressure      %9.1f N/mm^2  exact %9.1f at x = a/sqrt(2)\n", largest, sqrt(2.0) * p0);
  printf("residual              %9.1e         %d points in contact\n", info.residual, info.contacts);
  /* The edge is far finer than the grid, the cells know the largest pressure to a thousandth. */
  double edge = fabs(refined / a - 1.0), pressure = fabs(largest / (sqrt(2.0) * p0) - 1.0);
  int right = (edge <= 1e-3 * H / a) + (pressure <= 1e-3);
  printf("\nverdict: %d of 2 against the exact edge and pressure, worst %.1E\n", right, fmax(edge, pressure));
  return right != 2;
}
