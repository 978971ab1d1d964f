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
