/* fuge - cells on a half-plane, edges of contact, the field below.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_HALFPLANE_H
#define FUGE_HALFPLANE_H

#include <stddef.h>
#include "fuge_elastic.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- half-plane --------------------------------------------------------- */

/* Influence matrix of cells on an elastic half-plane.
 *   x, width   in   n; centres and widths of the cells, in any order; length
 *   e_star     in   E/(1-nu^2) in plane strain, E in plane stress; force per length^2
 *   symmetric  in   1: the model is symmetric about x = 0, and only its cells with x >= 0 are
 *                   passed: a force is the sum over a cell and its mirror image, the load is
 *                   the whole load.  The first cell lies at x = 0, its own image, or ends
 *                   there.  0: all cells are passed
 *   alpha      out  lda x n, lda >= n; displacement per force per unit depth
 * The displacement by a line load is zero at the distance D, twice the length that the
 * cells cover, so all coefficients are positive.  Cells that overlap by more than 1e-4 of the
 * narrower one are refused, FUGE_ERR_WIDTH: they would press on one place twice.
 * FUGE_CENTRE and FUGE_HAT need equal widths (FUGE_ERR_GRID otherwise).  FUGE_ERR_SIZE,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT, FUGE_ERR_OVERFLOW,
 * FUGE_ERR_MEMORY. */
int fuge_halfplane_matrix(int n, const double *x, const double *width, double e_star,
                          int element, int symmetric, double *alpha, int lda,
                          char *message, size_t len);

enum {                          /* kind of an end of an interval that graded cells cover */
  FUGE_END_PLAIN = 0,           /* cells do not become narrower, as at an axis of symmetry */
  FUGE_END_EDGE = 1,            /* the pressure falls to zero like a square root: distances from
                                   the end grow quadratically */
  FUGE_END_CORNER = 2           /* the pressure has no limit: they grow with the fourth power */
};

/* Cells side by side, ascending, narrow at the ends of an interval and wide in its middle, for
 * fuge_halfplane_matrix with FUGE_MEAN and gaps that are means over the cells.
 *   left, right   in   the interval, left < right: an expected contact, from fuge_contact_edges
 *                      on a coarse grid, or the face of a punch; length
 *   left_end, right_end  in  FUGE_END_...
 *   left_beyond, right_beyond  in  cells beyond either end, mirror images of those inside, so
 *                      that the contact may turn out to be wider: 3 for an end from
 *                      fuge_contact_edges, 0 at a corner
 *   n             in   all cells: n - left_beyond - right_beyond >= 1 cover the interval, and no
 *                      more than these may lie beyond an end
 *   x, width      out  n; centres and widths; length
 * Several contacts: one call for each, with its part of the arrays.  FUGE_ERR_SIZE,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for a kind, FUGE_ERR_WIDTH unless left < right or if
 * a cell would be no wider than a thousand roundings of x, FUGE_ERR_OVERFLOW. */
int fuge_graded_cells(double left, double right, int left_end, int right_end, int left_beyond,
                      int right_beyond, int n, double *x, double *width, char *message, size_t len);

/* An elastic half-plane of n equal cells side by side, by FFT: products in O(n log n)
 * operations, O(n) memory.
 *   spacing   in   width of a cell; length
 *   e_star    in   as in fuge_halfplane_matrix
 *   element   in   FUGE_CENTRE, FUGE_MEAN or FUGE_HAT (the last two are the same here)
 *   boundary  in   FUGE_FREE: the matrix of fuge_halfplane_matrix;
 *                  FUGE_PERIODIC: displacements count from the mean of the surface
 * *op is set on success only.  n is limited by memory (32 n to 64 n bytes, as much again for the
 * coarser grids of its solves, which it keeps, and 8 n for a product), and for FUGE_FREE to
 * nearly 2^30.  FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
 * FUGE_ERR_ELEMENT, FUGE_ERR_OPTION (boundary), FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY;
 * FUGE_ERR_UNSUPPORTED from a library without FFTW. */
int fuge_operator_halfplane(int n, double spacing, double e_star, int element, int boundary,
                            fuge_operator **op, char *message, size_t len);

/* ---- edges of contact --------------------------------------------------- */

enum {                          /* kind of an edge; from 1 to 3 it is that of a cell, because */
  FUGE_EDGE_REFINED = 0,        /* extrapolated from the forces, more accurate than the grid */
  FUGE_EDGE_FEW_CELLS = 1,      /* fewer than five cells are in contact */
  FUGE_EDGE_SINGULAR = 2,       /* the pressure does not fall like a square root, as under a
                                   corner */
  FUGE_EDGE_GRID_END = 3,       /* the contact reaches the last cell of the grid */
  FUGE_EDGE_LIMITED = 4         /* the force of one of the first five cells is at its limit: estimated
                                   from the others, to 0.6 cells at worst */
};

/* The intervals of contact on a half-plane and their edges, from the forces.  For a smooth
 * gap the error of an edge is of third order in the width; of second order, with a small
 * factor, if there are other contacts or the far edge is a corner, and on a bed.
 *   x, width    in   n; a uniform grid, ascending, all widths equal; length
 *   force       in   n; in contact where positive
 *   state       in   n; from fuge_get_states: needed where forces have limits.  NULL: no force is
 *                    at its limit
 *   compliance  in   n, length per force, as in fuge_set_compliance: needed where points have one.
 *                    On a bed the pressure falls linearly if the bed is soft, and like a square
 *                    root if it is stiff; the forces decide.  NULL: none
 *   element     in   as for the matrix.  With FUGE_MEAN the gap has to be the mean over
 *                    a cell too; if it is the gap at the centre, use FUGE_HAT, whose
 *                    forces are the same
 *   symmetric   in   1: half of a symmetric model, as for the matrix, with x[0] = 0 or
 *                    width/2 if it starts on the axis.  An interval that touches the axis
 *                    comes out whole, left = -right, any other one at x > 0 only.
 *                    0: all cells are passed
 *   capacity    in   length of the six arrays, each of which may be NULL
 *   left, right out  the edges, from left to right; length
 *   left_error, right_error  out  estimates of their errors, to an order of magnitude; length.
 *                    The width of a cell for an edge that is not refined
 *   left_kind, right_kind  out  FUGE_EDGE_...
 *   count       out  number of intervals, of which the first capacity are written
 * The forces have to be more accurate than others need them: those of a solve to the tolerance
 * t put the edges of a contact of N cells wrong by up to about t sqrt(N)/2 of the half width.
 * Beyond N = 600 that is more than the error of third order, for the default t = 1e-10.  With
 * fuge_options.tolerance = 1e-13 the edges are as exact as the grid allows, and a solve takes
 * up to a sixth longer.  The estimates see both errors, and grow where the gap is not smooth
 * from cell to cell.  FUGE_ERR_GRID if the grid is not uniform, FUGE_ERR_LAW for a negative
 * compliance. */
int fuge_contact_edges(int n, const double *x, const double *width, const double *force,
                       const int *state, const double *compliance, int element, int symmetric,
                       int capacity, double *left, double *right, double *left_error,
                       double *right_error, int *left_kind, int *right_kind, int *count,
                       char *message, size_t len);

/* ---- fields -------------------------------------------------------------- */

/* Under cells on a half-plane.
 *   n, x, width, element, symmetric  as in fuge_halfplane_matrix; FUGE_CENTRE and FUGE_MEAN are
 *                                    strips of pressure force/width, FUGE_HAT hats with the peak
 *                                    force/width
 *   force                            n; per unit depth, compression positive, of any sign: those
 *                                    of fuge_get_force.  Cells without force cost nothing
 *   young, poisson, plane_state      of the body, as in fuge_plane_modulus; a rigid one (young
 *                                    INFINITY) does not move
 * Along z displacements have the datum of fuge_halfplane_matrix; a line load moves points straight
 * below it along z only.  At z = 0 stresses are those of the surface, at an end of a strip their
 * means from both sides, although xz straight below it tends to pressure/pi or, at the right end, to
 * -pressure/pi. */
int fuge_field_halfplane(int n, const double *x, const double *width, const double *force,
                         int element, int symmetric, double young, double poisson,
                         int plane_state, fuge_field **field, char *message, size_t len);

/* Under n equal cells side by side, of which the first one has its centre at x = 0.
 *   spacing            > 0; width of a cell, length
 *   element, boundary  as in fuge_operator_halfplane
 * With FUGE_PERIODIC the field is known below the centres of the cells only.  The mean pressure is
 * then a stress zz = -mean at all depths; what stress it has along the surface depends on how the
 * body is held far away.  Here it is 0: a body that cannot expand has in addition
 * poisson/(1 - poisson) times the mean of zz.  Displacements count, at each depth, from the mean at
 * that depth. */
int fuge_field_halfplane_grid(int n, double spacing, const double *force, int element,
                              int boundary, double young, double poisson, int plane_state,
                              fuge_field **field, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
