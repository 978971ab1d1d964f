/* fuge.h as C++ reads it: compiles without a warning and links. */
#include "fuge.h"
#include <cmath>
#include <cstdio>
#include <cstring>
#include "fuge.h"

int main() {
  const double alpha[] = {0.2, 0.1, 0.1, 0.2}, gap[] = {0.0, 1.0};
  double force[2], gap_out[2], approach;
  const int status = fuge_solve_dense(2, alpha, 2, gap, 2.0, force, gap_out, &approach, NULL, 0);
  std::printf("%s: %s, force %g %g\n", fuge_version(), fuge_status_text(status), force[0], force[1]);
  const bool right = status == FUGE_DONE && std::fabs(force[0] - 2.0) < 1e-14 && std::fabs(approach - 0.4) < 1e-14;
  return right && std::strcmp(fuge_version(), FUGE_VERSION) == 0 ? 0 : 1;
}
