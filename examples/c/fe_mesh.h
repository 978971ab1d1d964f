/* A small finite element program in plane strain: the part of fe_block.c that knows nothing
 * of fuge.  Your own takes its place.
 *
 * One half of a block that is symmetric about the axis x = 0: four-node rectangles, as many
 * columns as rows, numbered from the axis and from the surface, y = 0 there.  In the region
 * of possible contact they are equal, from there they grow. */
#ifndef FE_MESH_H
#define FE_MESH_H

#include <stddef.h>

typedef struct fe_mesh {
  double young, poisson;        /* force per length^2, none */
  int candidates;               /* nodes that may touch, from the axis outwards */
  int lines;                    /* columns of nodes, and rows */
  int sides_held;               /* besides the bottom */
  double *line;                 /* their distances from the axis and from the surface */
} fe_mesh;

/* elements, a multiple of 4, on the length region; then elements/4 for each doubling. */
void fe_make_mesh(double region, int elements, int doublings, fe_mesh *m);
void fe_free_mesh(fe_mesh *m);

/* Half the width of the block, and its depth. */
double fe_width(const fe_mesh *m);

int fe_degrees(const fe_mesh *m);

/* Largest difference of two degrees of freedom of an element. */
int fe_band(const fe_mesh *m);

/* Degree of freedom, from 0, of the node in a column and row: direction 0 is x, to the right,
 * 1 is y, upwards. */
int fe_degree(const fe_mesh *m, int column, int row, int direction);

/* Degrees of freedom that are held: bottom, axis (along x only), and sides if they are.
 * dof has room for 5 times the lines; the result is their number. */
int fe_supports(const fe_mesh *m, int *dof);

/* Stiffness without supports, in LAPACK's symmetric band storage, lower triangle: entry (r, c)
 * at r - c + c*(band + 1).  To be freed. */
double *fe_assemble(const fe_mesh *m);

/* Sum of the vertical forces of the supports, from the displacements of all nodes. */
double fe_reaction(const fe_mesh *m, const double *u);

/* Zeros; ends the program if there is no memory. */
void *fe_reserve(size_t count, size_t size);

#endif
