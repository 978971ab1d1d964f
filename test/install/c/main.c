/* The paper's Table 1 with an installed fuge. */
#include <fuge.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  const double alpha[4] = {0.2, 0.1, 0.1, 0.2}, gap[2] = {0.0, 1.0};
  double force[2], gap_out[2], approach;
  char message[FUGE_MESSAGE_LENGTH + 1];
  int status = fuge_solve_dense(2, alpha, 2, gap, 2.0, force, gap_out, &approach, message, sizeof message);
  if (status != FUGE_DONE || strcmp(fuge_version(), FUGE_VERSION) != 0) {
    fprintf(stderr, "version %s, %s\n", fuge_version(), message);
    return 1;
  }
  printf("force %.3f %.3f gap %.3f %.3f approach %.3f\n", force[0], force[1], gap_out[0], gap_out[1], approach);
  return 0;
}
