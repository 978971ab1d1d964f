/* The section "stresses on grids" of fuge_stress.h. */
#include "check.h"

enum { NX = 3, NY = 2, N = NX * NY, DEPTHS = 3 };
static const double PI = 3.14159265358979323846;
static const double FORCE[N] = {2.0, 0.0, 3.0, -1.0, 0.5, 4.0}, DEPTH[DEPTHS] = {0.75, 0.0, 2.0};
static const double YOUNG = 2.0, POISSON = 0.25;

/* The same numbers as those of the points, in the order of memory. */
static void test_halfplane_points(void) {
  double x[N], width[N], px[N * DEPTHS], pz[N * DEPTHS];
  for (int i = 0; i < N; i++) {
    x[i] = 0.5 * i;
    width[i] = 0.5;
    for (int k = 0; k < DEPTHS; k++) {
      px[i + N * k] = x[i];
      pz[i + N * k] = DEPTH[k];
    }
  }
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++) {
    double stress[3 * N * DEPTHS + 1], expected[3 * N * DEPTHS], motion[2 * N * DEPTHS + 1],
      expected_motion[2 * N * DEPTHS];
    fill(stress, 3 * N * DEPTHS + 1);
    fill(motion, 2 * N * DEPTHS + 1);
    CHECK_DONE(fuge_halfplane_stress_grid(N, 0.5, FORCE, element, FUGE_FREE, DEPTHS, DEPTH, stress, NULL, 0));
    CHECK_DONE(fuge_halfplane_stress(N, x, width, FORCE, element, 0, N * DEPTHS, px, pz, expected, NULL, 0));
    for (int k = 0; k < 3 * N * DEPTHS; k++) CHECK_NEAR(stress[k], expected[k], 1e-13);
    CHECK_DONE(fuge_halfplane_displacement_grid(N, 0.5, FORCE, element, FUGE_FREE, YOUNG, POISSON, FUGE_PLANE_STRAIN,
                                                DEPTHS, DEPTH, motion, NULL, 0));
    CHECK_DONE(fuge_halfplane_displacement(N, x, width, FORCE, element, YOUNG, POISSON, FUGE_PLANE_STRAIN, 0,
                                           N * DEPTHS, px, pz, expected_motion, NULL, 0));
    for (int k = 0; k < 2 * N * DEPTHS; k++) CHECK_NEAR(motion[k], expected_motion[k], 1e-13);
    CHECK_UNTOUCHED(stress + 3 * N * DEPTHS, 1);
    CHECK_UNTOUCHED(motion + 2 * N * DEPTHS, 1);
  }
}

/* Wide cells with the same force in each row along y are a half-plane in plane strain; a wave along x. */
static void test_waves(void) {
  enum { MANY = 64 };
  double line[MANY], area[MANY * NY], stress[3 * MANY], solid[6 * MANY * NY], motion[2 * MANY], moved[3 * MANY * NY];
  const double h = 1.0 / MANY, q = 2.0 * PI, z = 0.25;
  for (int i = 0; i < MANY; i++) {
    line[i] = h * cos(q * h * i);
    area[i] = area[i + MANY] = 3.0 * line[i];
  }
  CHECK_DONE(fuge_halfplane_stress_grid(MANY, h, line, FUGE_HAT, FUGE_PERIODIC, 1, &z, stress, NULL, 0));
  CHECK_VALUES(stress, 1e-3, -(1.0 - q * z) * exp(-q * z), -(1.0 + q * z) * exp(-q * z));
  CHECK_NEAR(stress[3 * MANY / 4 + 2], -q * z * exp(-q * z), 1e-3);
  CHECK_DONE(fuge_halfplane_stress_grid(MANY, h, line, FUGE_MEAN, FUGE_PERIODIC, 1, &z, stress, NULL, 0));
  CHECK_DONE(fuge_halfspace_stress_grid(MANY, NY, h, 3.0, area, FUGE_PERIODIC, POISSON, 1, &z, solid, NULL, 0));
  CHECK_DONE(fuge_halfplane_displacement_grid(MANY, h, line, FUGE_MEAN, FUGE_PERIODIC, YOUNG, POISSON,
                                              FUGE_PLANE_STRAIN, 1, &z, motion, NULL, 0));
  CHECK_DONE(fuge_halfspace_displacement_grid(MANY, NY, h, 3.0, area, FUGE_PERIODIC, YOUNG, POISSON, 1, &z, moved, NULL,
                                              0));
  for (int i = 0; i < MANY * NY; i++) {
    const double *plane = stress + 3 * (i % MANY), *point = solid + 6 * i;
    CHECK_VALUES(point, 1e-14, plane[0], POISSON * (plane[0] + plane[1]), plane[1], 0.0, plane[2], 0.0);
    CHECK_NEAR(moved[3 * i], motion[2 * (i % MANY)], 1e-14);
    CHECK_NEAR(moved[3 * i + 1], 0.0, 1e-14);
    CHECK_NEAR(moved[3 * i + 2], motion[2 * (i % MANY) + 1], 1e-14);
  }
}

/* Love's values below the centre of one square of unit pressure, and cell (i, j) at i + nx*j. */
static void test_halfspace_order(void) {
  const double a = 0.5, r = sqrt(2.0 * a * a + 1.0), single = 1.0, one = 1.0;
  double stress[6 * N * DEPTHS + 1], displacement[3 * N * DEPTHS + 1];
  CHECK_DONE(fuge_halfspace_stress_grid(1, 1, 1.0, 1.0, &single, FUGE_FREE, POISSON, 1, &one, stress, NULL, 0));
  CHECK_NEAR(stress[2], -2.0 / PI * (atan(a * a / r) + a * a / r * (1.0 / (a * a + 1.0) + 1.0 / (a * a + 1.0))), 1e-15);
  fill(stress, 6 * N * DEPTHS + 1);
  fill(displacement, 3 * N * DEPTHS + 1);
  CHECK_DONE(fuge_halfspace_stress_grid(NX, NY, 0.5, 2.0, FORCE, FUGE_FREE, POISSON, DEPTHS, DEPTH, stress, NULL, 0));
  CHECK_DONE(fuge_halfspace_displacement_grid(NX, NY, 0.5, 2.0, FORCE, FUGE_FREE, YOUNG, POISSON, DEPTHS, DEPTH,
                                              displacement, NULL, 0));
  for (int i = 0; i < N; i++) CHECK_NEAR(stress[6 * (i + N) + 2], -FORCE[i], 0.0);
  CHECK_UNTOUCHED(stress + 6 * N * DEPTHS, 1);
  CHECK_UNTOUCHED(displacement + 3 * N * DEPTHS, 1);
  for (int k = 0; k < 3 * N * DEPTHS; k++) CHECK(displacement[k] < 1e9 && displacement[k] > -1e9);
  for (int boundary = FUGE_PERIODIC_X; boundary <= FUGE_PERIODIC_Y; boundary++) {
    CHECK_DONE(fuge_halfspace_stress_grid(NX, NY, 0.5, 2.0, FORCE, boundary, POISSON, DEPTHS, DEPTH, stress, NULL, 0));
    for (int i = 0; i < N; i++) CHECK_NEAR(stress[6 * (i + N) + 2], -FORCE[i], 0.0);
  }
}

static void check_refusal(int nx, int ny, double spacing, const double *force, int depths, const double *depth,
                          int boundary, int status, const char *part) {
  double result[6 * N * DEPTHS];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  fill(result, 6 * N * DEPTHS);
  CHECK_SAYS(fuge_halfspace_stress_grid(nx, ny, spacing, 1.0, force, boundary, POISSON, depths, depth, result, message,
                                        sizeof message), status, message, part);
  CHECK_SAYS(fuge_halfspace_displacement_grid(nx, ny, spacing, 1.0, force, boundary, YOUNG, POISSON, depths, depth,
                                              result, message, sizeof message), status, message, part);
  if (ny == 1) {
    CHECK_STATUS(fuge_halfplane_stress_grid(nx, spacing, force, FUGE_MEAN, boundary, depths, depth, result, NULL, 0),
                 status);
    CHECK_STATUS(fuge_halfplane_displacement_grid(nx, spacing, force, FUGE_MEAN, boundary, YOUNG, POISSON,
                                                  FUGE_PLANE_STRESS, depths, depth, result, NULL, 0), status);
  }
  CHECK_UNTOUCHED(result, 6 * N * DEPTHS);
}

static void test_refusals(void) {
  const double above[DEPTHS] = {0.0, -0.5, 1.0}, bad[N] = {1.0, NAN, 1.0, 1.0, 1.0, 1.0};
  double result[6 * N * DEPTHS];
  check_refusal(0, 1, 1.0, FORCE, DEPTHS, DEPTH, FUGE_FREE, FUGE_ERR_SIZE, "nx = 0");
  check_refusal(1, -2, 1.0, FORCE, DEPTHS, DEPTH, FUGE_FREE, FUGE_ERR_SIZE, "ny = -2");
  check_refusal(1 << 20, 1 << 20, 1.0, FORCE, DEPTHS, DEPTH, FUGE_FREE, FUGE_ERR_SIZE, "largest integer");
  check_refusal(N, 1, 1.0, FORCE, -1, DEPTH, FUGE_FREE, FUGE_ERR_SIZE, "depths = -1");
  check_refusal(N, 1, 1.0, NULL, DEPTHS, DEPTH, FUGE_FREE, FUGE_ERR_POINTER, "force is NULL");
  check_refusal(N, 1, 1.0, FORCE, DEPTHS, NULL, FUGE_FREE, FUGE_ERR_POINTER, "depth is NULL");
  check_refusal(N, 1, 1.0, bad, DEPTHS, DEPTH, FUGE_FREE, FUGE_ERR_NOT_FINITE, "force(1)");
  check_refusal(N, 1, 0.0, FORCE, DEPTHS, DEPTH, FUGE_PERIODIC, FUGE_ERR_WIDTH, "spacing");
  check_refusal(N, 1, 1.0, FORCE, DEPTHS, above, FUGE_PERIODIC, FUGE_ERR_GRID, "depth(1) = -0.5");
  check_refusal(N, 1, 1.0, FORCE, DEPTHS, DEPTH, 9, FUGE_ERR_OPTION, "boundary = 9");
  CHECK_STATUS(fuge_halfplane_stress_grid(N, 1.0, FORCE, 7, FUGE_FREE, DEPTHS, DEPTH, result, NULL, 0),
               FUGE_ERR_ELEMENT);
  CHECK_STATUS(fuge_halfplane_stress_grid(N, 1.0, FORCE, FUGE_MEAN, FUGE_FREE, DEPTHS, DEPTH, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_halfspace_displacement_grid(NX, NY, 1.0, 1.0, FORCE, FUGE_FREE, 0.0, POISSON, DEPTHS, DEPTH, result,
                                                NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_halfspace_stress_grid(NX, NY, 1.0, 1.0, FORCE, FUGE_FREE, 0.6, DEPTHS, DEPTH, result, NULL, 0),
               FUGE_ERR_MODULUS);
  fill(result, 6 * N * DEPTHS);
  CHECK_DONE(fuge_halfspace_stress_grid(NX, NY, 1.0, 1.0, FORCE, FUGE_FREE, POISSON, 0, DEPTH, result, NULL, 0));
  CHECK_UNTOUCHED(result, 6 * N * DEPTHS);
}

int main(void) {
  test_halfplane_points();
  test_waves();
  test_halfspace_order();
  test_refusals();
  return check_summary();
}
