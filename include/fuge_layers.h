/* fuge - coated and layered bodies.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too.
 *
 * Elastic layers lie on a half-space or on a rigid base.  The operators are those of the
 * half-plane and the half-space of fuge_core.h and fuge_area.h with another surface: solvers,
 * coarser grids, windows and threads are the same.
 *   layers         in   >= 0
 *   thickness      in   layers, from the surface down; length
 *   young          in   layers + 1: Young's moduli, the last one of the half-space below the
 *                       layers; HUGE_VAL: a rigid base; force per length^2
 *   poisson        in   layers + 1: 0 .. 0.5, 0.5 for rubber
 *   bonded         in   1: all interfaces are bonded; 0: they slide without friction, and do not
 *                       come off
 *   e_star_other   in   E/(1 - nu^2) of the other body, a half-space; HUGE_VAL: it is rigid
 * Layers count from 1 in messages.  What is bonded to a layer of the same material is one with
 * it.  The ratio of two thicknesses, and of two moduli, is at most 1e8.
 *
 * A wave q of pressure p displaces the surface by 2 T(q) p/(e_star q), where
 * 1/e_star = (1 - nu^2)/E of the top layer + 1/e_star_other, and T goes from 1 for short waves
 * to that of the half-space below for long ones.  On a rigid base T goes to zero: then equal
 * forces displace a periodic surface too, by pressure times thickness over modulus. */
#ifndef FUGE_LAYERS_H
#define FUGE_LAYERS_H

#include <stddef.h>
#include "fuge_area.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- layers --------------------------------------------------------------- */

/* A layered half-plane in plane strain: the other arguments are those of
 * fuge_operator_halfplane.  Far from a force displacements are those of the half-space below
 * the layers, with its datum.  FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
 * FUGE_ERR_NOT_FINITE also for the layers. */
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

#ifdef __cplusplus
}
#endif

#endif
