/* fuge - frictionless elastic contact.  SPDX-License-Identifier: BSD-3-Clause
 *
 * THE PROBLEM.  Two elastic bodies with n candidate contact points are pressed together
 * by a load F_0 >= 0.  Given the influence matrix alpha (displacement into the body
 * per contact force), the initial gaps g and F_0, find forces f, gaps c and the
 * rigid approach v_0 with
 *
 *     c = g + alpha f - v_0                      gaps
 *     c >= 0,  f >= 0,  f_k c_k = 0              contact, no adhesion
 *     f_1 + .. + f_n = F_0                       equilibrium
 *
 * (Fischer, Hoyer, Melosh, equations 9 to 11).  alpha is symmetric and positive
 * definite on the forces with zero sum; for F_0 > 0 the solution is then unique, for
 * F_0 = 0 v_0 is the largest possible, min g.  A constant added to g changes v_0 only.
 * Units are yours, as long as they are consistent: length for gaps and v_0, force for f
 * and F_0, length per force for alpha.
 *
 * In general there are m rigid motions q, such as a translation and a tilt, or those of
 * several bodies; column j of R (n x m) says how far each point closes per unit of q_j:
 *
 *     c = g + alpha f - R q                      gaps
 *     0 <= c <= d                                play d >= 0 between two stops,
 *     f >= 0 where c = 0,  f <= 0 where c = d,   d infinite: one-sided, as above
 *     f = 0 between                              d = 0: tied, c = 0 and f of either sign
 *     (R^T f)_j = w_j  or  q_j prescribed        each motion is free under its resultant
 *                                                w_j, or prescribed
 *
 * and points may be excluded: no force, any gap.  The paper's problem is R = 1, q = v_0,
 * w = F_0.  alpha has to be positive definite on the forces with R^T f = 0 in the free
 * motions.  The forces are then unique.  A free motion that no contact resists (w = 0, or a
 * body about to tip) is not: the solution has one of the possible values, with
 * FUGE_WARN_NOT_UNIQUE.  Every engine solves every problem of this form.
 *
 * Each point may have a law: limits of its force at both stops, beyond which it gives way, f = u
 * with c <= 0 and f = -l with c >= d, and a spring of compliance D_k, (alpha + D) f in place of
 * alpha f; and a motion may have a spring, w - S q in place of w.  See
 * fuge_set_compliance, fuge_set_limits and fuge_set_motion_stiffness.
 *
 * CONVENTIONS.  Matrices are column-major: alpha(i,k) is alpha[i + k*lda].  Points, rows,
 * degrees of freedom and modes count from 0, in messages too, unless an argument says
 * otherwise; lines of files, and what is quoted from them, count from 1.  Every function
 * that returns int returns a status: 0 done, > 0 done with a warning, < 0 an error that
 * left all outputs untouched (fuge_status_text gives the general meaning).  NULL where it
 * is not allowed is FUGE_ERR_POINTER.  Nothing is printed, nothing aborts, there is no
 * global state.  Set reserved members of structs to zero, as fuge_default_options,
 * fuge_default_link_law and `= {0}` do: later versions read them.
 *
 * MESSAGES.  A message says what is wrong, where, and how to mend it; it is empty when all
 * is well, but for a remark of a solve with status 0 whose contact reaches the rim of a free
 * grid of fuge_operator_halfspace: the grid is too small unless the bodies end there.  A call
 * on a solver, a body, pairs, bodies or links that has no `message` among its arguments leaves
 * it there, for fuge_solver_message, fuge_body_message, fuge_pairs_message, fuge_bodies_message
 * and fuge_links_message.  Every other call that can refuse its data has `message` and `len`
 * as its last arguments: at most len bytes are written, always ended by NUL.  A buffer of
 * FUGE_MESSAGE_LENGTH + 1 bytes holds every message.  NULL, or len = 0, if no message is
 * wanted.
 *
 * THREADS.  Calls in different threads at once are safe unless two of them have the same
 * solver, body, pairs, bodies or links, even if both only read results.  Solvers of several threads may share
 * an operator and its matrix, which they only read, as long as no thread changes or frees
 * it meanwhile.  The work of a solve is shared by as many threads as its options say: they
 * start with the first work, end with the solve, and change no result.  A process may fork:
 * the child may use all objects but those that other threads were using.
 *
 * CALL ORDER.  Either fuge_solve_dense alone, or
 *     fuge_operator_dense, _halfplane, _halfspace or _callback -> fuge_solver_new
 *     -> fuge_set_gap, and fuge_set_load or another of the section "problem"
 *     -> fuge_solve -> fuge_get_... -> (set, solve, get again)
 *     -> fuge_solver_free -> fuge_operator_free
 *
 * HEADERS.  Those included below, one for each component of the library, can also be
 * included alone.  What needs MPI is in fuge_mpi.h.
 */
#ifndef FUGE_H
#define FUGE_H

#include "fuge_core.h"       /* problems, operators, solvers, results */
#include "fuge_elastic.h"    /* what all elastic bodies share: moduli, cells, fields inside */
#include "fuge_halfplane.h"  /* cells on a half-plane, edges of contact */
#include "fuge_halfspace.h"  /* rectangles on a half-space */
#include "fuge_rings.h"      /* round bodies on rings */
#include "fuge_layers.h"     /* coated and layered bodies */
#include "fuge_punches.h"    /* Hertz; smooth punches and round ones, without a grid */
#include "fuge_fe.h"         /* bodies of finite elements: condensation, pairs of surfaces */
#include "fuge_files.h"      /* results on grids and meshes for ParaView */
#include "fuge_accuracy.h"   /* contact to a wanted error */

#endif
