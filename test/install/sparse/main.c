/* The influence matrix of the paper's Table 1 by condensation of its inverse, with an installed fuge. */
#include <fuge.h>
#include <stdio.h>

int main(void) {
  const int column[3] = {0, 2, 3}, row[3] = {0, 1, 1}, dof[2] = {0, 1};
  const double value[3] = {20.0 / 3, -10.0 / 3, 20.0 / 3}, normal[2] = {1.0, 1.0}, gap[2] = {0.0, 1.0};
  double alpha[4], force[2], gap_out[2], approach;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fuge_body *body = NULL;
  int status = fuge_body_sparse(2, column, row, value, &body, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_body_set_contact(body, 2, 1, dof, normal);
  if (status == FUGE_DONE) status = fuge_body_condense(body);
  if (status == FUGE_DONE) status = fuge_body_get_influence(body, alpha, 2);
  if (status != FUGE_DONE && body) fuge_body_message(body, message, sizeof message);
  if (status == FUGE_DONE)
    status = fuge_solve_dense(2, alpha, 2, gap, 2.0, force, gap_out, &approach, message, sizeof message);
  fuge_body_free(&body);
  if (status != FUGE_DONE) {
    fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
    return 1;
  }
  printf("force %.3f %.3f gap %.3f %.3f approach %.3f\n", force[0], force[1], gap_out[0], gap_out[1], approach);
  return 0;
}
