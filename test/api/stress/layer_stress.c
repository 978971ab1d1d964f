/* Stresses in layers from C: against the half-space, both sides of an interface, the largest ones, errors. */
#include <math.h>
#include "check.h"

enum { N = 9, CELLS = N * N };

static const double thickness[] = {0.3}, young[] = {4.0, 1.0}, poisson[] = {0.2, 0.3};

static void press(double *force) {
  for (int k = 0; k < CELLS; k++) {
    const int i = k % N - N / 2, j = k / N - N / 2;
    force[k] = i * i + j * j < 9 ? sqrt(9.0 - i * i - j * j) : 0.0;
  }
}

/* A layer of the half-space's material. */
static void test_half_space(void) {
  const double same[] = {1.0, 1.0}, ratio[] = {0.3, 0.3}, depth[] = {0.0, 0.4};
  double force[CELLS], found[6 * CELLS * 2], expected[6 * CELLS * 2], moved[3 * CELLS * 2], expected_move[3 * CELLS * 2];
  press(force);
  CHECK_DONE(fuge_layered_halfspace_stress_grid(1, thickness, same, ratio, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 2, depth,
                                                NULL, found, NULL, 0));
  CHECK_DONE(fuge_halfspace_stress_grid(N, N, 0.2, 0.2, force, FUGE_FREE, 0.3, 2, depth, expected, NULL, 0));
  CHECK_DONE(fuge_layered_halfspace_displacement_grid(1, thickness, same, ratio, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 2,
                                                      depth, NULL, moved, NULL, 0));
  CHECK_DONE(fuge_halfspace_displacement_grid(N, N, 0.2, 0.2, force, FUGE_FREE, 1.0, 0.3, 2, depth, expected_move, NULL, 0));
  for (int k = 0; k < 6 * CELLS * 2; k++) CHECK_NEAR(found[k], expected[k], 1e-13);
  for (int k = 0; k < 3 * CELLS * 2; k++) CHECK_NEAR(moved[k], expected_move[k], 1e-13);
  CHECK_DONE(fuge_layered_halfplane_stress_grid(1, thickness, same, ratio, 1, CELLS, 0.2, force, FUGE_MEAN, FUGE_PERIODIC, 2,
                                                depth, NULL, found, NULL, 0));
  CHECK_DONE(fuge_halfplane_stress_grid(CELLS, 0.2, force, FUGE_MEAN, FUGE_PERIODIC, 2, depth, expected, NULL, 0));
  CHECK_DONE(fuge_layered_halfplane_displacement_grid(1, thickness, same, ratio, 1, CELLS, 0.2, force, FUGE_MEAN,
                                                      FUGE_PERIODIC, 2, depth, NULL, moved, NULL, 0));
  CHECK_DONE(fuge_halfplane_displacement_grid(CELLS, 0.2, force, FUGE_MEAN, FUGE_PERIODIC, 1.0, 0.3, FUGE_PLANE_STRAIN, 2,
                                              depth, expected_move, NULL, 0));
  for (int k = 0; k < 3 * CELLS * 2; k++) CHECK_NEAR(found[k], expected[k], 1e-13);
  for (int k = 0; k < 2 * CELLS * 2; k++) CHECK_NEAR(moved[k], expected_move[k], 1e-13);
}

static void test_interface(void) {
  const double depth[] = {0.3, 0.3};
  const int below[] = {0, 1};
  double force[CELLS], stress[6 * CELLS * 2];
  fuge_interface_stress peaks[2];
  int interfaces = -1;
  const int middle = N / 2 + N * (N / 2);
  press(force);
  CHECK_DONE(fuge_layered_halfspace_stress_grid(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 2, depth,
                                                below, stress, NULL, 0));
  CHECK_DONE(fuge_layered_halfspace_interfaces(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE,
                                               &interfaces, peaks, NULL, 0));
  CHECK_INT(interfaces, 1);
  CHECK_NEAR(peaks[1].depth, 0.3, 0.0);
  CHECK_INT(peaks[1].cell_above, middle);
  CHECK_NEAR(peaks[1].tension_above, stress[6 * middle], 1e-9);
  CHECK_NEAR(stress[6 * middle + 2], stress[6 * (middle + CELLS) + 2], 1e-9);
  CHECK(stress[6 * middle] > stress[6 * (middle + CELLS)]);
  CHECK_NEAR(peaks[1].shear, hypot(stress[6 * peaks[1].cell_of_shear + 3], stress[6 * peaks[1].cell_of_shear + 4]), 1e-9);
  CHECK_DONE(fuge_layered_halfplane_interfaces(1, thickness, young, poisson, 0, CELLS, 0.2, force, FUGE_MEAN, FUGE_FREE,
                                               &interfaces, peaks, NULL, 0));
  CHECK_INT(interfaces, 1);
  CHECK_NEAR(peaks[1].shear, 0.0, 1e-12);
  CHECK(peaks[1].cell_below >= 0 && peaks[1].cell_below < CELLS);
}

static void test_errors(void) {
  const double depth[] = {0.5}, rigid[] = {1.0, INFINITY};
  double force[CELLS], stress[6 * CELLS] = {7.0};
  fuge_interface_stress peaks[2] = {{7.0, 0.0, 0.0, 0.0, 0.0, 0, 0, 0, 0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0, 0, 0, 0}};
  int interfaces = 7;
  char message[FUGE_MESSAGE_LENGTH + 1];
  press(force);
  CHECK_INT(fuge_layered_halfspace_stress_grid(1, thickness, rigid, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 1, depth,
                                               NULL, stress, message, sizeof message), FUGE_ERR_GRID);
  CHECK_INT(fuge_layered_halfplane_stress_grid(1, thickness, young, poisson, 1, N, 0.2, force, FUGE_HAT, FUGE_FREE, 1, depth,
                                               NULL, stress, message, sizeof message), FUGE_ERR_ELEMENT);
  CHECK_INT(fuge_layered_halfspace_stress_grid(1, NULL, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 1, depth, NULL,
                                               stress, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_INT(fuge_layered_halfspace_stress_grid(-1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 1, depth,
                                               NULL, stress, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_INT(fuge_layered_halfspace_displacement_grid(1, thickness, rigid, poisson, 1, N, N, 0.2, 0.2, force, 99, 1, depth,
                                                     NULL, stress, message, sizeof message), FUGE_ERR_OPTION);
  CHECK_INT(fuge_layered_halfspace_interfaces(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, NULL, peaks,
                                              message, sizeof message), FUGE_ERR_POINTER);
  CHECK_INT(fuge_layered_halfspace_interfaces(1, thickness, young, poisson, 1, N, N, 0.2, -0.2, force, FUGE_FREE, &interfaces,
                                              peaks, message, sizeof message), FUGE_ERR_WIDTH);
  CHECK_NEAR(stress[0], 7.0, 0.0);
  CHECK_NEAR(peaks[0].depth, 7.0, 0.0);
  CHECK_INT(interfaces, 7);
}

int main(void) {
  test_half_space();
  test_interface();
  test_errors();
  return check_summary();
}
