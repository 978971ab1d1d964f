/* fuge - stresses and displacements in the bodies.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too.
 *
 * z >= 0 counts from the surface into the body; tension is positive, so that under a pressure p
 * at z = 0 the stress zz is -p.  Displacements are positive along their axes, that along z into
 * the body.  The body is the one below; for the other one turn z round and take its own moduli. */
#ifndef FUGE_STRESS_H
#define FUGE_STRESS_H

#include <stddef.h>
#include "fuge_smooth.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- stresses of a half-plane -------------------------------------------- */

/* ---- stresses of a half-space -------------------------------------------- */

/* Stresses at points of a half-space under the forces of rectangles, each a uniform pressure.
 *   x, y              in   n; centres of the rectangles; length
 *   width_x, width_y  in   n; widths along x and along y; length
 *   force             in   n; of a rectangle, positive where it presses; those of 0 cost nothing
 *   poisson           in   Poisson's ratio, in (-1, 0.5]
 *   points            in   >= 0
 *   px, py, pz        in   points; pz >= 0 is the depth; length
 *   stress            out  6 x points: xx, yy, zz, yz, xz, xy; force per length^2
 * At z = 0 stresses are limits from inside.  They jump at edges between different pressures: on
 * the edge xx, yy and zz are the means of both sides, and at a corner those around it; xz and
 * yz are zero on the surface, and straight below an edge they tend to the difference of the
 * pressures over pi.  At a corner xy is infinite if poisson < 0.5 and the pressures around it do
 * not balance: its logarithm is left out.  Rectangles may overlap: their pressures add up.
 * Many rectangles are taken in clusters.  Errors are a few 1e-14 of the sum of the magnitudes
 * of the terms at most.  FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH (a width <= 0),
 * FUGE_ERR_MODULUS (poisson), FUGE_ERR_GRID (pz < 0), FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. */
int fuge_halfspace_stress(int n, const double *x, const double *y, const double *width_x,
                          const double *width_y, const double *force, double poisson,
                          int points, const double *px, const double *py, const double *pz,
                          double *stress, char *message, size_t len);

/* The same for a symmetric model, of which a half or a quarter is passed; as in
 * fuge_halfspace_symmetric_matrix.  Points may lie on both sides. */
int fuge_halfspace_symmetric_stress(int n, const double *x, const double *y,
                                    const double *width_x, const double *width_y,
                                    const double *force, double poisson, int symmetric_x,
                                    int symmetric_y, int points, const double *px,
                                    const double *py, const double *pz, double *stress,
                                    char *message, size_t len);

/* Displacements at points of a half-space under the forces of rectangles.
 *   young, poisson    in   of the body, not of the pair; force per length^2, and none;
 *                          young may be INFINITY
 *   displacement      out  3 x points: along x, y and z, z into the body; length
 * All else as in fuge_halfspace_stress.  Displacements vanish far away; those along z at the
 * centres of the rectangles are the matrix of fuge_halfspace_matrix (FUGE_CENTRE, e_star =
 * young/(1 - poisson^2)) times the forces. */
int fuge_halfspace_displacement(int n, const double *x, const double *y, const double *width_x,
                                const double *width_y, const double *force, double young,
                                double poisson, int points, const double *px, const double *py,
                                const double *pz, double *displacement, char *message,
                                size_t len);

/* The same for a symmetric model, as fuge_halfspace_symmetric_stress. */
int fuge_halfspace_symmetric_displacement(int n, const double *x, const double *y,
                                          const double *width_x, const double *width_y,
                                          const double *force, double young, double poisson,
                                          int symmetric_x, int symmetric_y, int points,
                                          const double *px, const double *py, const double *pz,
                                          double *displacement, char *message, size_t len);

/* ---- stresses on grids --------------------------------------------------- */

/* ---- stresses of round bodies -------------------------------------------- */

/* ---- stress measures ----------------------------------------------------- */

/* ---- largest stresses ---------------------------------------------------- */

#ifdef __cplusplus
}
#endif

#endif
