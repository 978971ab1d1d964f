/* Section "operators" of fuge.h: callback operators of cells of a grid need the products of the built-in operators,
 * whose products they do here by reference_operator.f90. */
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
  s->reference[k] = reference_new(nx, ny, spacing_x, spacing_y, g.element, g.boundary);
  CHECK(s->reference[k] != NULL);
  CHECK_STATUS(fuge_operator_callback(nx * rows(ny), reference_apply, s->reference[k], &s->op[k], NULL, 0), FUGE_DONE);
  CHECK_STATUS(fuge_operator_set_datum(s->op[k], reference_datum(s->reference[k]), NULL, 0), FUGE_DONE);
  if (ny == 0)
    CHECK_STATUS(fuge_operator_halfplane(nx, spacing_x, 1.0, g.element, g.boundary, &s->same[k], NULL, 0), FUGE_DONE);
  else
    CHECK_STATUS(fuge_operator_halfspace(nx, ny, spacing_x, spacing_y, 1.0, g.element, g.boundary, &s->same[k], NULL,
                                         0), FUGE_DONE);
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
    CHECK_STATUS(fuge_operator_set_preconditioner(s->op[k], reference_precondition, NULL, 0), FUGE_DONE);
    CHECK_STATUS(fuge_operator_set_grid(s->op[k], nx, ny, NULL, 0), FUGE_DONE);
    if (k > 0) CHECK_STATUS(fuge_operator_set_coarser(s->op[k - 1], s->op[k], NULL, 0), FUGE_DONE);
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
  CHECK_STATUS(fuge_solver_new(op, NULL, &solver, NULL, 0), FUGE_DONE);
  CHECK_STATUS(fuge_set_gap(solver, gap, NULL), FUGE_DONE);
  return solver;
}

/* The same status, the same counts, and every bit of the forces. */
static void check_same(int n, fuge_solver *first, fuge_solver *second) {
  double *force = malloc(n * sizeof *force), *expected = malloc(n * sizeof *force), approach, expected_approach;
  fuge_info info, expected_info;
  char message[FUGE_MESSAGE_LENGTH + 1], expected_message[FUGE_MESSAGE_LENGTH + 1];
  int status = fuge_solve(second);
  CHECK_STATUS(fuge_solve(first), status);
  CHECK_STATUS(fuge_get_info(first, &info), FUGE_DONE);
  CHECK_STATUS(fuge_get_info(second, &expected_info), FUGE_DONE);
  CHECK_INT(info.products, expected_info.products);
  CHECK_INT(info.preconditionings, expected_info.preconditionings);
  CHECK_INT(info.iterations, expected_info.iterations);
  if (status >= 0) {
    CHECK_STATUS(fuge_get_motion(first, &approach), FUGE_DONE);
    CHECK_STATUS(fuge_get_motion(second, &expected_approach), FUGE_DONE);
    CHECK_NEAR(approach, expected_approach, 0.0);
    CHECK_STATUS(fuge_get_force(first, force), FUGE_DONE);
    CHECK_STATUS(fuge_get_force(second, expected), FUGE_DONE);
    CHECK(memcmp(force, expected, n * sizeof *force) == 0);
  } else {
    CHECK_STATUS(fuge_solver_message(first, message, sizeof message), FUGE_DONE);
    CHECK_STATUS(fuge_solver_message(second, expected_message, sizeof expected_message), FUGE_DONE);
    CHECK_STRING(message, expected_message);
  }
  free(force);
  free(expected);
}

/* A load; one percent more, from the forces of the first; and the approach of that, from nothing. */
static void compare(surface *s, int n, const double *gap, double load) {
  fuge_solver *first = solver_of(s->op[0], gap), *second = solver_of(s->same[0], gap);
  double approach;
  for (int step = 0; step < 2; step++) {
    CHECK_STATUS(fuge_set_load(first, load * (1.0 + 0.01 * step)), FUGE_DONE);
    CHECK_STATUS(fuge_set_load(second, load * (1.0 + 0.01 * step)), FUGE_DONE);
    check_same(n, first, second);
  }
  CHECK_STATUS(fuge_get_motion(second, &approach), FUGE_DONE);
  CHECK_STATUS(fuge_reset(first), FUGE_DONE);
  CHECK_STATUS(fuge_reset(second), FUGE_DONE);
  CHECK_STATUS(fuge_set_approach(first, approach), FUGE_DONE);
  CHECK_STATUS(fuge_set_approach(second, approach), FUGE_DONE);
  check_same(n, first, second);
  fuge_solver_free(&first);
  fuge_solver_free(&second);
}

static void compare_loads(surface *s, grid g, double width, double last) {
  const int n = g.nx * rows(g.ny);
  double *gap = malloc(n * sizeof *gap);
  for (int wavy = 0; wavy < 2; wavy++)
    for (double load = 3e-3; load < last; load *= 10.0) {
      make_gap(g.nx, rows(g.ny), width, 1e-3 * wavy, gap);
      compare(s, n, gap, load);
    }
  free(gap);
}

/* With grids of the caller's own: the same up to half a surface in contact.  Beyond, the library knows of periodic
 * surfaces that their displacements are small beside their terms; the caller says it by an auxiliary operator. */
static void test_own_grids(grid g) {
  const double width = 2.0 / (g.nx > g.ny ? g.nx : g.ny);
  surface s;
  make_surface(g, width, &s);
  set_own_grids(g, &s);
  compare_loads(&s, g, width, 1.0);
  for (int k = 0; k < s.levels; k++)
    CHECK_STATUS(fuge_operator_set_auxiliary(s.op[k], s.same[k], NULL, 0), FUGE_DONE);
  compare_loads(&s, g, width, 1e4);
  free_surface(&s);
}

/* With an auxiliary operator alone, up to complete contact. */
static void test_auxiliary(grid g) {
  const double width = 2.0 / (g.nx > g.ny ? g.nx : g.ny);
  surface s;
  make_surface(g, width, &s);
  CHECK_STATUS(fuge_operator_set_auxiliary(s.op[0], s.same[0], NULL, 0), FUGE_DONE);
  compare_loads(&s, g, width, 1e4);
  free_surface(&s);
}

/* The free direction of a surface that is periodic in the other one has a power of 2 of cells: the built-in
 * operator displaces nothing at a distance that belongs to its finest grid. */
static const grid GRIDS[] = {
  {1024, 0, FUGE_MEAN, FUGE_FREE}, {1024, 0, FUGE_CENTRE, FUGE_PERIODIC}, {1001, 0, FUGE_CENTRE, FUGE_FREE},
  {999, 0, FUGE_MEAN, FUGE_PERIODIC}, {31, 0, FUGE_MEAN, FUGE_FREE}, {1, 0, FUGE_MEAN, FUGE_FREE},
  {64, 64, FUGE_MEAN, FUGE_FREE}, {64, 64, FUGE_CENTRE, FUGE_PERIODIC}, {61, 47, FUGE_CENTRE, FUGE_FREE},
  {45, 63, FUGE_MEAN, FUGE_PERIODIC}, {33, 64, FUGE_MEAN, FUGE_PERIODIC_X}, {32, 51, FUGE_CENTRE, FUGE_PERIODIC_Y},
  {1, 300, FUGE_MEAN, FUGE_FREE}, {300, 1, FUGE_CENTRE, FUGE_FREE}
};

int main(void) {
  for (size_t k = 0; k < sizeof GRIDS / sizeof GRIDS[0]; k++) {
    printf("%d\n", (int)k);
    test_own_grids(GRIDS[k]);
    printf("aux\n");
    test_auxiliary(GRIDS[k]);
  }
  return check_summary();
}
