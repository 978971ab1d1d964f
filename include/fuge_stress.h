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

/* Stresses in a half-plane under forces on its cells, to rounding at any depth and distance.
 *   n                  in   cells
 *   x, width, element  in   as in fuge_halfplane_matrix; FUGE_CENTRE and FUGE_MEAN are strips of
 *                           pressure force/width, FUGE_HAT hats with the peak force/width
 *   force              in   n; per unit depth, compression positive, of any sign: those of
 *                           fuge_get_force.  Cells without force cost nothing
 *   points             in   >= 0
 *   px, pz             in   points; along the surface, and >= 0 into the body; length
 *   stress             out  3 for each point: xx, zz, xz of point k at stress + 3*k; force per
 *                           length^2, tension positive; it may not overlap another array
 * At z = 0 they are -pressure, -pressure and 0, and at an end of a strip their means from both
 * sides, although xz straight below it tends to pressure/pi or, at the right end, to
 * -pressure/pi.  In plane strain yy is nu (xx + zz).  Many points under many cells cost less
 * than each point for each cell: far cells are taken together, to rounding.
 * Errors of fuge_halfplane_matrix; FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_GRID for pz < 0,
 * FUGE_ERR_OVERFLOW for a length beyond 1e75 times the narrowest width, FUGE_ERR_MEMORY. */
int fuge_halfplane_stress(int n, const double *x, const double *width, const double *force,
                          int element, int points, const double *px, const double *pz,
                          double *stress, char *message, size_t len);

/* The same for a model symmetric about x = 0, as in fuge_halfplane_symmetric_matrix: only the
 * cells with x >= 0, each force the sum over a cell and its mirror image.  px of either sign. */
int fuge_halfplane_symmetric_stress(int n, const double *x, const double *width,
                                    const double *force, int element, int points,
                                    const double *px, const double *pz, double *stress,
                                    char *message, size_t len);

/* Displacements in a half-plane under forces on its cells.
 *   young, poisson, plane_state  in   of the body, as in fuge_plane_modulus
 *   displacement                 out  2 for each point: along x and z, length
 * Along z the datum is that of fuge_halfplane_matrix: with FUGE_CENTRE or FUGE_HAT the surface
 * sinks at the centres by alpha force for the modulus of this body.  A line load moves points
 * straight below it along z only, and the displacement along x grows from there.  A rigid body
 * (young INFINITY) does not move.  Other arguments and errors as above; also FUGE_ERR_MODULUS,
 * FUGE_ERR_OPTION for plane_state. */
int fuge_halfplane_displacement(int n, const double *x, const double *width, const double *force,
                                int element, double young, double poisson, int plane_state,
                                int points, const double *px, const double *pz,
                                double *displacement, char *message, size_t len);

int fuge_halfplane_symmetric_displacement(int n, const double *x, const double *width,
                                          const double *force, int element, double young,
                                          double poisson, int plane_state, int points,
                                          const double *px, const double *pz,
                                          double *displacement, char *message, size_t len);

/* Stresses and displacements in a half-plane under a smooth punch, in closed form, with the
 * arguments of fuge_halfplane_stress and fuge_halfplane_displacement.
 *   contact  in  of fuge_solve_smooth_punch.  Without force there are none
 * Along z the datum is that of the approach in fuge_smooth_get_report. */
int fuge_smooth_stress(const fuge_smooth *contact, int points, const double *px, const double *pz,
                       double *stress, char *message, size_t len);

int fuge_smooth_displacement(const fuge_smooth *contact, double young, double poisson,
                             int plane_state, int points, const double *px, const double *pz,
                             double *displacement, char *message, size_t len);

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

/* ---- stress measures -----------------------------------------------------
 *
 * Scalars of stresses, point by point.  A tensor is 6 x points: xx, yy, zz, yz, xz, xy.  Results
 * have the unit of the stress; they are NaN where a component is NaN or infinite, except that the
 * two functions which arrange components pass these on.  Results may not overlap inputs.
 * FUGE_ERR_POINTER, FUGE_ERR_SIZE. */

/* Tensors from the stresses in a plane.
 *   stress       in   3 x points: xx, zz, xz
 *   plane_state  in   FUGE_PLANE_STRAIN: yy = poisson (xx + zz); FUGE_PLANE_STRESS: yy = 0
 *   poisson      in   of the body, in (-1, 0.5], also in plane stress
 *   tensor       out  6 x points
 * FUGE_ERR_OPTION, FUGE_ERR_MODULUS, FUGE_ERR_NOT_FINITE (poisson). */
int fuge_halfplane_tensor(int points, const double *stress, int plane_state, double poisson,
                          double *tensor, char *message, size_t len);

/* Tensors from the stresses about an axis, stress 4 x points: rr, tt, zz, rz; x is the radius and
 * y the circumference. */
int fuge_round_tensor(int points, const double *stress, double *tensor, char *message, size_t len);

/* Principal stresses, principal 3 x points, the largest first; to rounding of the largest one. */
int fuge_principal_stresses(int points, const double *tensor, double *principal,
                            char *message, size_t len);

/* One number for each point.  Von Mises stress, sqrt(3 J_2), and Tresca stress, the largest
 * principal stress minus the smallest one, which is twice the largest shear stress: in simple
 * tension both are the stress, and a large hydrostatic stress costs them no digits.  Mean stress,
 * (xx + yy + zz)/3. */
int fuge_von_mises(int points, const double *tensor, double *value, char *message, size_t len);
int fuge_tresca(int points, const double *tensor, double *value, char *message, size_t len);
int fuge_mean_stress(int points, const double *tensor, double *value, char *message, size_t len);

/* ---- largest stresses ---------------------------------------------------- */

#ifdef __cplusplus
}
#endif

#endif
