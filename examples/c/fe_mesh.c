/* Four-node rectangles with 2 x 2 points of integration: see fe_mesh.h. */
#include "fe_mesh.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void *fe_reserve(size_t count, size_t size) {
  void *memory = calloc(count, size);
  if (!memory) {
    fprintf(stderr, "no memory for %lu numbers\n", (unsigned long)count);
    exit(EXIT_FAILURE);
  }
  return memory;
}

/* ---- mesh ---------------------------------------------------------------- */

void fe_make_mesh(double region, int elements, int doublings, fe_mesh *m) {
  int grown = elements / 4;
  m->candidates = elements + 1;
  m->lines = elements + 1 + grown * doublings;
  m->line = fe_reserve((size_t)m->lines, sizeof *m->line);
  for (int k = 0; k < m->lines; k++)
    m->line[k] = k <= elements ? region * k / elements : region * pow(2.0, (double)(k - elements) / grown);
}

void fe_free_mesh(fe_mesh *m) {
  free(m->line);
  m->line = NULL;
}

double fe_width(const fe_mesh *m) { return m->line[m->lines - 1]; }

int fe_degrees(const fe_mesh *m) { return 2 * m->lines * m->lines; }

/* Nodes count down the columns: the numbers in an element differ by lines + 1 at most. */
int fe_band(const fe_mesh *m) { return 2 * (m->lines + 1) + 1; }

int fe_degree(const fe_mesh *m, int column, int row, int direction) {
  return 2 * (column * m->lines + row) + direction;
}

int fe_supports(const fe_mesh *m, int *dof) {
  int count = 0, last = m->lines - 1;
  for (int row = 0; row < last; row++) dof[count++] = fe_degree(m, 0, row, 0);
  for (int d = 0; d < 2; d++) {
    for (int column = 0; column <= last; column++) dof[count++] = fe_degree(m, column, last, d);
    for (int row = 0; m->sides_held && row < last; row++) dof[count++] = fe_degree(m, last, row, d);
  }
  return count;
}

/* Of an element, nodes counter-clockwise from the lower left. */
static void element_degrees(const fe_mesh *m, int column, int row, int dof[8]) {
  for (int d = 0; d < 2; d++) {
    dof[0 + d] = fe_degree(m, column, row + 1, d);
    dof[2 + d] = fe_degree(m, column + 1, row + 1, d);
    dof[4 + d] = fe_degree(m, column + 1, row, d);
    dof[6 + d] = fe_degree(m, column, row, d);
  }
}

/* ---- stiffness ----------------------------------------------------------- */

/* Strains xx, yy, xy per displacement, at a point -1 <= xi, eta <= 1 of a rectangle. */
static void strain_matrix(double width, double height, double xi, double eta, double b[3][8]) {
  static const int side_x[4] = {-1, 1, 1, -1}, side_y[4] = {-1, -1, 1, 1};
  for (int node = 0; node < 4; node++) {
    double dx = 0.5 * side_x[node] * (1.0 + side_y[node] * eta) / width;
    double dy = 0.5 * side_y[node] * (1.0 + side_x[node] * xi) / height;
    b[0][2 * node] = b[2][2 * node + 1] = dx;
    b[1][2 * node + 1] = b[2][2 * node] = dy;
    b[0][2 * node + 1] = b[1][2 * node] = 0.0;
  }
}

/* k = sum of B^T D B over the points, times their area. */
static void element_stiffness(const fe_mesh *m, int column, int row, double k[8][8]) {
  double width = m->line[column + 1] - m->line[column], height = m->line[row + 1] - m->line[row];
  double shear = 0.5 * m->young / (1.0 + m->poisson), lame = 2.0 * shear * m->poisson / (1.0 - 2.0 * m->poisson);
  double b[3][8], stress[3], at = 1.0 / sqrt(3.0);
  for (int r = 0; r < 8; r++)
    for (int c = 0; c < 8; c++) k[r][c] = 0.0;
  for (int point = 0; point < 4; point++) {
    strain_matrix(width, height, point % 2 ? at : -at, point / 2 ? at : -at, b);
    for (int c = 0; c < 8; c++) {
      stress[0] = (lame + 2.0 * shear) * b[0][c] + lame * b[1][c];
      stress[1] = lame * b[0][c] + (lame + 2.0 * shear) * b[1][c];
      stress[2] = shear * b[2][c];
      for (int r = 0; r < 8; r++)
        k[r][c] += 0.25 * width * height * (b[0][r] * stress[0] + b[1][r] * stress[1] + b[2][r] * stress[2]);
    }
  }
}

double *fe_assemble(const fe_mesh *m) {
  size_t stride = (size_t)fe_band(m) + 1;
  double *stiffness = fe_reserve((size_t)fe_degrees(m) * stride, sizeof *stiffness), k[8][8];
  int dof[8];
  for (int column = 0; column + 1 < m->lines; column++)
    for (int row = 0; row + 1 < m->lines; row++) {
      element_degrees(m, column, row, dof);
      element_stiffness(m, column, row, k);
      for (int r = 0; r < 8; r++)
        for (int c = 0; c < 8; c++)
          if (dof[r] >= dof[c]) stiffness[(size_t)(dof[r] - dof[c]) + (size_t)dof[c] * stride] += k[r][c];
    }
  return stiffness;
}

/* ---- reactions ----------------------------------------------------------- */

/* Forces of all elements on the vertical degrees of freedom that are held; on the others, but
 * those that are loaded, they cancel. */
double fe_reaction(const fe_mesh *m, const double *u) {
  double sum = 0.0, k[8][8];
  int last = m->lines - 1, dof[8];
  for (int column = 0; column < last; column++)
    for (int row = 0; row < last; row++) {
      int low = row + 1 == last, outer = m->sides_held && column + 1 == last;
      if (!low && !outer) continue;
      element_degrees(m, column, row, dof);
      element_stiffness(m, column, row, k);
      for (int node = 0; node < 4; node++) {
        int held = (low && node < 2) || (outer && (node == 1 || node == 2));
        for (int c = 0; held && c < 8; c++) sum += k[2 * node + 1][c] * u[dof[c]];
      }
    }
  return sum;
}
