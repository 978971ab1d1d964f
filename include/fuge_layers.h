/* fuge - coated and layered bodies.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too.
 *
 * Elastic layers lie on a half-space or on a rigid base.  The operators are those of the
 * half-plane and the half-space of fuge_halfplane.h and fuge_halfspace.h with another surface: solvers,
 * coarser grids, windows and threads are the same.
 *   layers         in   >= 0
 *   thickness      in   layers, from the surface down; length
 *   young          in   layers + 1: Young's moduli, the last one of the half-space below the
 *                       layers; HUGE_VAL: a rigid base; force per length^2
 *   poisson        in   layers + 1: 0 .. 0.5, 0.5 for rubber
 *   bonded         in   1: all interfaces are bonded; 0: they slide without friction, and do not
 *                       come off; others are FUGE_ERR_OPTION
 *   e_star_other   in   E/(1 - nu^2) of the other body, a half-space; HUGE_VAL: it is rigid
 * Layers count from 1 in messages.  What is bonded to a layer of the same material is one with
 * it.  The ratio of two thicknesses, and of two moduli, is at most 1e8; all of them are in
 * 1e-77 .. 1e77.
 *
 * A wave q of pressure p displaces the surface by 2 T(q) p/(e_star q), where
 * 1/e_star = (1 - nu^2)/E of the top layer + 1/e_star_other, and T goes from 1 for short waves
 * to that of the half-space below for long ones.  On a rigid base T goes to zero: then equal
 * forces displace a periodic surface too, by pressure times thickness over modulus. */
#ifndef FUGE_LAYERS_H
#define FUGE_LAYERS_H

#include <stddef.h>
#include "fuge_halfplane.h"
#include "fuge_halfspace.h"
#include "fuge_rings.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- layers --------------------------------------------------------------- */

/* A layered half-plane in plane strain: the other arguments are those of
 * fuge_operator_halfplane.  Far from a force displacements are those of the half-space below
 * the layers, with its datum.  FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
 * FUGE_ERR_NOT_FINITE and FUGE_ERR_OVERFLOW also for the layers. */
int fuge_operator_layered_halfplane(int n, double spacing, int layers, const double *thickness,
                                    const double *young, const double *poisson, int bonded,
                                    double e_star_other, int element, int boundary,
                                    fuge_operator **op, char *message, size_t len);

/* A layered half-space, likewise, with the other arguments of fuge_operator_halfspace. */
int fuge_operator_layered_halfspace(int nx, int ny, double spacing_x, double spacing_y,
                                    int layers, const double *thickness, const double *young,
                                    const double *poisson, int bonded, double e_star_other,
                                    int element, int boundary, fuge_operator **op,
                                    char *message, size_t len);

/* Influence matrices: the arguments after those of the layers are those of
 * fuge_halfplane_matrix, fuge_halfspace_matrix and fuge_ring_matrix but e_star, and on rings
 * the element, which is FUGE_MEAN.  alpha is untouched after an error. */
int fuge_layered_halfplane_matrix(int layers, const double *thickness, const double *young,
                                  const double *poisson, int bonded, double e_star_other,
                                  int n, const double *x, const double *width, int element,
                                  int symmetric, double *alpha, int lda, char *message,
                                  size_t len);

int fuge_layered_halfspace_matrix(int layers, const double *thickness, const double *young,
                                  const double *poisson, int bonded, double e_star_other,
                                  int n, const double *x, const double *y,
                                  const double *width_x, const double *width_y, int element,
                                  int symmetric_x, int symmetric_y, double *alpha, int lda,
                                  char *message, size_t len);

int fuge_layered_ring_matrix(int layers, const double *thickness, const double *young,
                             const double *poisson, int bonded, double e_star_other, int n,
                             const double *radius, double *alpha, int lda, char *message,
                             size_t len);

/* The displacement of the surface by waves of pressure.
 *   waves        in   their number
 *   q            in   waves: 2 pi over the length of each wave; > 0; 1/length
 *   compliance   out  waves: displacement per pressure, 2 T/(e_star q)
 * FUGE_ERR_WIDTH for q <= 0. */
int fuge_layered_waves(int layers, const double *thickness, const double *young,
                       const double *poisson, int bonded, double e_star_other, int waves,
                       const double *q, double *compliance, char *message, size_t len);

/* ---- graded bodies -------------------------------------------------------- */

/* The layers of a body whose moduli vary over the depth, for the functions above, with
 * bonded = 1.  Layers are thin near the surface and where the moduli change fast, and more
 * and more until the error is at most the tolerance.
 *   points         in   >= 1
 *   depth          in   points: from 0, the surface, down; two equal ones are a jump; length
 *   young          in   points: Young's modulus at these depths, linear between them; below the
 *                       last one lies a half-space of the last values; the last one may be
 *                       HUGE_VAL after a jump: a rigid base; force per length^2
 *   poisson        in   points: Poisson's ratio, likewise; 0 .. 0.5
 *   tolerance      in   1e-10 .. 0.1: relative error of the displacement of the surface by a wave
 *                       of pressure, of any length; 1e-3 and 1e-4 take tens and hundreds of layers
 *   max_layers     in   length of thickness
 *   layers         out  their number
 *   thickness      out  max_layers, of which the first `layers` are set
 *   layer_young    out  max_layers + 1, of which the first layers + 1 are set
 *   layer_poisson  out  max_layers + 1, likewise
 *   error          out  estimate of the relative error: a third of the largest difference from
 *                       half as many layers, because layers are of second order in their
 *                       thickness; may be NULL
 * FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH for depths, FUGE_ERR_MODULUS, both also
 * for ratios above 1e8, FUGE_ERR_OPTION for the tolerance, FUGE_ERR_ITERATION_LIMIT if that
 * takes more than max_layers: the message says how many. */
int fuge_graded_layers(int points, const double *depth, const double *young,
                       const double *poisson, double tolerance, int max_layers, int *layers,
                       double *thickness, double *layer_young, double *layer_poisson,
                       double *error, char *message, size_t len);

/* ---- effective modulus ---------------------------------------------------- */

/* The half-space on which a rigid flat punch of the radius a is as stiff as on the layered one:
 * dF/dd = 2 a modulus.  That is the stiffness of a round punch of any profile with this contact
 * radius too, because it moves on as a flat one.  For moduli 1 : 100 .. 100 : 1 and on a rigid
 * base it is exact to 4e-6 for thicknesses from 0.1 radii on, to 1e-3 from 0.03 and to 5e-3 from
 * 0.01 on, and never too large.
 *   radii          in   their number
 *   radius         in   radii: of the contact; > 0; length
 *   modulus        out  radii: effective e_star of the two bodies, from that of the top layer
 *                       for small contacts to that of the half-space below for large ones
 * FUGE_ERR_WIDTH for radius <= 0. */
int fuge_layered_modulus(int layers, const double *thickness, const double *young,
                         const double *poisson, int bonded, double e_star_other, int radii,
                         const double *radius, double *modulus, char *message, size_t len);

/* Below which thickness a bonded coating is not felt, and above which the body below it is not.
 *   young, poisson in   2: of the coating and of the half-space below, whose modulus may be
 *                       HUGE_VAL: it is rigid
 *   radius         in   of the contact; > 0; length
 *   share          in   1e-6 .. 1: the largest relative change of the effective modulus, as above
 *                       against a rigid body, that counts as not felt
 *   thin           out  up to this thickness the coating is not felt; 0 on a rigid base, or if
 *                       1e-16 radii are felt; HUGE_VAL if it never is; length; may be NULL
 *   thick          out  from this thickness on the half-space below is not felt; 0 if it never
 *                       is, HUGE_VAL if it is below 1e16 radii; length; may be NULL
 * FUGE_ERR_WIDTH for the radius, FUGE_ERR_MODULUS, FUGE_ERR_OPTION for the share. */
int fuge_coating_limits(const double *young, const double *poisson, double radius, double share,
                        double *thin, double *thick, char *message, size_t len);

/* ---- fields -------------------------------------------------------------- */

/* Under cells on bodies of layers (layers .. bonded as above), in the body that these
 * describe, not in the other one; element is FUGE_CENTRE or FUGE_MEAN.  A line is in plane strain.
 * With FUGE_PERIODIC the mean pressure gives the half-space below the layers no stress along the
 * surface, and the layers the same strain as it has; on a rigid base layers have no strain along
 * the surface, and displacements count from the base.  FUGE_ERR_GRID for a place in a rigid base. */
int fuge_field_layered_line(int layers, const double *thickness, const double *young,
                            const double *poisson, int bonded, int n, const double *x,
                            const double *width, const double *force, int element, int symmetric,
                            fuge_field **field, char *message, size_t len);
int fuge_field_layered_line_grid(int layers, const double *thickness, const double *young,
                                 const double *poisson, int bonded, int n, double spacing,
                                 const double *force, int element, int boundary,
                                 fuge_field **field, char *message, size_t len);
int fuge_field_layered_area(int layers, const double *thickness, const double *young,
                            const double *poisson, int bonded, int n, const double *x,
                            const double *y, const double *width_x, const double *width_y,
                            const double *force, int symmetric_x, int symmetric_y,
                            fuge_field **field, char *message, size_t len);
int fuge_field_layered_area_grid(int layers, const double *thickness, const double *young,
                                 const double *poisson, int bonded, int nx, int ny,
                                 double spacing_x, double spacing_y, const double *force,
                                 int boundary, fuge_field **field, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
