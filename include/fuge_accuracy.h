/* fuge - contact to a wanted error.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too.
 *
 * The gap is a function of position, the error is given, and the solve chooses method and cells.
 * It refines until its estimate of the error is below the wanted one, and tells the errors and the
 * time of each level on the way.  They are those of the discretisation, not of the model.
 *
 *     fuge_solve_line or fuge_solve_area -> fuge_resolved_get_... -> fuge_resolved_free */
#ifndef FUGE_ACCURACY_H
#define FUGE_ACCURACY_H

#include <stddef.h>
#include "fuge_layers.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- solves to a wanted error -------------------------------------------- */

/* The initial gap at n places x, y: set gap, length, at all of them; on a line y is 0.  Edges,
 * kinks and jumps are fine.  It is asked inside the interval or the rectangle only.  Return 0; any
 * other value, NaN and infinity end the solve with FUGE_ERR_CALLBACK.  The function may not leave
 * by longjmp or an exception. */
typedef int (*fuge_gap_function)(int n, const double *x, const double *y, double *gap, void *user);

/* How the bodies deform, what presses them, how exact the answer has to be.  Zeros are the defaults
 * of all members: `fuge_pressing pressing = {0};`, then set e_star, or young and poisson, and load
 * or approach. */
typedef struct fuge_pressing {
  int boundary;                 /* FUGE_FREE, or FUGE_PERIODIC with the interval, or both sides of
                                   the rectangle, as period */
  int most_cells;               /* of a grid; 0: 2^20 on a line, 2^22 on an area */
  int threads;                  /* as in fuge_options: 0, as many as the process may use cores.  No
                                   result depends on it */
  int layers, bonded;           /* as in fuge_layers.h, where young is not NULL or layers not 0 */
  int reserved_int[3];
  double e_star;                /* as in fuge_halfplane_matrix; not read with layers; force per
                                   length^2 */
  double accuracy;              /* wanted error of the pressure: the share of the load that may be
                                   in the wrong place; below 1; 0: 1e-3 */
  double most_seconds;          /* no finer grid is begun that would be expected to end later than
                                   so many seconds after the call; 0: no limit */
  double e_star_other;          /* as in fuge_layers.h, with layers; 0: as HUGE_VAL, a rigid body */
  const double *load;           /* one of these two, the other NULL: the load >= 0; force, on a line
                                   per depth */
  const double *approach;       /* or the approach; length.  Its datum on a line is that of
                                   fuge_halfplane_matrix for cells that cover the interval */
  const double *moment;         /* on a free line with a load: its moment about x = 0, under which
                                   the bodies tilt; force times length per depth.  NULL: they only
                                   approach each other */
  const double *thickness;      /* layers, and each layers + 1, as in fuge_layers.h */
  const double *young;
  const double *poisson;
  double reserved[8];
} fuge_pressing;

/* method of a contact or a level */
enum {
  FUGE_BY_SERIES = 1,           /* a series on one smooth contact, as fuge_solve_smooth_punch */
  FUGE_BY_GRADED_CELLS = 2,     /* cells that are narrow at the ends of the contact */
  FUGE_BY_EQUAL_CELLS = 3       /* equal cells by FFT */
};

/* A contact to a wanted error. */
typedef struct fuge_resolved fuge_resolved;

/* Solve on the interval from left to right, or on the rectangle from lower to upper.
 *   gap, user     in   the function, and the pointer it gets as user (may be NULL)
 *   left, right   in   left < right; length
 *   lower, upper  in   2: x and y of the corners, lower < upper in both; length
 *   pressing      in   as above; it may change and go after the call
 *   contact       out  *contact is set unless there is an error
 * FUGE_WARN_ACCURACY: the estimated error is above the wanted one, because memory, most_cells or
 * most_seconds end; the message has what was reached, the contact is that of the last level.
 * FUGE_ERR_OPTION unless one of load and approach is given, and for a member of pressing that is out
 * of range; FUGE_ERR_UNSUPPORTED for a moment with an approach, on a periodic surface or on an area,
 * and from a library without FFTW where equal cells are needed.  FUGE_ERR_WIDTH, FUGE_ERR_MODULUS,
 * FUGE_ERR_NO_EQUILIBRIUM for a load < 0 or a moment that the interval does not carry,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_SIZE, FUGE_ERR_MEMORY. */
int fuge_solve_line(fuge_gap_function gap, void *user, double left, double right,
                    const fuge_pressing *pressing, fuge_resolved **contact, char *message,
                    size_t len);
int fuge_solve_area(fuge_gap_function gap, void *user, const double *lower, const double *upper,
                    const fuge_pressing *pressing, fuge_resolved **contact, char *message,
                    size_t len);

/* ---- resolved contacts ---------------------------------------------------- */

/* Free and set *contact to NULL; NULL and *contact == NULL are fine. */
void fuge_resolved_free(fuge_resolved **contact);

typedef struct fuge_resolved_report {
  int nx, ny;                   /* cells along x and y; on a line ny = 1 */
  int levels;                   /* solves on the way */
  int intervals;                /* of contact, with edges; on an area 0 */
  int method;                   /* FUGE_BY_SERIES .. */
  int at_rim[4];                /* 1 where the contact reaches the left, the right, the low or the
                                   high side of y: there the bodies are taken to end.  0 on a
                                   periodic surface */
  int reserved_int[7];
  double load;                  /* force, on a line per depth */
  double approach, tilt;        /* the bodies move by approach + tilt x, length; tilt is 0 without a
                                   moment */
  double largest;               /* largest pressure; force per length^2 */
  double size;                  /* of the contact: length on a line, area on an area */
  double pressure_error;        /* estimated: the share of the load in the wrong place */
  double approach_error;        /* estimated errors of the others, in their units; DBL_MAX: nothing
                                   is known */
  double largest_error, edge_error, size_error;
  double reserved[6];
  char choice[256];             /* a sentence that explains the method, ended by NUL */
} fuge_resolved_report;

/* A contact does not change once it is solved, and holds no message: several threads may read it
 * at once.  FUGE_ERR_POINTER for NULL. */
int fuge_resolved_get_report(const fuge_resolved *contact, fuge_resolved_report *report,
                             char *message, size_t len);

/* Cells, and what is found on them; each output may be NULL.
 *   x, width_x  out  nx: centres and widths along x; length
 *   y, width_y  out  ny: along y; length.  On a line y is 0 and its width 1
 *   force       out  nx*ny, x running first: contact forces; the pressure of a cell is its force
 *                    over both of its widths
 *   gap         out  nx*ny: gaps under load; length
 *   edges       out  2 x intervals: left and right end of interval k at edges + 2*k; length */
int fuge_resolved_get_cells(const fuge_resolved *contact, double *x, double *width_x, double *y,
                            double *width_y, double *force, double *gap, double *edges,
                            char *message, size_t len);

/* All solves in their order, the last one that of the contact; each output has `levels` elements,
 * and may be NULL.
 *   cells           out  of the grid; of a series its coefficients
 *   method          out  FUGE_BY_SERIES ..
 *   pressure_error  out  as in the report; 1: nothing is known yet
 *   approach_error  out  likewise; DBL_MAX: nothing is known yet; length
 *   seconds         out  since the call, when this level was done */
int fuge_resolved_get_levels(const fuge_resolved *contact, int *cells, int *method,
                             double *pressure_error, double *approach_error, double *seconds,
                             char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
