/* Section "fields" of fuge_elastic.h: below the cells of grids, and in layers. */
#include "check.h"

enum { NX = 3, NY = 2, N = NX * NY, DEPTHS = 3, SIDE = 9, CELLS = SIDE * SIDE };
static const double PI = 3.14159265358979323846, YOUNG = 2.0, POISSON = 0.25;
static const double FORCE[N] = {2.0, 0.0, 3.0, -1.0, 0.5, 4.0}, DEPTH[DEPTHS] = {0.75, 0.0, 2.0};
static const double INTERFACE[2] = {0.3, 0.3}, THICKNESS = 0.3, COAT[2] = {4.0, 1.0}, RATIO[2] = {0.2, 0.3};
static const int BELOW[2] = {0, 1};

typedef struct {
  double stress[6 * CELLS * 2], u[3 * CELLS * 2];
} values;

/* Below all cells, and nothing behind it; the field is freed. */
static void ask(fuge_field *field, int cells, int depths, const double *depth, const int *below, values *v) {
  const int n = cells * depths;
  fill(v->stress, 12 * CELLS);
  fill(v->u, 6 * CELLS);
  CHECK_DONE(fuge_field_grid_stress(field, depths, depth, below, v->stress, NULL, 0));
  CHECK_DONE(fuge_field_grid_displacement(field, depths, depth, below, v->u, NULL, 0));
  CHECK_UNTOUCHED(v->stress + 6 * n, 6 * (2 * CELLS - n));
  CHECK_UNTOUCHED(v->u + 3 * n, 3 * (2 * CELLS - n));
  fuge_field_free(&field);
}

/* The same at places: cell i + nx*j at (spacing*i, spacing*j). */
static void ask_places(fuge_field *field, int nx, int cells, double spacing, int depths, const double *depth,
                       const int *below, values *v) {
  double place[6 * CELLS];
  int lower[2 * CELLS];
  for (int k = 0; k < cells * depths; k++) {
    place[3 * k] = spacing * (k % cells % nx);
    place[3 * k + 1] = spacing * (k % cells / nx);
    place[3 * k + 2] = depth[k / cells];
    lower[k] = below ? below[k / cells] : 0;
  }
  CHECK_DONE(fuge_field_stress(field, cells * depths, place, lower, v->stress, NULL, 0));
  CHECK_DONE(fuge_field_displacement(field, cells * depths, place, lower, v->u, NULL, 0));
  fuge_field_free(&field);
}

static void compare(const values *found, const values *expected, int n, double tolerance) {
  for (int k = 0; k < 6 * n; k++) CHECK_NEAR(found->stress[k], expected->stress[k], tolerance);
  for (int k = 0; k < 3 * n; k++) CHECK_NEAR(found->u[k], expected->u[k], tolerance);
}

static fuge_field *line(int n, double spacing, const double *force, int element, int boundary) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_halfplane_grid(n, spacing, force, element, boundary, YOUNG, POISSON, FUGE_PLANE_STRAIN, &field,
                                       NULL, 0));
  return field;
}

static fuge_field *area(int nx, int ny, double spacing_x, double spacing_y, const double *force, int boundary) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_halfspace_grid(nx, ny, spacing_x, spacing_y, force, boundary, YOUNG, POISSON, &field, NULL, 0));
  return field;
}

/* Below the centres the same numbers as at places there. */
static void test_places(void) {
  values found, expected;
  for (int element = FUGE_CENTRE; element <= FUGE_HAT; element++) {
    ask(line(N, 0.5, FORCE, element, FUGE_FREE), N, DEPTHS, DEPTH, NULL, &found);
    ask_places(line(N, 0.5, FORCE, element, FUGE_FREE), N, N, 0.5, DEPTHS, DEPTH, NULL, &expected);
    compare(&found, &expected, N * DEPTHS, 1e-13);
  }
  ask(area(NX, NY, 0.5, 0.5, FORCE, FUGE_FREE), N, DEPTHS, DEPTH, NULL, &found);
  ask_places(area(NX, NY, 0.5, 0.5, FORCE, FUGE_FREE), NX, N, 0.5, DEPTHS, DEPTH, NULL, &expected);
  compare(&found, &expected, N * DEPTHS, 1e-13);
}

/* Wide cells with the same force in each row along y are a half-plane in plane strain; a wave along x. */
static void test_waves(void) {
  enum { MANY = 64 };
  double row[MANY], rows[MANY * NY];
  const double h = 1.0 / MANY, q = 2.0 * PI, z = 0.25;
  values plane, solid;
  for (int i = 0; i < MANY; i++) {
    row[i] = h * cos(q * h * i);
    rows[i] = rows[i + MANY] = 3.0 * row[i];
  }
  ask(line(MANY, h, row, FUGE_HAT, FUGE_PERIODIC), MANY, 1, &z, NULL, &plane);
  CHECK_NEAR(plane.stress[0], -(1.0 - q * z) * exp(-q * z), 1e-3);
  CHECK_NEAR(plane.stress[2], -(1.0 + q * z) * exp(-q * z), 1e-3);
  CHECK_NEAR(plane.stress[6 * MANY / 4 + 4], -q * z * exp(-q * z), 1e-3);
  ask(line(MANY, h, row, FUGE_MEAN, FUGE_PERIODIC), MANY, 1, &z, NULL, &plane);
  ask(area(MANY, NY, h, 3.0, rows, FUGE_PERIODIC), MANY * NY, 1, &z, NULL, &solid);
  for (int k = 0; k < 6 * MANY * NY; k++) CHECK_NEAR(solid.stress[k], plane.stress[k % (6 * MANY)], 1e-14);
  for (int k = 0; k < 3 * MANY * NY; k++) CHECK_NEAR(solid.u[k], plane.u[k % (3 * MANY)], 1e-14);
  CHECK_NEAR(plane.stress[1], POISSON * (plane.stress[0] + plane.stress[2]), 1e-15);
}

/* Love's value below the centre of one square of unit pressure; at the surface the pressure of each cell. */
static void test_squares(void) {
  const double a = 0.5, r = sqrt(2.0 * a * a + 1.0), one = 1.0;
  values v;
  ask(area(1, 1, 1.0, 1.0, &one, FUGE_FREE), 1, 1, &one, NULL, &v);
  CHECK_NEAR(v.stress[2], -2.0 / PI * (atan(a * a / r) + a * a / r * 2.0 / (a * a + 1.0)), 1e-15);
  for (int boundary = FUGE_FREE; boundary <= FUGE_PERIODIC_Y; boundary++) {
    ask(area(NX, NY, 0.5, 2.0, FORCE, boundary), N, DEPTHS, DEPTH, NULL, &v);
    for (int i = 0; i < N; i++) CHECK_NEAR(v.stress[6 * (i + N) + 2], -FORCE[i], 0.0);
  }
  ask(area(NX, NY, 0.5, 2.0, FORCE, FUGE_FREE), N, 0, DEPTH, NULL, &v);
}

static void press(double *force) {
  for (int k = 0; k < CELLS; k++) {
    const int i = k % SIDE - SIDE / 2, j = k / SIDE - SIDE / 2;
    force[k] = i * i + j * j < 9 ? sqrt(9.0 - i * i - j * j) : 0.0;
  }
}

static fuge_field *layered_line(const double *young, const double *poisson, int bonded, int n, const double *force,
                                int boundary) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_layered_line_grid(1, &THICKNESS, young, poisson, bonded, n, 0.2, force, FUGE_MEAN, boundary,
                                          &field, NULL, 0));
  return field;
}

static fuge_field *layered_area(const double *young, const double *poisson, const double *force) {
  fuge_field *field = NULL;
  CHECK_DONE(fuge_field_layered_area_grid(1, &THICKNESS, young, poisson, 1, SIDE, SIDE, 0.2, 0.2, force, FUGE_FREE,
                                          &field, NULL, 0));
  return field;
}

/* A layer of the half-space's material. */
static void test_half_space(void) {
  const double young[2] = {YOUNG, YOUNG}, ratio[2] = {POISSON, POISSON}, depth[2] = {0.0, 0.4};
  double force[CELLS];
  values found, expected;
  press(force);
  ask(layered_area(young, ratio, force), CELLS, 2, depth, NULL, &found);
  ask(area(SIDE, SIDE, 0.2, 0.2, force, FUGE_FREE), CELLS, 2, depth, NULL, &expected);
  compare(&found, &expected, 2 * CELLS, 2e-13);
  ask(layered_line(young, ratio, 1, CELLS, force, FUGE_PERIODIC), CELLS, 2, depth, NULL, &found);
  ask(line(CELLS, 0.2, force, FUGE_MEAN, FUGE_PERIODIC), CELLS, 2, depth, NULL, &expected);
  compare(&found, &expected, 2 * CELLS, 2e-13);
}

/* Both sides of an interface, and what is largest there. */
static void test_interface(void) {
  const int middle = CELLS / 2;
  double force[CELLS];
  fuge_interface_stress peaks[2] = {{0}, {.reserved = {SENTINEL, SENTINEL, SENTINEL, SENTINEL, SENTINEL}}};
  int interfaces = -1;
  values v;
  press(force);
  fuge_field *field = layered_area(COAT, RATIO, force);
  CHECK_DONE(fuge_field_interfaces(field, 0, &interfaces, NULL, NULL, 0));
  CHECK_INT(interfaces, 1);
  CHECK_DONE(fuge_field_interfaces(field, 1, &interfaces, peaks, NULL, 0));
  CHECK(peaks[0].shear == 0.0 && peaks[0].tension_above != 0.0 && peaks[1].depth == 0.0);
  CHECK_DONE(fuge_field_interfaces(field, 2, &interfaces, peaks, NULL, 0));
  for (int k = 0; k < 5; k++) CHECK_NEAR(peaks[1].reserved[k], 0.0, 0.0);
  ask(field, CELLS, 2, INTERFACE, BELOW, &v);
  CHECK_NEAR(peaks[1].depth, 0.3, 0.0);
  CHECK_INT(peaks[1].cell_above, middle);
  CHECK_NEAR(peaks[1].tension_above, v.stress[6 * middle], 1e-9);
  CHECK_NEAR(v.stress[6 * middle + 2], v.stress[6 * (middle + CELLS) + 2], 1e-9);
  CHECK(v.stress[6 * middle] > v.stress[6 * (middle + CELLS)]);
  CHECK_NEAR(peaks[1].shear, hypot(v.stress[6 * peaks[1].cell_of_shear + 3], v.stress[6 * peaks[1].cell_of_shear + 4]),
             1e-9);
  field = layered_line(COAT, RATIO, 0, CELLS, force, FUGE_FREE);
  CHECK_DONE(fuge_field_interfaces(field, 2, &interfaces, peaks, NULL, 0));
  CHECK_INT(interfaces, 1);
  CHECK_NEAR(peaks[1].shear, 0.0, 1e-12);
  CHECK(peaks[1].cell_below >= 0 && peaks[1].cell_below < CELLS);
  fuge_field_free(&field);
}

/* Places are those of a grid, also without one; a cell at x = 0 is its own image. */
static void test_layered_places(void) {
  double force[CELLS], x[CELLS], y[CELLS], width[CELLS], surface[3] = {0, 0, 0}, stress[6];
  const double *const row = force + SIDE * (SIDE / 2);
  fuge_field *field = NULL;
  values found, expected;
  press(force);
  for (int k = 0; k < CELLS; k++) {
    x[k] = 0.2 * (k % SIDE);
    y[k] = 0.2 * (k / SIDE);
    width[k] = 0.2;
  }
  ask(layered_area(COAT, RATIO, force), CELLS, 2, INTERFACE, BELOW, &expected);
  CHECK_DONE(fuge_field_layered_area(1, &THICKNESS, COAT, RATIO, 1, CELLS, x, y, width, width, force, 0, 0, &field,
                                     NULL, 0));
  ask_places(field, SIDE, CELLS, 0.2, 2, INTERFACE, BELOW, &found);
  compare(&found, &expected, 2 * CELLS, 1e-10);
  ask(layered_line(COAT, RATIO, 1, SIDE, row, FUGE_FREE), SIDE, 2, INTERFACE, BELOW, &expected);
  ask_places(layered_line(COAT, RATIO, 1, SIDE, row, FUGE_FREE), SIDE, SIDE, 0.2, 2, INTERFACE, BELOW, &found);
  compare(&found, &expected, 2 * SIDE, 1e-10);
  CHECK_NEAR(found.stress[1], RATIO[0] * (found.stress[0] + found.stress[2]), 1e-14);
  CHECK_NEAR(found.stress[6 * SIDE + 1], RATIO[1] * (found.stress[6 * SIDE] + found.stress[6 * SIDE + 2]), 1e-14);
  CHECK_DONE(fuge_field_layered_line(1, &THICKNESS, COAT, RATIO, 1, 1, x, width, row + 4, FUGE_MEAN, 1, &field, NULL,
                                     0));
  CHECK_DONE(fuge_field_stress(field, 1, surface, NULL, stress, NULL, 0));
  CHECK_NEAR(stress[2], -row[4] / 0.2, 1e-12);
  fuge_field_free(&field);
}

static void test_layered_peaks(void) {
  double force[CELLS], tensor[6];
  fuge_stress_peak peak = {0};
  press(force);
  fuge_field *field = layered_area(COAT, RATIO, force);
  CHECK_DONE(fuge_field_largest(field, FUGE_MEASURE_VON_MISES, &peak, NULL, 0));
  CHECK(peak.value > 0.0 && peak.layer >= 0 && peak.layer <= 1 && peak.cell >= 0 && peak.cell < CELLS);
  CHECK_NEAR(peak.place[0], 0.2 * (peak.cell % SIDE), 1e-15);
  CHECK_NEAR(peak.place[1], 0.2 * (peak.cell / SIDE), 1e-15);
  CHECK_INT(peak.location, peak.place[2] > 0.0 ? FUGE_PEAK_INSIDE : FUGE_PEAK_SURFACE);
  CHECK_DONE(fuge_field_stress(field, 1, peak.place, &peak.layer, tensor, NULL, 0));
  for (int k = 0; k < 6; k++) CHECK_NEAR(tensor[k], peak.tensor[k], 1e-7 * peak.value);
  fuge_field_free(&field);
  field = layered_line(COAT, RATIO, 1, SIDE, force + SIDE * (SIDE / 2), FUGE_PERIODIC);
  CHECK_DONE(fuge_field_largest(field, FUGE_MEASURE_TRESCA, &peak, NULL, 0));
  CHECK(peak.value > 0.0 && peak.cell >= 0 && peak.cell < SIDE);
  fuge_field_free(&field);
}

static fuge_field *field;
static char message[FUGE_MESSAGE_LENGTH + 1];
#define CHECK_REFUSED(call, status, part) \
  do { \
    CHECK_SAYS(call, status, message, part); \
    CHECK(field == NULL); \
  } while (0)

static int grid(int nx, int ny, double spacing, const double *force, int boundary, double young, double poisson) {
  const int status = fuge_field_halfspace_grid(nx, ny, spacing, 1.0, force, boundary, young, poisson, &field, NULL, 0);
  /* A line refuses the same. */
  if (ny != 1) return fuge_field_halfspace_grid(nx, ny, spacing, 1.0, force, boundary, young, poisson, &field, message,
                                                sizeof message);
  CHECK_STATUS(fuge_field_halfplane_grid(nx, spacing, force, FUGE_MEAN, boundary, young, poisson, FUGE_PLANE_STRAIN,
                                         &field, message, sizeof message), status);
  return status;
}

static void test_refused_grids(void) {
  const double bad[N] = {1.0, NAN, 1.0, 1.0, 1.0, 1.0};
  field = NULL;
  CHECK_REFUSED(grid(0, NY, 1.0, FORCE, FUGE_FREE, 1.0, 0.3), FUGE_ERR_SIZE, "nx = 0");
  CHECK_REFUSED(grid(1, -2, 1.0, FORCE, FUGE_FREE, 1.0, 0.3), FUGE_ERR_SIZE, "ny = -2");
  CHECK_REFUSED(grid(1 << 20, 1 << 20, 1.0, FORCE, FUGE_FREE, 1.0, 0.3), FUGE_ERR_SIZE, "more than an integer counts");
  CHECK_REFUSED(grid(0, 1, 1.0, FORCE, FUGE_FREE, 1.0, 0.3), FUGE_ERR_SIZE, "n = 0");
  CHECK_REFUSED(grid(N, 1, 1.0, NULL, FUGE_FREE, 1.0, 0.3), FUGE_ERR_POINTER, "force is NULL");
  CHECK_REFUSED(grid(N, 1, 1.0, bad, FUGE_FREE, 1.0, 0.3), FUGE_ERR_NOT_FINITE, "force(1)");
  CHECK_REFUSED(grid(N, 1, 0.0, FORCE, FUGE_PERIODIC, 1.0, 0.3), FUGE_ERR_WIDTH, "spacing");
  CHECK_REFUSED(grid(N, 1, 1.0, FORCE, 9, 1.0, 0.3), FUGE_ERR_OPTION, "boundary = 9");
  CHECK_REFUSED(grid(N, 1, 1.0, FORCE, FUGE_FREE, 0.0, 0.3), FUGE_ERR_MODULUS, "young = 0.");
  CHECK_REFUSED(grid(N, 1, 1.0, FORCE, FUGE_FREE, 1.0, 0.6), FUGE_ERR_MODULUS, "poisson = 0.6");
  CHECK_REFUSED(fuge_field_halfplane_grid(N, 1.0, FORCE, 7, FUGE_FREE, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, message,
                                          sizeof message), FUGE_ERR_ELEMENT, "element = 7");
}

static int layers(int number, const double *thickness, const double *young, double spacing, int boundary) {
  double force[CELLS];
  press(force);
  return fuge_field_layered_area_grid(number, thickness, young, RATIO, 1, SIDE, SIDE, spacing, 0.2, force, boundary,
                                      &field, message, sizeof message);
}

static void test_refused_layers(void) {
  CHECK_REFUSED(layers(1, NULL, COAT, 0.2, FUGE_FREE), FUGE_ERR_POINTER, "thickness is NULL");
  CHECK_REFUSED(layers(-1, &THICKNESS, COAT, 0.2, FUGE_FREE), FUGE_ERR_SIZE, "layers = -1");
  CHECK_REFUSED(layers(1, &THICKNESS, COAT, 0.2, 99), FUGE_ERR_OPTION, "boundary = 99");
  CHECK_REFUSED(layers(1, &THICKNESS, COAT, -0.2, FUGE_FREE), FUGE_ERR_WIDTH, "spacing_x = -0.2");
  CHECK_REFUSED(fuge_field_layered_line_grid(1, &THICKNESS, COAT, RATIO, 1, N, 0.2, FORCE, FUGE_HAT, FUGE_FREE, &field,
                                             message, sizeof message), FUGE_ERR_ELEMENT, "element FUGE_HAT");
}

static void check_depth(int depths, const double *depth, int status, const char *part) {
  values v;
  fill(v.stress, 18);
  CHECK_SAYS(fuge_field_grid_stress(field, depths, depth, NULL, v.stress, message, sizeof message), status, message,
             part);
  CHECK_SAYS(fuge_field_grid_displacement(field, depths, depth, NULL, v.stress, message, sizeof message), status,
             message, part);
  CHECK_UNTOUCHED(v.stress, 18);
}

static void test_refused_depths(void) {
  const double above[DEPTHS] = {0.0, -0.5, 1.0}, rigid[2] = {1.0, INFINITY}, one = 1.0, place[3] = {0, 0, 1};
  double force[CELLS], value[6];
  fuge_interface_stress peaks[1];
  fuge_stress_peak peak;
  int interfaces = 7;
  check_depth(1, DEPTH, FUGE_ERR_POINTER, "field is NULL");
  field = area(NX, NY, 1.0, 1.0, FORCE, FUGE_PERIODIC);
  check_depth(-1, DEPTH, FUGE_ERR_SIZE, "depths = -1");
  check_depth(DEPTHS, NULL, FUGE_ERR_POINTER, "depth is NULL");
  check_depth(DEPTHS, above, FUGE_ERR_GRID, "depth(1) = -0.5");
  CHECK_STATUS(fuge_field_grid_stress(field, 1, DEPTH, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_field_grid_displacement(field, 1, DEPTH, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  /* A periodic grid has no places, and no layers. */
  CHECK_SAYS(fuge_field_stress(field, 1, place, NULL, value, message, sizeof message), FUGE_ERR_UNSUPPORTED, message,
             "take grid_stress");
  CHECK_STATUS(fuge_field_largest(field, 0, &peak, NULL, 0), FUGE_ERR_UNSUPPORTED);
  CHECK_SAYS(fuge_field_interfaces(field, 1, &interfaces, peaks, message, sizeof message), FUGE_ERR_UNSUPPORTED,
             message, "without layers");
  fuge_field_free(&field);
  field = line(N, 1.0, FORCE, FUGE_MEAN, FUGE_PERIODIC);
  CHECK_STATUS(fuge_field_largest(field, 0, &peak, NULL, 0), FUGE_ERR_UNSUPPORTED);
  fuge_field_free(&field);
  CHECK_DONE(fuge_field_halfplane(1, &one, &one, &one, FUGE_MEAN, 0, 1.0, 0.3, FUGE_PLANE_STRAIN, &field, NULL, 0));
  check_depth(1, DEPTH, FUGE_ERR_UNSUPPORTED, "not that of a grid");
  fuge_field_free(&field);
  /* Layers: a rigid base has no stresses; what is largest needs a grid. */
  press(force);
  field = layered_area(rigid, RATIO, force);
  check_depth(1, DEPTH, FUGE_ERR_GRID, "depth(0) = 0.75");
  CHECK_SAYS(fuge_field_stress(field, 1, place, NULL, value, message, sizeof message), FUGE_ERR_GRID, message,
             "z(0) = 1.");
  CHECK_STATUS(fuge_field_largest(field, 99, &peak, NULL, 0), FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_field_interfaces(field, 1, NULL, peaks, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_field_interfaces(field, 1, &interfaces, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_field_interfaces(field, -1, &interfaces, peaks, NULL, 0), FUGE_ERR_SIZE);
  fuge_field_free(&field);
  CHECK_DONE(fuge_field_layered_line(1, &THICKNESS, COAT, RATIO, 1, 1, &one, &one, &one, FUGE_MEAN, 0, &field, NULL,
                                     0));
  CHECK_STATUS(fuge_field_largest(field, 0, &peak, NULL, 0), FUGE_ERR_UNSUPPORTED);
  CHECK_STATUS(fuge_field_interfaces(field, 1, &interfaces, peaks, NULL, 0), FUGE_ERR_UNSUPPORTED);
  CHECK_INT(interfaces, 7);
  fuge_field_free(&field);
}

int main(void) {
  test_places();
  test_waves();
  test_squares();
  test_half_space();
  test_interface();
  test_layered_places();
  test_layered_peaks();
  test_refused_grids();
  test_refused_layers();
  test_refused_depths();
  return check_summary();
}
