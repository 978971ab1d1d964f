// The paper's Table 1 with an installed fuge.
#include <fuge.h>
#include <cstdio>
#include <string>
#include <vector>

int main() {
  const std::vector<double> alpha = {0.2, 0.1, 0.1, 0.2}, gap = {0.0, 1.0};
  std::vector<double> force(2), gap_out(2);
  double approach;
  char message[FUGE_MESSAGE_LENGTH + 1];
  const int status = fuge_solve_dense(2, alpha.data(), 2, gap.data(), 2.0, force.data(), gap_out.data(), &approach,
                                      message, sizeof message);
  if (status != FUGE_DONE || std::string(fuge_version()) != FUGE_VERSION) {
    std::fprintf(stderr, "version %s, %s\n", fuge_version(), message);
    return 1;
  }
  std::printf("force %.3f %.3f gap %.3f %.3f approach %.3f\n", force[0], force[1], gap_out[0], gap_out[1], approach);
  return 0;
}
