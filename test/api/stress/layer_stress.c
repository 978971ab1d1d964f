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

/* Points are those of a grid; symmetric models; the largest stress is not below theirs. */
static void test_points(void) {
  const double depth[] = {0.3, 0.3};
  const int below[] = {0, 1};
  double force[CELLS], x[CELLS], y[CELLS], width[CELLS], zero[CELLS], z[CELLS];
  double grid[6 * CELLS * 2], stress[6 * CELLS], line[3 * N], move[3 * CELLS], grid_move[3 * CELLS * 2];
  int lower[CELLS];
  fuge_layer_peak peak;
  press(force);
  for (int k = 0; k < CELLS; k++) {
    x[k] = 0.2 * (k % N);
    y[k] = 0.2 * (k / N);
    width[k] = 0.2;
    zero[k] = 0.0;
    z[k] = 0.3;
    lower[k] = 1;
  }
  CHECK_DONE(fuge_layered_halfspace_stress_grid(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 2, depth,
                                                below, grid, NULL, 0));
  CHECK_DONE(fuge_layered_halfspace_stress(1, thickness, young, poisson, 1, CELLS, x, y, width, width, force, 0, 0, CELLS, x, y,
                                           z, lower, stress, NULL, 0));
  for (int k = 0; k < 6 * CELLS; k++) CHECK_NEAR(stress[k], grid[6 * CELLS + k], 1e-10);
  CHECK_DONE(fuge_layered_halfspace_displacement_grid(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 2,
                                                      depth, NULL, grid_move, NULL, 0));
  CHECK_DONE(fuge_layered_halfspace_displacement(1, thickness, young, poisson, 1, CELLS, x, y, width, width, force, 0, 0, CELLS,
                                                 x, y, z, NULL, move, NULL, 0));
  for (int k = 0; k < 3 * CELLS; k++) CHECK_NEAR(move[k], grid_move[k], 1e-10);
  CHECK_DONE(fuge_layered_halfplane_stress_grid(1, thickness, young, poisson, 1, N, 0.2, force + N * (N / 2), FUGE_MEAN,
                                                FUGE_FREE, 2, depth, below, grid, NULL, 0));
  CHECK_DONE(fuge_layered_halfplane_stress(1, thickness, young, poisson, 1, N, x, width, force + N * (N / 2), FUGE_MEAN, 0, N, x,
                                           z, lower, line, NULL, 0));
  for (int k = 0; k < 3 * N; k++) CHECK_NEAR(line[k], grid[3 * N + k], 1e-10);
  CHECK_DONE(fuge_layered_halfplane_displacement_grid(1, thickness, young, poisson, 1, N, 0.2, force + N * (N / 2), FUGE_MEAN,
                                                      FUGE_FREE, 2, depth, below, grid_move, NULL, 0));
  CHECK_DONE(fuge_layered_halfplane_displacement(1, thickness, young, poisson, 1, N, x, width, force + N * (N / 2), FUGE_MEAN, 0,
                                                 N, x, z, NULL, move, NULL, 0));
  for (int k = 0; k < 2 * N; k++) CHECK_NEAR(move[k], grid_move[k], 1e-10);
  /* One cell at x = 0 is its own image. */
  CHECK_DONE(fuge_layered_halfplane_stress(1, thickness, young, poisson, 1, 1, x, width, force + N * (N / 2) + 4, FUGE_MEAN, 1, 1,
                                           x, zero, NULL, line, NULL, 0));
  CHECK_NEAR(line[1], -force[N * (N / 2) + 4] / 0.2, 1e-12);
  CHECK_DONE(fuge_layered_halfspace_peak(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE,
                                         FUGE_MEASURE_VON_MISES, &peak, NULL, 0));
  CHECK(peak.value > 0.0 && peak.layer >= 0 && peak.layer <= 1 && peak.cell >= 0 && peak.cell < CELLS);
  CHECK_DONE(fuge_layered_halfplane_peak(1, thickness, young, poisson, 1, N, 0.2, force + N * (N / 2), FUGE_MEAN, FUGE_FREE,
                                         FUGE_MEASURE_TRESCA, &peak, NULL, 0));
  CHECK(peak.value > 0.0 && peak.cell >= 0 && peak.cell < N);
  CHECK_INT(fuge_layered_halfspace_peak(1, thickness, young, poisson, 1, N, N, 0.2, 0.2, force, FUGE_FREE, 99, &peak, NULL, 0),
            FUGE_ERR_OPTION);
  CHECK_INT(fuge_layered_halfplane_peak(1, thickness, young, poisson, 1, N, 0.2, force, FUGE_MEAN, FUGE_FREE,
                                        FUGE_MEASURE_TRESCA, NULL, NULL, 0), FUGE_ERR_POINTER);
  z[0] = -1.0;
  CHECK_INT(fuge_layered_halfspace_stress(1, thickness, young, poisson, 1, CELLS, x, y, width, width, force, 0, 0, CELLS, x, y,
                                          z, NULL, stress, NULL, 0), FUGE_ERR_GRID);
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
  test_points();
  test_errors();
  return check_summary();
}
