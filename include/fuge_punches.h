/* fuge - Hertz; smooth punches and round ones, without a grid; their fields.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_PUNCHES_H
#define FUGE_PUNCHES_H

#include <stddef.h>
#include "fuge_elastic.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Hertz -------------------------------------------------------------- */

/* Contact of two bodies with the initial gap x^2/(2 radius_x) + y^2/(2 radius_y), in closed
 * form: an ellipse with the pressure
 *
 *     p = peak_pressure sqrt(1 - (x/semi_axis_x)^2 - (y/semi_axis_y)^2).
 *
 *   radius_x, radius_y        in   > 0; principal relative radii of curvature,
 *                                  1/R = 1/R_1 + 1/R_2 of the two bodies, any ratio; length
 *   e_star                    in   as in fuge_halfplane_matrix; force per length^2
 *   load                      in   >= 0; force
 *   semi_axis_x, semi_axis_y  out  of the area of contact; length
 *   approach                  out  absolute; length
 *   peak_pressure             out  in the middle; force per length^2
 * Each output may be NULL.  FUGE_ERR_WIDTH for a radius <= 0, FUGE_ERR_MODULUS,
 * FUGE_ERR_NO_EQUILIBRIUM for a load < 0, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW. */
int fuge_hertz_ellipse(double radius_x, double radius_y, double e_star, double load,
                       double *semi_axis_x, double *semi_axis_y, double *approach,
                       double *peak_pressure, char *message, size_t len);

/* ---- smooth punches -----------------------------------------------------
 *
 * One interval of contact between a half-plane and a punch with a smooth profile.  There is
 * no grid: the ends of the contact are unknowns, and the pressure is
 *
 *     p = sqrt(1 - t^2) sum over k of coefficients[k] U_k(t),   x = middle + half_width t,
 *
 * with the Chebyshev polynomials U_k of the second kind.  A few dozen coefficients reach
 * rounding.
 *
 *     fuge_solve_smooth_punch -> fuge_punch_get_... -> fuge_punch_free */

/* The profile at n places x between lower and upper: set gap, the initial gap, length, and
 * slope, its derivative, no unit, at all of them.  Return 0; any other value, NaN and
 * infinity end the solve with FUGE_ERR_CALLBACK.  The function may not leave by longjmp or
 * an exception. */
typedef int (*fuge_smooth_profile)(int n, const double *x, double *gap, double *slope, void *user);

/* The contact of a punch, smooth or round. */
typedef struct fuge_punch fuge_punch;

/* Solve.
 *   profile, user  in   the function, and the pointer it gets as user (may be NULL)
 *   lower, upper   in   ends of the profile, lower < upper; length
 *   e_star         in   as in fuge_halfplane_matrix; force per length^2
 *   force          in   >= 0, per depth.  0: the punch touches at its lowest place
 *   moment         in   1: force times its distance from x = 0, under which the punch tilts.
 *                       NULL: it only sinks
 *   contact        out  *contact is set unless there is an error
 * FUGE_WARN_RESIDUAL: certificate or estimated error above 1e-10, the message says why;
 * FUGE_WARN_NOT_UNIQUE: no force and a free tilt.
 * FUGE_ERR_UNSUPPORTED: the contact is not one interval, or reaches an end of the
 * profile; the message says where, and which engine to use.  Bounds of series decide that;
 * a feature of the profile narrower than (upper - lower)/512 may be overlooked.
 * FUGE_ERR_WIDTH, FUGE_ERR_MODULUS, FUGE_ERR_NO_EQUILIBRIUM (force < 0, or its line of
 * action outside the profile), FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW. */
int fuge_solve_smooth_punch(fuge_smooth_profile profile, void *user, double lower, double upper,
                            double e_star, double force, const double *moment,
                            fuge_punch **contact, char *message, size_t len);

/* ---- round punches ------------------------------------------------------
 *
 * The same for a punch of revolution on a half-space: one disc of contact, whose radius is
 * the only unknown.
 *
 *     fuge_solve_round_punch -> fuge_punch_get_... -> fuge_punch_free */

/* Solve.
 *   profile, user           in   as above, x being the distance from the axis; the profile has
 *                                to be smooth from the axis on, a tip is allowed
 *   reach                   in   > 0; where the profile ends; length
 *   e_star                  in   as in fuge_halfplane_matrix; force per length^2
 *   load, approach, radius  in   one of them, the others NULL: >= 0, force; how far the bodies
 *                                approach each other, length; radius of the contact, length
 *   contact                 out  *contact is set unless there is an error
 * Without load, or up to the approach at which the punch touches, the radius is 0.
 * FUGE_WARN_RESIDUAL: certificate or estimated error above 1e-10, the message says why.
 * FUGE_ERR_UNSUPPORTED: the contact is not one disc, or reaches the end of the profile; the
 * message says where, and which engine to use.  Bounds of series decide that; a feature of the
 * profile narrower than reach/512 may be overlooked.
 * FUGE_ERR_OPTION unless one of load, approach and radius is given.  FUGE_ERR_WIDTH,
 * FUGE_ERR_MODULUS, FUGE_ERR_NO_EQUILIBRIUM (load < 0), FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_OVERFLOW, FUGE_ERR_CALLBACK. */
int fuge_solve_round_punch(fuge_smooth_profile profile, void *user, double reach, double e_star,
                           const double *load, const double *approach, const double *radius,
                           fuge_punch **contact, char *message, size_t len);

/* The same for the initial gap sum over k < terms of coefficients[k] (r - starts[k])^powers[k],
 * each term from r = starts[k] on.
 *   powers  in  >= 1, any: 1 for a cone, 2 for a paraboloid
 *   starts  in  >= 0, length; NULL: all 0.  Where one is not 0 the power is 1 or 2
 * A flat end of radius b with an edge rounded by R is (r - b)^2/(2 R); a ball worn flat there
 * has b (r - b)/R in addition.
 * FUGE_ERR_WIDTH for a power below 1, a start < 0, or a start with another power than 1 or 2. */
int fuge_solve_round_powers(int terms, const double *coefficients, const double *powers,
                            const double *starts, double reach, double e_star,
                            const double *load, const double *approach, const double *radius,
                            fuge_punch **contact, char *message, size_t len);

/* ---- contacts of punches ------------------------------------------------ */

/* Free and set *contact to NULL; NULL and *contact == NULL are fine. */
void fuge_punch_free(fuge_punch **contact);

typedef struct fuge_punch_report {
  int iterations;               /* series formed */
  int coefficients;             /* number of coefficients of the series */
  int reserved_int[6];
  double left, right;           /* ends of the contact; length.  Of a disc -radius and radius */
  double half_width;            /* more accurate than (right - left)/2 far from x = 0; the radius of
                                   a disc */
  double force, moment;         /* force, per depth or on the disc; moment about x = 0, else 0 */
  double approach, tilt;        /* a smooth punch moves by approach + tilt x; the displacement by a
                                   line load is zero at the distance 2 (upper - lower).  The
                                   approach of a round one is absolute, its tilt is 0; length */
  double residual;              /* certificate: largest scaled violation of the problem */
  double end_error;             /* estimated error of the ends, relative to the half width */
  double pressure_error;        /* estimated error of the pressure, relative to its maximum, under
                                   a round punch to its mean */
  double reserved[8];
} fuge_punch_report;

/* A contact does not change once it is solved, and holds no message: several threads may
 * read it at once.  FUGE_ERR_POINTER, FUGE_ERR_SIZE; FUGE_ERR_NOT_FINITE for a place or an
 * initial gap. */
int fuge_punch_get_report(const fuge_punch *contact, fuge_punch_report *report,
                          char *message, size_t len);

/* Pressure at count >= 0 places x, under a round punch distances from the axis; force per
 * length^2, 0 outside the contact.  In the tip of a cone it is infinite: the result is the
 * largest number. */
int fuge_punch_get_pressure(const fuge_punch *contact, int count, const double *x,
                            double *pressure, char *message, size_t len);

/* Gap under load at count >= 0 places x from the initial gaps there; length.  gap may be
 * the same array as x or initial_gap. */
int fuge_punch_get_gap(const fuge_punch *contact, int count, const double *x,
                       const double *initial_gap, double *gap, char *message, size_t len);

/* Coefficients: those of the pressure under a smooth punch, force per length^2; under a round one
 * those of the Chebyshev series, from the axis to the radius, of the derivative of Abel's transform
 * of the profile, no unit, and none for powers.  Only the first capacity are written;
 * fuge_punch_get_report has their number. */
int fuge_punch_get_coefficients(const fuge_punch *contact, int capacity, double *coefficients,
                                char *message, size_t len);

/* ---- fields -------------------------------------------------------------- */

/* Under a punch of fuge_solve_smooth_punch, fuge_solve_round_punch or fuge_solve_round_powers, to
 * rounding.  plane_state as in fuge_field_halfplane; under a round punch it does not count.  Along z
 * displacements have the datum of the approach in fuge_punch_get_report; in the tip of a cone zz is
 * -DBL_MAX. */
int fuge_field_punch(const fuge_punch *contact, double young, double poisson, int plane_state,
                     fuge_field **field, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
