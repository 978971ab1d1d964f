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

/* ---- stress measures ----------------------------------------------------- */

/* ---- largest stresses ---------------------------------------------------- */

#ifdef __cplusplus
}
#endif

#endif
