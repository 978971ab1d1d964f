/* A rigid plate on a half-plane by FFT; C, and C++. */
#include <fuge.h>
#include <stdio.h>

int main(void) {
  enum { N = 3 };
  const double gap[N] = {0.0, 0.0, 0.0};
  double force[N];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *op = NULL;
  fuge_solver *solver = NULL;
  int status = fuge_operator_halfplane(N, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &op, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_solver_new(op, NULL, &solver, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_set_gap(solver, gap, NULL);
  if (status == FUGE_DONE) status = fuge_set_load(solver, 3.0);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  if (status == FUGE_DONE) status = fuge_get_force(solver, force);
  if (status == FUGE_DONE && force[0] > force[1] && force[1] > 0.0)
    printf("by FFT: force %.6f %.6f %.6f\n", force[0], force[1], force[2]);
  else
    fprintf(stderr, "status %d, %s\n", status, message);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  return status != FUGE_DONE;
}
