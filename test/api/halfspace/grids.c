/* Section "operators" of fuge_core.h: callback operators of cells of a grid need the products of the built-in
 * operators, whose products they do here by reference_operator.f90. */
#include <limits.h>
#include "table1.h"

void *reference_new(int nx, int ny, double spacing_x, double spacing_y, int element, int boundary);
int reference_apply(int n, const double *force, double *displacement, void *user);
int reference_precondition(int n, const double *displacement, double *force, void *user);
double reference_datum(void *reference);
void reference_free(void *reference);

enum { MOST_LEVELS = 12, FEWEST = 32 };

/* ny = 0: a half-plane, whose cells are side by side. */
typedef struct grid {
  int nx, ny, element, boundary;
} grid;

/* A surface and its coarser grids, by callbacks, and the same by the library. */
typedef struct surface {
  int levels;
  void *reference[MOST_LEVELS];
  fuge_operator *op[MOST_LEVELS], *same[MOST_LEVELS];
} surface;

static int rows(int ny) { return ny > 0 ? ny : 1; }

static int repeats(grid g, int boundary) { return g.boundary == FUGE_PERIODIC || g.boundary == boundary; }

/* One more grid; its products leave out the datum. */
static void add_level(int nx, int ny, double spacing_x, double spacing_y, grid g, surface *s) {
  const int k = s->levels++;
  const double mean = ny == 0 && g.boundary == FUGE_PERIODIC ? 0.41132 : 0.0;
  s->reference[k] = reference_new(nx, ny, spacing_x, spacing_y, g.element, g.boundary);
  CHECK(s->reference[k] != NULL);
  CHECK_DONE(fuge_operator_callback(nx * rows(ny), reference_apply, s->reference[k], &s->op[k], NULL, 0));
  CHECK_DONE(fuge_operator_set_coefficients(s->op[k], reference_datum(s->reference[k]), mean, NULL, 0));
  if (ny == 0)
    CHECK_DONE(fuge_operator_halfplane(nx, spacing_x, 1.0, g.element, g.boundary, &s->same[k], NULL, 0));
  else
    CHECK_DONE(fuge_operator_halfspace(nx, ny, spacing_x, spacing_y, 1.0, g.element, g.boundary, &s->same[k], NULL, 0));
}

/* All grids of at least 32 cells, but the finest one in any case. */
static void make_surface(grid g, double width, surface *s) {
  int nx = g.nx, ny = g.ny;
  double spacing_x = width, spacing_y = width;
  s->levels = 0;
  do {
    add_level(nx, ny, spacing_x, spacing_y, g, s);
    if (nx > 1) spacing_x *= 2.0;
    if (ny > 1) spacing_y *= 2.0;
    nx = (nx + 1) / 2;
    ny = (ny + 1) / 2;
    /* The period stays, so that wider cells may be a little narrower. */
    if (repeats(g, FUGE_PERIODIC_X)) spacing_x = width * ((double)g.nx / nx);
    if (repeats(g, FUGE_PERIODIC_Y) && g.ny > 0) spacing_y = width * ((double)g.ny / ny);
  } while (nx * rows(ny) >= FEWEST);
}

static void free_surface(surface *s) {
  for (int k = 0; k < s->levels; k++) {
    fuge_operator_free(&s->op[k]);
    fuge_operator_free(&s->same[k]);
    reference_free(s->reference[k]);
  }
}

/* The caller's own preconditioners and coarser grids. */
static void set_own_grids(grid g, surface *s) {
  int nx = g.nx, ny = rows(g.ny);
  for (int k = 0; k < s->levels; k++) {
    CHECK_DONE(fuge_operator_set_preconditioner(s->op[k], reference_precondition, NULL, 0));
    CHECK_DONE(fuge_operator_set_grid(s->op[k], nx, ny, NULL, 0));
    if (k > 0) CHECK_DONE(fuge_operator_set_coarser(s->op[k - 1], s->op[k], NULL, 0));
    nx = (nx + 1) / 2;
    ny = (ny + 1) / 2;
  }
}

/* A round body off the middle, with waves on it: one contact, or many. */
static void make_gap(int nx, int ny, double width, double waves, double *gap) {
  for (int j = 0; j < ny; j++)
    for (int i = 0; i < nx; i++) {
      const double x = width * (i - 0.47 * nx), y = width * (j - 0.53 * (ny - 1));
      gap[i + nx * j] = 0.5 * (x * x + y * y)
                        + waves * (2.0 + cos(0.81 * i + 0.3 * j) + cos(0.37 * j - 1.3 * sin(0.01 * i * i)));
    }
}

static fuge_solver *solver_of(const fuge_operator *op, const double *gap) {
  fuge_solver *solver = NULL;
  CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  return solver;
}

/* The same status, and with the accuracy 0 the same counts and every bit of the forces.  Areas of the library have
 * products in single precision, which a callback has not: their forces are the same to the tolerance, and as residuals
 * are extended to open points there, they need hardly more products. */
static void check_same(int n, double accuracy, fuge_solver *first, fuge_solver *second) {
  double *force = malloc(n * sizeof *force), *expected = malloc(n * sizeof *force), motion[2], expected_motion[2];
  fuge_info info, expected_info;
  char message[FUGE_MESSAGE_LENGTH + 1], expected_message[FUGE_MESSAGE_LENGTH + 1];
  int status = fuge_solve(second);
  CHECK_STATUS(fuge_solve(first), status);
  CHECK_DONE(fuge_get_info(first, &info));
  CHECK_DONE(fuge_get_info(second, &expected_info));
  const int counts = accuracy > 0.0 ? 8 : 0;
  CHECK(expected_info.products - info.products <= counts);
  CHECK(expected_info.preconditionings - info.preconditionings <= counts);
  if (!counts) {
    CHECK(info.products == expected_info.products);
    CHECK(info.preconditionings == expected_info.preconditionings);
  }
  CHECK(abs(info.iterations - expected_info.iterations) <= counts);
  if (status >= 0) {
    CHECK_DONE(fuge_get_motion(first, motion));
    CHECK_DONE(fuge_get_motion(second, expected_motion));
    CHECK_NEAR(motion[0], expected_motion[0], accuracy * fabs(expected_motion[0]));
    CHECK_DONE(fuge_get_force(first, force));
    CHECK_DONE(fuge_get_force(second, expected));
    double largest = 0.0;
    for (int k = 0; k < n; k++) largest = fmax(largest, fabs(expected[k]));
    for (int k = 0; k < n; k++) CHECK(fabs(force[k] - expected[k]) <= accuracy * largest);
  } else {
    CHECK_DONE(fuge_solver_message(first, message, sizeof message));
    CHECK_DONE(fuge_solver_message(second, expected_message, sizeof expected_message));
    CHECK_STRING(message, expected_message);
  }
  free(force);
  free(expected);
}

/* A load; one percent more, from the forces of the first; and the approach of that, from nothing. */
static void compare(surface *s, int n, const double *gap, double load, double accuracy) {
  fuge_solver *first = solver_of(s->op[0], gap), *second = solver_of(s->same[0], gap);
  double approach;
  for (int step = 0; step < 2; step++) {
    CHECK_DONE(fuge_set_load(first, load * (1.0 + 0.01 * step)));
    CHECK_DONE(fuge_set_load(second, load * (1.0 + 0.01 * step)));
    check_same(n, accuracy, first, second);
  }
  CHECK_DONE(fuge_get_motion(second, &approach));
  CHECK_DONE(fuge_reset(first));
  CHECK_DONE(fuge_reset(second));
  CHECK_DONE(fuge_set_approach(first, approach));
  CHECK_DONE(fuge_set_approach(second, approach));
  check_same(n, accuracy, first, second);
  fuge_solver_free(&first);
  fuge_solver_free(&second);
}

/* The loads first, 100 first .. up to last. */
static void compare_loads(surface *s, grid g, double width, double first, double last) {
  const int n = g.nx * rows(g.ny);
  double *gap = malloc(n * sizeof *gap);
  for (int wavy = 0; wavy < 2; wavy++)
    for (double load = first; load < last; load *= 100.0) {
      make_gap(g.nx, rows(g.ny), width, 1e-3 * wavy, gap);
      compare(s, n, gap, load, rows(g.ny) > 1 && g.nx > 1 ? 1e-8 : 0.0);
    }
  free(gap);
}

/* With grids of the caller's own.  Beyond half of a periodic surface in contact displacements are small beside their
 * terms: the caller tells of it by the mean coefficient of a half-plane, or by auxiliary operators. */
static void test_own_grids(grid g) {
  const double width = 2.0 / (g.nx > g.ny ? g.nx : g.ny);
  surface s;
  make_surface(g, width, &s);
  set_own_grids(g, &s);
  compare_loads(&s, g, width, 3e-3, g.ny == 0 ? 1e2 : 1.0);
  for (int k = 0; k < s.levels; k++)
    CHECK_DONE(fuge_operator_set_auxiliary(s.op[k], s.same[k], NULL, 0));
  compare_loads(&s, g, width, 30.0, 1e2);
  free_surface(&s);
}

/* With an auxiliary operator alone, up to complete contact. */
static void test_auxiliary(grid g) {
  const double width = 2.0 / (g.nx > g.ny ? g.nx : g.ny);
  surface s;
  make_surface(g, width, &s);
  CHECK_DONE(fuge_operator_set_auxiliary(s.op[0], s.same[0], NULL, 0));
  compare_loads(&s, g, width, 0.3, 1e2);
  free_surface(&s);
}

/* A translation and a tilt, play between two stops, excluded points; then the derivatives in the load. */
static void compare_general(surface *s, grid g, double width) {
  const int n = g.nx * rows(g.ny);
  const double resultant[2] = {0.1, 0.01}, change[2] = {1.0, 0.0};
  double *gap = malloc(n * sizeof *gap), *upper = malloc(n * sizeof *gap), *modes = malloc(2 * n * sizeof *gap);
  double *slope = malloc(n * sizeof *gap), *expected = malloc(n * sizeof *gap);
  int *excluded = malloc(n * sizeof *excluded);
  make_gap(g.nx, rows(g.ny), width, 1e-3, gap);
  for (int k = 0; k < n; k++) {
    upper[k] = gap[k] + 0.2 + (k % 3 == 0 ? INFINITY : 0.0);
    excluded[k] = k % 11 == 4;
    modes[k] = 1.0;
    modes[n + k] = width * (k % g.nx - 0.47 * g.nx);
  }
  fuge_solver *solver[2] = {solver_of(s->op[0], gap), solver_of(s->same[0], gap)};
  for (int k = 0; k < 2; k++) {
    CHECK_DONE(fuge_set_gap(solver[k], gap, upper));
    CHECK_DONE(fuge_set_excluded(solver[k], excluded));
    CHECK_DONE(fuge_set_modes(solver[k], 2, modes, resultant));
  }
  const double accuracy = rows(g.ny) > 1 && g.nx > 1 ? 1e-8 : 0.0;
  check_same(n, accuracy, solver[0], solver[1]);
  CHECK_DONE(fuge_get_force(solver[0], slope));
  CHECK_DONE(fuge_get_derivatives(solver[0], NULL, change, slope, NULL, NULL));
  CHECK_DONE(fuge_get_derivatives(solver[1], NULL, change, expected, NULL, NULL));
  for (int k = 0; k < n; k++) CHECK(fabs(slope[k] - expected[k]) <= accuracy);
  for (int k = 0; k < 2; k++) fuge_solver_free(&solver[k]);
  free(gap);
  free(upper);
  free(modes);
  free(slope);
  free(expected);
  free(excluded);
}

static void test_general(grid g) {
  const double width = 2.0 / (g.nx > g.ny ? g.nx : g.ny);
  surface s;
  if (g.nx == 1) return;
  make_surface(g, width, &s);
  set_own_grids(g, &s);
  compare_general(&s, g, width);
  CHECK_DONE(fuge_operator_set_auxiliary(s.op[0], s.same[0], NULL, 0));
  compare_general(&s, g, width);
  free_surface(&s);
}

/* A small contact on a grid so large that the built-in operator solves it on a window first. */
static void test_window(void) {
  enum { WIDE = 256, MOST = 6 };
  const grid g = {WIDE, WIDE, FUGE_CENTRE, FUGE_FREE};
  fuge_info info;
  surface s;
  make_surface(g, 1.0 / WIDE, &s);
  CHECK_DONE(fuge_operator_set_auxiliary(s.op[0], s.same[0], NULL, 0));
  double *gap = malloc(WIDE * WIDE * sizeof *gap);
  make_gap(WIDE, WIDE, 1.0 / WIDE, 0.0, gap);
  fuge_solver *first = solver_of(s.op[0], gap), *second = solver_of(s.same[0], gap);
  CHECK_DONE(fuge_set_load(first, 1e-4));
  CHECK_DONE(fuge_set_load(second, 1e-4));
  check_same(WIDE * WIDE, 1e-8, first, second);
  CHECK_DONE(fuge_get_info(first, &info));
  CHECK(info.products <= MOST);
  fuge_solver_free(&first);
  fuge_solver_free(&second);
  free_surface(&s);
  free(gap);
}

/* ---- a body that is not the auxiliary one --------------------------------- */

enum { SIDE = 32, CELLS = SIDE * SIDE };

/* A soft layer of springs, which give way by spring for a force of 1, on the half-space. */
typedef struct layered {
  void *below;
  double spring;
} layered;

static int apply_layered(int n, const double *force, double *displacement, void *user) {
  const layered *body = user;
  const int status = reference_apply(n, force, displacement, body->below);
  for (int k = 0; k < n; k++) displacement[k] += body->spring * force[k];
  return status;
}

static int solve_layered(const fuge_operator *op, const double *gap, double *force) {
  fuge_info info;
  fuge_solver *solver = solver_of(op, gap);
  CHECK_DONE(fuge_set_load(solver, 0.1));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_DONE(fuge_get_info(solver, &info));
  fuge_solver_free(&solver);
  return info.products;
}

/* The forces are those of the body, not of the auxiliary one; and fewer products find them, also where the library
 * makes the coarser grids only. */
static void test_similar_body(void) {
  const double width = 2.0 / SIDE;
  static double gap[CELLS], plain[CELLS], force[CELLS];
  double largest = 0.0;
  layered body = {reference_new(SIDE, SIDE, width, width, FUGE_MEAN, FUGE_FREE), 1.0 / width};
  fuge_operator *op = NULL, *half_space = NULL, *coarse = NULL;
  make_gap(SIDE, SIDE, width, 1e-3, gap);
  CHECK_DONE(fuge_operator_callback(CELLS, apply_layered, &body, &op, NULL, 0));
  const int products = solve_layered(op, gap, plain);
  for (int k = 0; k < CELLS; k++) largest = fmax(largest, plain[k]);

  CHECK_DONE(fuge_operator_halfspace(SIDE / 2, SIDE / 2, 2.0 * width, 2.0 * width, 1.0, FUGE_MEAN, FUGE_FREE, &coarse,
                                     NULL, 0));
  CHECK_DONE(fuge_operator_set_grid(op, SIDE, SIDE, NULL, 0));
  CHECK_DONE(fuge_operator_set_coarser(op, coarse, NULL, 0));
  CHECK(solve_layered(op, gap, force) < products);
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(force[k], plain[k], 1e-7 * largest);

  CHECK_DONE(fuge_operator_halfspace(SIDE, SIDE, width, width, 1.0, FUGE_MEAN, FUGE_FREE, &half_space, NULL, 0));
  CHECK_DONE(fuge_operator_set_auxiliary(op, half_space, NULL, 0));
  CHECK(3 * solve_layered(op, gap, force) < 2 * products);
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(force[k], plain[k], 1e-7 * largest);
  fuge_operator_free(&op);
  fuge_operator_free(&half_space);
  fuge_operator_free(&coarse);
  reference_free(body.below);
}

/* ---- what is refused ------------------------------------------------------ */

static char message[FUGE_MESSAGE_LENGTH + 1];

static int apply_nothing(int n, const double *force, double *displacement, void *user) {
  (void)user;
  for (int k = 0; k < n; k++) displacement[k] = force[k];
  return 0;
}

static fuge_operator *callback(int n) {
  fuge_operator *op = NULL;
  CHECK_DONE(fuge_operator_callback(n, apply_nothing, NULL, &op, NULL, 0));
  return op;
}

static void check_grid(fuge_operator *op, int nx, int ny, int status, const char *part) {
  CHECK_STATUS(fuge_operator_set_grid(op, nx, ny, message, sizeof message), status);
  if (status == FUGE_DONE) CHECK_STRING(message, part);
  else CHECK_CONTAINS(message, part);
}

static void test_grid_refusals(void) {
  fuge_operator *op = callback(12), *dense = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &dense, NULL, 0));
  check_grid(NULL, 3, 4, FUGE_ERR_POINTER, "op is NULL");
  check_grid(dense, 2, 1, FUGE_ERR_UNSUPPORTED, "only an operator of fuge_operator_callback takes a grid");
  check_grid(op, 0, 12, FUGE_ERR_SIZE, "nx = 0");
  check_grid(op, 12, -1, FUGE_ERR_SIZE, "ny = -1");
  check_grid(op, 3, 3, FUGE_ERR_SIZE, "nx = 3 times ny = 3 is not the number of points of op, 12");
  check_grid(op, 5, 2, FUGE_ERR_SIZE, "nx = 5 times ny = 2");
  /* 2^32 + 12 is 12 to an int. */
  check_grid(op, 4, 1073741827, FUGE_ERR_SIZE, "ny = 1073741827");
  check_grid(op, INT_MAX, INT_MAX, FUGE_ERR_SIZE, "nx = 2147483647");
  check_grid(op, 3, 4, FUGE_DONE, "");
  check_grid(op, 12, 1, FUGE_DONE, "");
  fuge_operator_free(&op);
  fuge_operator_free(&dense);
}

static void check_coarser(fuge_operator *op, const fuge_operator *coarse, int status, const char *part) {
  CHECK_STATUS(fuge_operator_set_coarser(op, coarse, message, sizeof message), status);
  if (status == FUGE_DONE) CHECK_STRING(message, part);
  else CHECK_CONTAINS(message, part);
}

static void test_coarser_refusals(void) {
  fuge_operator *op = callback(35), *coarse = callback(12), *one = callback(1), *dense = NULL, *built_in = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &dense, NULL, 0));
  CHECK_DONE(fuge_operator_halfspace(4, 3, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &built_in, NULL, 0));
  check_coarser(op, coarse, FUGE_ERR_CALL_ORDER, "fuge_operator_set_grid");
  check_grid(op, 7, 5, FUGE_DONE, "");
  check_coarser(NULL, coarse, FUGE_ERR_POINTER, "op is NULL");
  check_coarser(op, NULL, FUGE_ERR_POINTER, "coarse is NULL");
  check_coarser(built_in, coarse, FUGE_ERR_UNSUPPORTED, "takes a coarser one");
  check_coarser(op, coarse, FUGE_ERR_SIZE, "the cells of coarse are not known");
  check_coarser(op, dense, FUGE_ERR_SIZE, "the cells of coarse are not known");
  check_coarser(op, op, FUGE_ERR_SIZE, "coarse has 7 x 5 cells: cells twice as wide as the 7 x 5 of op are 4 x 3");
  check_grid(coarse, 3, 4, FUGE_DONE, "");
  check_coarser(op, coarse, FUGE_ERR_SIZE, "coarse has 3 x 4 cells");
  check_grid(one, 1, 1, FUGE_DONE, "");
  check_coarser(one, one, FUGE_ERR_SIZE, "op has one cell");
  check_coarser(op, built_in, FUGE_DONE, "");
  check_grid(coarse, 4, 3, FUGE_DONE, "");
  check_coarser(op, coarse, FUGE_DONE, "");
  fuge_operator_free(&op);
  fuge_operator_free(&coarse);
  fuge_operator_free(&one);
  fuge_operator_free(&dense);
  fuge_operator_free(&built_in);
}

static void check_auxiliary(fuge_operator *op, const fuge_operator *auxiliary, int status, const char *part) {
  CHECK_STATUS(fuge_operator_set_auxiliary(op, auxiliary, message, sizeof message), status);
  if (status == FUGE_DONE) CHECK_STRING(message, part);
  else CHECK_CONTAINS(message, part);
}

static void test_auxiliary_refusals(void) {
  fuge_operator *op = callback(12), *other = callback(12), *area = NULL, *large = NULL, *row = NULL;
  CHECK_DONE(fuge_operator_halfspace(4, 3, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &area, NULL, 0));
  CHECK_DONE(fuge_operator_halfspace(4, 4, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &large, NULL, 0));
  CHECK_DONE(fuge_operator_halfplane(12, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &row, NULL, 0));
  check_auxiliary(NULL, area, FUGE_ERR_POINTER, "op is NULL");
  check_auxiliary(op, NULL, FUGE_ERR_POINTER, "auxiliary is NULL");
  check_auxiliary(area, area, FUGE_ERR_UNSUPPORTED, "takes an auxiliary one");
  check_auxiliary(op, other, FUGE_ERR_UNSUPPORTED, "auxiliary has to be an operator of fuge_operator_halfplane");
  check_auxiliary(op, large, FUGE_ERR_SIZE, "auxiliary has 16 points, op has 12");
  check_grid(op, 3, 4, FUGE_DONE, "");
  check_auxiliary(op, area, FUGE_ERR_SIZE, "auxiliary has 4 x 3 cells, op has 3 x 4");
  check_auxiliary(op, row, FUGE_ERR_SIZE, "auxiliary has 12 x 1 cells");
  check_grid(op, 12, 1, FUGE_DONE, "");
  check_auxiliary(op, row, FUGE_DONE, "");
  /* It tells the cells, until they are set again. */
  check_auxiliary(other, area, FUGE_DONE, "");
  check_auxiliary(other, row, FUGE_ERR_SIZE, "op has 4 x 3");
  check_grid(other, 12, 1, FUGE_DONE, "");
  check_auxiliary(other, row, FUGE_DONE, "");
  fuge_operator_free(&op);
  fuge_operator_free(&other);
  fuge_operator_free(&area);
  fuge_operator_free(&large);
  fuge_operator_free(&row);
}

/* Another grid forgets what belongs to the one before: coarse and auxiliary may be freed. */
static void test_forgotten(void) {
  enum { N = 64 };
  double gap[N], force[N];
  fuge_operator *op = callback(N), *coarse = callback(N / 2), *row = NULL;
  for (int k = 0; k < N; k++) gap[k] = k;
  check_grid(op, N, 1, FUGE_DONE, "");
  check_grid(coarse, N / 2, 1, FUGE_DONE, "");
  check_coarser(op, coarse, FUGE_DONE, "");
  CHECK_DONE(fuge_operator_halfplane(N, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &row, NULL, 0));
  check_auxiliary(op, row, FUGE_DONE, "");
  check_grid(op, 1, N, FUGE_DONE, "");
  fuge_operator_free(&coarse);
  fuge_operator_free(&row);
  fuge_solver *solver = solver_of(op, gap);
  CHECK_DONE(fuge_set_load(solver, 3.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_force(solver, force));
  CHECK_VALUES(force, 1e-9, 2.0, 1.0);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
}

static void check_coefficients(fuge_operator *op, double datum, double mean, int status, const char *part) {
  CHECK_STATUS(fuge_operator_set_coefficients(op, datum, mean, message, sizeof message), status);
  if (status == FUGE_DONE) CHECK_STRING(message, part);
  else CHECK_CONTAINS(message, part);
}

/* A load moves the body by the datum times its sum, and a prescribed approach takes account of it. */
static void test_datum(void) {
  static const double gap[3] = {0.0, 0.0, 0.0};
  double approach, load;
  fuge_operator *op = callback(3), *dense = NULL;
  CHECK_DONE(fuge_operator_dense(2, TABLE1_ALPHA, 2, &dense, NULL, 0));
  check_coefficients(NULL, 1.0, 0.0, FUGE_ERR_POINTER, "op is NULL");
  check_coefficients(dense, 1.0, 0.0, FUGE_ERR_UNSUPPORTED, "takes a datum");
  check_coefficients(op, 5.0, 0.0, FUGE_DONE, "");
  check_coefficients(op, NAN, 1.0, FUGE_ERR_NOT_FINITE, "datum = NaN");
  check_coefficients(op, 1.0, INFINITY, FUGE_ERR_NOT_FINITE, "mean = Inf");
  check_coefficients(op, 1.0, -1e-9, FUGE_ERR_OPTION, "mean = -1");
  fuge_solver *solver = solver_of(op, gap);
  CHECK_DONE(fuge_set_load(solver, 6.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_motion(solver, &approach));
  CHECK_NEAR(approach, 2.0 + 5.0 * 6.0, 1e-13);
  CHECK_DONE(fuge_set_approach(solver, 16.0));
  CHECK_DONE(fuge_solve(solver));
  CHECK_DONE(fuge_get_resultant(solver, &load));
  CHECK_NEAR(load, 3.0, 1e-8);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  fuge_operator_free(&dense);
}

/* ---- the grids that are compared ------------------------------------------ */

/* The free direction of a surface that is periodic in the other one has a power of 2 of cells: the built-in
 * operator displaces nothing at a distance that belongs to its finest grid. */
static const grid GRIDS[] = {
  {1024, 0, FUGE_MEAN, FUGE_FREE}, {1024, 0, FUGE_CENTRE, FUGE_PERIODIC}, {1001, 0, FUGE_CENTRE, FUGE_FREE},
  {999, 0, FUGE_MEAN, FUGE_PERIODIC}, {31, 0, FUGE_MEAN, FUGE_FREE}, {1, 0, FUGE_MEAN, FUGE_FREE},
  {64, 64, FUGE_MEAN, FUGE_FREE}, {64, 64, FUGE_CENTRE, FUGE_PERIODIC}, {61, 47, FUGE_CENTRE, FUGE_FREE},
  {45, 63, FUGE_MEAN, FUGE_PERIODIC}, {33, 64, FUGE_MEAN, FUGE_PERIODIC_X}, {32, 51, FUGE_CENTRE, FUGE_PERIODIC_Y},
  {1, 300, FUGE_MEAN, FUGE_FREE}, {20, 24, FUGE_CENTRE, FUGE_PERIODIC}, {300, 1, FUGE_CENTRE, FUGE_FREE}
};

/* With an argument: small grids only. */
int main(int argc, char **argv) {
  (void)argv;
  for (size_t k = 0; k < sizeof GRIDS / sizeof GRIDS[0]; k++) {
    if (argc > 1 && GRIDS[k].nx * rows(GRIDS[k].ny) > 500) continue;
    test_own_grids(GRIDS[k]);
    test_auxiliary(GRIDS[k]);
    test_general(GRIDS[k]);
  }
  if (argc == 1) test_window();
  test_similar_body();
  test_grid_refusals();
  test_coarser_refusals();
  test_auxiliary_refusals();
  test_forgotten();
  test_datum();
  return check_summary();
}
