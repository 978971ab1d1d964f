/* From finite elements to contact: the paper's punch y = 0.05 x^4 (mm) on an elastic block.
 *
 *     c_fe_block [elements]
 *
 * The paper took alpha from a finite element program (Bild 7, the hatched region).  Here
 * fe_mesh.c is such a program, for one half of a symmetric block held at the bottom.  fuge
 * condenses its band matrix to the nodes beneath the punch, solves the contact, and gives the
 * displacements of all nodes back.  doc/tutorial_fe.md goes through it step by step.
 *
 * The half-plane is known exactly, but a block is no half-plane.  Two errors of the half-width a of
 * the contact are told apart:
 *   - by the block: the same elements beneath the punch, a block W wide and deep.  It falls
 *     like (a/W)^2.  The approach has no limit: a line load moves the surface of a half-plane
 *     by the logarithm of the distance, so each doubling adds 2 F ln 2/(pi E*);
 *   - by the elements, on one block.  It falls like their width squared, as that of the
 *     half-plane with FUGE_HAT on the same points does: pressures linear between the nodes,
 *     displacements of the nodes.
 * elements: between the axis and 4 a/3, where nodes may touch; 8, 16, 32 (default) or so.
 * Writes fe_block_*.dat and .csv for the picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "fe_mesh.h"
#include "fuge.h"

static const double YOUNG = 1.0e6, POISSON = 0.25;           /* N/mm^2 */
static const double PROFILE = 0.05, LOAD = 30.0e3;           /* 1/mm^3; N per mm of depth */
static const double PI = 3.14159265358979323846;
enum { DOUBLINGS = 6, COARSEST = 8, POSITIONS = 24 };

/* ---- the punch on a half-plane ------------------------------------------- */

static double e_star(void) { return YOUNG / (1.0 - POISSON * POISSON); }

/* F = (3 pi/4) E* A a^4. */
static double load_of(double half_width) { return 0.75 * PI * e_star() * PROFILE * pow(half_width, 4); }

static double exact_half_width(void) { return pow(LOAD / load_of(1.0), 0.25); }

/* Rate of the approach over ln W: 2 F/(pi E*). */
static double growth(void) { return 2.0 * LOAD / (PI * e_star()); }

/* The half-width, finer than the nodes, from the mean square s of x under the forces.  Far
 * boundaries bend the surface beneath the punch by some c x^2; then the pressure is
 * sqrt(a^2 - x^2) (q + 2 E* A x^2), so that F s = F a^2/4 + pi E* A a^6/16 for any c.
 * (fuge_contact_edges is not for this: next to the edge, nodal forces are unlike those of
 * the half-plane's elements.) */
static double half_width(int n, const double *x, const double *force, double load) {
  double sum = 0.0, moment = 0.0;
  for (int k = 0; k < n; k++) {
    sum += force[k];
    moment += force[k] * x[k] * x[k];
  }
  double s = moment / sum, cubic = PI * e_star() * PROFILE / (16.0 * load), square = 3.0 * s;
  for (int step = 0; step < 20; step++)
    square -= (0.25 * square + cubic * pow(square, 3) - s) / (0.25 + 3.0 * cubic * square * square);
  return sqrt(square);
}

/* ---- from the block to alpha --------------------------------------------- */

typedef struct block {
  fe_mesh mesh;
  double *stiffness;
  fuge_body *body;
  double *alpha, *displacement; /* of the candidates: per contact force, and without any */
} block;

static void free_block(block *b) {
  fuge_body_free(&b->body);
  fe_free_mesh(&b->mesh);
  free(b->stiffness);
  free(b->alpha);
  free(b->displacement);
}

/* Prints what went wrong, if anything did. */
static int explain(int status, const char *message) {
  if (status != FUGE_DONE) fprintf(stderr, "%s: %s\n", fuge_status_text(status), message);
  return status;
}

static int hold(block *b) {
  int *dof = fe_reserve(5 * (size_t)b->mesh.lines, sizeof *dof), count = fe_supports(&b->mesh, dof);
  int status = fuge_body_fix(b->body, count, dof, NULL);
  free(dof);
  return status;
}

/* The punch presses down, along -y: that is the normal. */
static int let_touch(block *b) {
  int n = b->mesh.candidates, *dof = fe_reserve((size_t)n, sizeof *dof);
  double *normal = fe_reserve((size_t)n, sizeof *normal);
  for (int k = 0; k < n; k++) {
    dof[k] = fe_degree(&b->mesh, k, 0, 1);
    normal[k] = -1.0;
  }
  int status = fuge_body_set_contact(b->body, n, 1, dof, normal);
  free(normal);
  free(dof);
  return status;
}

static int condense(block *b) {
  const fe_mesh *m = &b->mesh;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  int status = fuge_body_band(fe_degrees(m), fe_band(m), b->stiffness, fe_band(m) + 1, 0, &b->body,
                              message, sizeof message);
  if (status == FUGE_DONE) status = hold(b);
  if (status == FUGE_DONE) status = let_touch(b);
  if (status == FUGE_DONE) status = fuge_body_condense(b->body);
  if (status == FUGE_DONE) status = fuge_body_get_influence(b->body, b->alpha, m->candidates);
  if (status == FUGE_DONE) status = fuge_body_get_displacement(b->body, b->displacement);
  if (status != FUGE_DONE && b->body) fuge_body_message(b->body, message, sizeof message);
  return explain(status, message);
}

static int make_block(int elements, int doublings, int sides_held, block *b) {
  b->mesh.young = YOUNG;
  b->mesh.poisson = POISSON;
  b->mesh.sides_held = sides_held;
  fe_make_mesh(4.0 / 3.0 * exact_half_width(), elements, doublings, &b->mesh);
  size_t n = (size_t)b->mesh.candidates;
  b->stiffness = fe_assemble(&b->mesh);
  b->body = NULL;
  b->alpha = fe_reserve(n * n, sizeof *b->alpha);
  b->displacement = fe_reserve(n, sizeof *b->displacement);
  return condense(b);
}

/* ---- contact, and back to the block -------------------------------------- */

/* displacement: of the points without contact forces; NULL: none.  gap: the gaps that are left. */
static int press(int n, const double *x, const double *alpha, const double *displacement, double load,
                 double *force, double *gap, double *approach) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  for (int k = 0; k < n; k++) gap[k] = PROFILE * pow(x[k], 4) + (displacement ? displacement[k] : 0.0);
  int status = fuge_solve_dense(n, alpha, n, gap, load, force, gap, approach, message, sizeof message);
  return explain(status, message);
}

/* Half a block carries half of the load. */
static int press_block(const block *b, double load, double *force, double *gap, double *approach) {
  return press(b->mesh.candidates, b->mesh.line, b->alpha, b->displacement, 0.5 * load, force, gap, approach);
}

/* Displacements u of all nodes.  They have to give the gaps that the contact has, and
 * supports that carry the load. */
static int recover(const block *b, const double *force, const double *gap, double approach, double *u) {
  const fe_mesh *m = &b->mesh;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  int status = fuge_body_recover(b->body, force, NULL, u);
  if (status != FUGE_DONE) fuge_body_message(b->body, message, sizeof message);
  if (explain(status, message) != FUGE_DONE) return status;
  double apart = 0.0, unbalanced = fe_reaction(m, u) - 0.5 * LOAD;
  for (int k = 0; k < m->candidates; k++) {
    double sunk = -u[fe_degree(m, k, 0, 1)];
    apart = fmax(apart, fabs(PROFILE * pow(m->line[k], 4) + sunk - approach - gap[k]));
  }
  if (apart <= 1e-9 * approach && fabs(unbalanced) <= 1e-9 * LOAD) return FUGE_DONE;
  fprintf(stderr, "the displacements do not fit: gaps by %.1e mm, supports by %.1e N/mm\n", apart, unbalanced);
  return 1;
}

/* ---- the picture --------------------------------------------------------- */

static FILE *create(const char *path) {
  FILE *file = fopen(path, "w");
  if (!file) perror(path);
  return file;
}

static void write_node(FILE *file, const fe_mesh *m, int column, int row, const double *u) {
  fprintf(file, "%.6f %.6f %.6e %.6e\n", m->line[column], -m->line[row], u[fe_degree(m, column, row, 0)],
          u[fe_degree(m, column, row, 1)]);
}

/* x, y and their displacements along the columns, then along the rows. */
static int write_mesh(const fe_mesh *m, const double *u) {
  FILE *file = create("fe_block_mesh.dat");
  if (!file) return 1;
  for (int column = 0; column < m->lines; column++) {
    for (int row = 0; row < m->lines; row++) write_node(file, m, column, row, u);
    fputs("\n", file);
  }
  fputs("\n", file);
  for (int row = 0; row < m->lines; row++) {
    for (int column = 0; column < m->lines; column++) write_node(file, m, column, row, u);
    fputs("\n", file);
  }
  return fclose(file);
}

/* Of the candidates: x, displacement along y, force; approach. */
static int write_contact(const fe_mesh *m, const double *u, const double *force, double approach) {
  FILE *file = create("fe_block_contact.dat");
  if (!file) return 1;
  for (int k = 0; k < m->candidates; k++)
    fprintf(file, "%.6f %.6e %.6e %.6e\n", m->line[k], u[fe_degree(m, k, 0, 1)], force[k], approach);
  return fclose(file);
}

/* ---- error by the block -------------------------------------------------- */

typedef struct block_result {
  int degrees;
  double width, half_width, approach;
} block_result;

static int solve_block(int elements, int doublings, int sides_held, int draw, block_result *r) {
  block b;
  int status = make_block(elements, doublings, sides_held, &b), n = b.mesh.candidates;
  double *force = fe_reserve((size_t)n, sizeof *force), *gap = fe_reserve((size_t)n, sizeof *gap);
  double *u = fe_reserve((size_t)fe_degrees(&b.mesh), sizeof *u);
  if (status == FUGE_DONE) status = press_block(&b, LOAD, force, gap, &r->approach);
  if (status == FUGE_DONE) status = recover(&b, force, gap, r->approach, u);
  if (status == FUGE_DONE && draw) status = write_mesh(&b.mesh, u) || write_contact(&b.mesh, u, force, r->approach);
  if (status == FUGE_DONE) r->half_width = half_width(n, b.mesh.line, force, LOAD);
  r->degrees = fe_degrees(&b.mesh);
  r->width = fe_width(&b.mesh);
  free(u);
  free(gap);
  free(force);
  free_block(&b);
  return status;
}

/* More than the relative error that this many elements make. */
static double element_error(int elements) { return 0.5 * pow(4.0 / (3.0 * elements), 2); }

/* Where these elements lead on an endless block, from the last two. */
static double endless(const block_result r[DOUBLINGS]) {
  return r[DOUBLINGS - 1].half_width + (r[DOUBLINGS - 1].half_width - r[DOUBLINGS - 2].half_width) / 3.0;
}

static int check_blocks(const block_result r[DOUBLINGS], int elements) {
  double last = r[DOUBLINGS - 1].approach - r[DOUBLINGS - 2].approach;
  if (fabs(endless(r) / exact_half_width() - 1.0) > element_error(elements)) {
    fprintf(stderr, "an endless block is no half-plane\n");
    return 1;
  }
  for (int k = 1; k < DOUBLINGS; k++)
    if (fabs(r[k].half_width - endless(r)) > 0.35 * fabs(r[k - 1].half_width - endless(r))) {
      fprintf(stderr, "the half-width does not go to that of an endless block\n");
      return 1;
    }
  if (fabs(last - growth() * log(2.0)) <= 0.02 * last) return 0;
  fprintf(stderr, "the approach does not grow like a logarithm\n");
  return 1;
}

/* Bottom held in r[0], sides too in r[1]. */
static int print_blocks(block_result r[2][DOUBLINGS]) {
  double a = exact_half_width();
  FILE *file = create("fe_block_size.csv");
  if (!file) return 1;
  puts("                             bottom held                              sides held too");
  puts("  W/a  degrees   a [mm]   by the block  approach    growth      a [mm]   by the block  approach");
  for (int k = 0; k < DOUBLINGS; k++) {
    double part[2];
    for (int held = 0; held < 2; held++) part[held] = (r[held][k].half_width - endless(r[held])) / a;
    printf("%5.1f %8d", r[0][k].width / a, r[0][k].degrees);
    printf(" %10.6f %10.4f %% %10.6f", r[0][k].half_width, 100.0 * part[0], r[0][k].approach);
    if (k > 0) printf("%10.6f", r[0][k].approach - r[0][k - 1].approach);
    printf("%*.6f %10.4f %% %10.6f\n", k > 0 ? 12 : 22, r[1][k].half_width, 100.0 * part[1], r[1][k].approach);
    fprintf(file, "%.6e, %.6e, %.6e\n", r[0][k].width / a, fabs(part[0]), fabs(part[1]));
  }
  printf("endless %17.6f %33.6f %11.6f\n", endless(r[0]), growth() * log(2.0), endless(r[1]));
  return fclose(file);
}

/* factor: error = factor (a/W)^2, relative. */
static int grow_block(int elements, double *factor) {
  block_result r[2][DOUBLINGS];
  printf("The block grows: 2 W wide, W deep; %d elements in the half-width a\n", 3 * elements / 4);
  for (int held = 0; held < 2; held++)
    for (int k = 0; k < DOUBLINGS; k++)
      if (solve_block(elements, k + 1, held, held == 0 && k == 0, &r[held][k]) != FUGE_DONE) return 1;
  double a = exact_half_width();
  *factor = (r[0][3].half_width - endless(r[0])) / a * pow(r[0][3].width / a, 2);
  return print_blocks(r) || check_blocks(r[0], elements) || check_blocks(r[1], elements);
}

/* ---- error by the elements ----------------------------------------------- */

static int halfplane_alpha(int n, const double *x, double *alpha) {
  double *width = fe_reserve((size_t)n, sizeof *width);
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  for (int k = 0; k < n; k++) width[k] = x[1];
  int status = fuge_halfplane_matrix(n, x, width, e_star(), FUGE_HAT, 1, alpha, n, message, sizeof message);
  free(width);
  return explain(status, message);
}

typedef struct element_errors {
  double block, halfplane, apart;   /* of the half-width, relative to it */
} element_errors;

/* The largest over loads that put the edge anywhere in an element.  factor (a/W)^2 is not
 * counted, it is the error by the block. */
static int largest_errors(const block *b, const double *alpha, double factor, element_errors *e) {
  int n = b->mesh.candidates, status = FUGE_DONE;
  const double *x = b->mesh.line;
  double *force = fe_reserve((size_t)n, sizeof *force), *gap = fe_reserve((size_t)n, sizeof *gap), approach;
  e->block = e->halfplane = e->apart = 0.0;
  for (int k = 0; k < POSITIONS && status == FUGE_DONE; k++) {
    double a = exact_half_width() - x[1] * k / POSITIONS, load = load_of(a), block = 0.0, halfplane = 0.0;
    status = press_block(b, load, force, gap, &approach);
    if (status == FUGE_DONE) block = half_width(n, x, force, load) / a - 1.0 - factor * pow(a / fe_width(&b->mesh), 2);
    if (status == FUGE_DONE) status = press(n, x, alpha, NULL, load, force, gap, &approach);
    if (status == FUGE_DONE) halfplane = half_width(n, x, force, load) / a - 1.0;
    e->block = fmax(e->block, fabs(block));
    e->halfplane = fmax(e->halfplane, fabs(halfplane));
    e->apart = fmax(e->apart, fabs(block - halfplane));
  }
  free(gap);
  free(force);
  return status;
}

static int find_errors(int elements, double factor, element_errors *e) {
  block b;
  int status = make_block(elements, DOUBLINGS - 1, 0, &b), n = b.mesh.candidates;
  double *alpha = fe_reserve((size_t)n * (size_t)n, sizeof *alpha);
  if (status == FUGE_DONE) status = halfplane_alpha(n, b.mesh.line, alpha);
  if (status == FUGE_DONE) status = largest_errors(&b, alpha, factor, e);
  free(alpha);
  free_block(&b);
  return status;
}

/* Half-widths compared with the exact one, those that are as good as their elements can make them, and the error of
 * the finest elements. */
static int compared = 0, right = 0;
static double finest_error = 0.0;

static void check_errors(int elements, const element_errors *e) {
  compared++;
  if (fmax(e->block, fmax(e->halfplane, e->apart)) <= element_error(elements)) right++;
  finest_error = e->block;
}

/* coarser: NULL at first. */
static void print_errors(int elements, const element_errors *e, const element_errors *coarser, FILE *file) {
  printf("%5d %16.4f %%", 3 * elements / 4, 100.0 * e->block);
  if (coarser) printf("%7.1f", log(coarser->block / e->block) / log(2.0));
  printf("%*.4f %%%14.4f %%\n", coarser ? 20 : 27, 100.0 * e->halfplane, 100.0 * e->apart);
  fprintf(file, "%d, %.6e, %.6e, %.6e\n", 3 * elements / 4, e->block, e->halfplane, e->apart);
}

static int refine(int finest, double factor) {
  element_errors now, before;
  int failed = 0;
  FILE *file = create("fe_block_elements.csv");
  if (!file) return 1;
  printf("\nThe elements shrink, the block has W/a = %.1f: largest error of a, wherever in an element\n",
         4.0 / 3.0 * pow(2.0, DOUBLINGS - 1));
  puts("the contact ends (the block's part taken off)");
  puts("  a/h   finite elements   order   half-plane, FUGE_HAT       apart");
  for (int elements = COARSEST; elements <= finest && !failed; elements *= 2) {
    failed = find_errors(elements, factor, &now) != FUGE_DONE;
    if (!failed) print_errors(elements, &now, elements > COARSEST ? &before : NULL, file);
    if (!failed) check_errors(elements, &now);
    before = now;
  }
  return fclose(file) || failed;
}

int main(int argc, char **argv) {
  int elements = argc > 1 ? atoi(argv[1]) : 32;
  double factor = 0.0;
  if (elements < COARSEST || elements % 4 != 0) {
    fprintf(stderr, "usage: c_fe_block [elements, a multiple of 4 from %d on]\n", COARSEST);
    return EXIT_FAILURE;
  }
  printf("Punch y = 0.05 x^4 mm, F = 30 kN/mm: exact half-width on a half-plane %.6f mm\n\n", exact_half_width());
  if (grow_block(elements, &factor) || refine(2 * elements, factor)) return EXIT_FAILURE;
  printf("\nverdict: %d of %d against the exact half-width, finest mesh %.1E\n", right, compared, finest_error);
  return right == compared ? EXIT_SUCCESS : EXIT_FAILURE;
}
