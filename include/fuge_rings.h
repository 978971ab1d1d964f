/* fuge - round bodies on rings, the field below.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_RINGS_H
#define FUGE_RINGS_H

#include <stddef.h>
#include "fuge_elastic.h"
#include "fuge_halfspace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- rings ---------------------------------------------------------------
 *
 * Round bodies pressed along their axis need a line of unknowns only: rings about the axis,
 * for the dense engines. */

/* Influence matrix of rings side by side.
 *   radius   in   n + 1, increasing, >= 0; ring k lies between radius[k] and radius[k + 1];
 *                 the first one is a disc if radius[0] = 0; length
 *   e_star   in   as in fuge_halfplane_matrix; force per length^2
 *   element  in   FUGE_MEAN: uniform pressure on a ring, mean displacement of a ring
 *   alpha    out  lda x n, lda >= n; displacement per force
 * The force of a ring is its resultant, so the load is the whole load; gaps are means over the
 * rings, weighted by area.  Displacements vanish far away: the approach is absolute.
 * FUGE_ERR_WIDTH: radii that do not increase, a negative one, a ring thinner than 1e-7 of its
 * radius.  FUGE_ERR_GRID for FUGE_CENTRE, whose matrix would not be symmetric.
 * FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_MODULUS, FUGE_ERR_ELEMENT,
 * FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. */
int fuge_ring_matrix(int n, const double *radius, double e_star, int element, double *alpha,
                     int lda, char *message, size_t len);

/* Displacement of the surface by forces on rings, anywhere.
 *   force         in   n; the resultants; force
 *   place         in   count >= 0 distances from the axis, >= 0; length
 *   displacement  out  count; into the body; length
 * Errors as above; FUGE_ERR_WIDTH also for a negative place. */
int fuge_ring_displacement(int n, const double *radius, const double *force, double e_star,
                           int count, const double *place, double *displacement,
                           char *message, size_t len);

/* ---- fields -------------------------------------------------------------- */

/* Under n rings about one axis, radius (n + 1) as in fuge_ring_matrix, force (n) of uniform
 * pressures.  At an edge of a ring stresses are the means from both sides. */
int fuge_field_rings(int n, const double *radius, const double *force, double young,
                     double poisson, fuge_field **field, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
