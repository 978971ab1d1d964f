/* fuge - rectangles on a half-space, the field below.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_HALFSPACE_H
#define FUGE_HALFSPACE_H

#include <stddef.h>
#include "fuge_elastic.h"
#include "fuge_halfplane.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- half-space --------------------------------------------------------- */

/* Influence matrix of rectangles on an elastic half-space.
 *   x, y              in   n; centres of the rectangles; length
 *   width_x, width_y  in   n; widths along x and along y; length
 *   e_star            in   as in fuge_halfplane_matrix; force per length^2
 *   element           in   FUGE_CENTRE or FUGE_MEAN: uniform pressure f/(width_x width_y),
 *                          displacement at the centre, or mean over the rectangle
 *   symmetric_x       in   1: the model is symmetric about x = 0, and only its rectangles with
 *                          x >= 0 are passed; 0: all of them are
 *   symmetric_y       in   the same about y = 0
 *   alpha             out  lda x n, lda >= n; displacement per force
 * In a symmetric model a force is the sum over a rectangle and its mirror images, the load is
 * the whole load.  A rectangle on the axis has its centre there: it is its own image.
 * Displacements vanish far away, so the approach is absolute.  Relative error of a
 * coefficient: at most 4e-16, for the numbers given; where the rectangles are cells of one
 * grid, up to rounding of x and y, for that grid.  FUGE_CENTRE needs equal rectangles
 * (FUGE_ERR_GRID otherwise).  FUGE_ERR_WIDTH: a width <= 0, rectangles that overlap by more
 * than a millionth of a width, two widths with a ratio of more than 1e5.  FUGE_ERR_SIZE,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OVERFLOW,
 * FUGE_ERR_MEMORY. */
int fuge_halfspace_matrix(int n, const double *x, const double *y, const double *width_x,
                          const double *width_y, double e_star, int element, int symmetric_x,
                          int symmetric_y, double *alpha, int lda, char *message, size_t len);

enum {                          /* boundary, beside FUGE_FREE and FUGE_PERIODIC */
  FUGE_PERIODIC_X = 2,          /* the cells repeat along x; beyond them along y is free surface */
  FUGE_PERIODIC_Y = 3           /* the cells repeat along y; beyond them along x is free surface */
};

/* An elastic half-space of nx x ny equal rectangles side by side, by FFT: products in
 * O(n log n) operations, O(n) memory, n = nx ny.  Point i + nx*j is the cell in column i,
 * along x, and row j, from 0.
 *   nx, ny                in   >= 1, any numbers; nx*ny <= INT_MAX
 *   spacing_x, spacing_y  in   widths of a cell along x and y; length
 *   e_star                in   as in fuge_halfplane_matrix; force per length^2
 *   element               in   FUGE_CENTRE or FUGE_MEAN
 *   boundary              in   FUGE_FREE: the matrix of fuge_halfspace_matrix;
 *                              FUGE_PERIODIC: the periods are nx*spacing_x and ny*spacing_y,
 *                              displacements count from the mean of the surface;
 *                              FUGE_PERIODIC_X, FUGE_PERIODIC_Y: displacements are those of
 *                              the rows of images but for a constant.  Equal forces along
 *                              the period displace a half-plane, with the datum at the
 *                              distance of twice the length of the grid across the period
 * *op is set on success only.  It takes 10 n bytes for FUGE_FREE, 18 n while it is made, and
 * 4 n for FUGE_PERIODIC; its products 16 n and 8 n, which it keeps; and a third more with the
 * coarser grids of its solves.  In a free direction that is no power of 2 up to a quarter
 * more.  FUGE_ERR_SIZE also if nx*ny is too large, FUGE_ERR_MEMORY, before anything is
 * allocated, if the machine has too little; FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH (also for two
 * spacings with a ratio of more than 1e5), FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT,
 * FUGE_ERR_OPTION (boundary), FUGE_ERR_OVERFLOW; FUGE_ERR_UNSUPPORTED from a library without
 * FFTW. */
int fuge_operator_halfspace(int nx, int ny, double spacing_x, double spacing_y, double e_star,
                            int element, int boundary, fuge_operator **op, char *message,
                            size_t len);

/* ---- fields -------------------------------------------------------------- */

/* Under rectangles on a half-space, each a uniform pressure.
 *   n .. width_y, symmetric_x, symmetric_y  as in fuge_halfspace_matrix
 *   force                                   n; those of 0 cost nothing
 *   young, poisson                          of the body, not of the pair
 * Displacements vanish far away.  At z = 0 stresses are limits from inside, on an edge between
 * different pressures the means of both sides, at a corner those around it; at a corner xy is
 * infinite if poisson < 0.5 and the pressures around it do not balance: its logarithm is left out.
 * Rectangles may overlap: their pressures add up. */
int fuge_field_halfspace(int n, const double *x, const double *y, const double *width_x,
                         const double *width_y, const double *force, int symmetric_x,
                         int symmetric_y, double young, double poisson, fuge_field **field,
                         char *message, size_t len);

/* Under nx x ny equal cells side by side: cell i + nx*j has its centre at (spacing_x*i,
 * spacing_y*j).  boundary as in fuge_operator_halfspace; of periodic ones all holds that is said
 * above. */
int fuge_field_halfspace_grid(int nx, int ny, double spacing_x, double spacing_y,
                              const double *force, int boundary, double young, double poisson,
                              fuge_field **field, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
