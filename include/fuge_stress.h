/* fuge - stresses and displacements in the bodies.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_STRESS_H
#define FUGE_STRESS_H

#include <stddef.h>
#include "fuge_area.h"
#include "fuge_core.h"
#include "fuge_punch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- fields --------------------------------------------------------------
 *
 * A field knows the stresses and displacements in the body below a contact, under the forces of a
 * solution; for the other body turn z round and take its own moduli.  Make one for a body, ask it,
 * free it.  It keeps copies of the arrays that it is made of.
 *
 * Places are x, y, z of each point, z >= 0 from the surface into the body; length.  In a plane y
 * does not count; about an axis x >= 0 is the radius, y the circumference.  A tensor is xx, yy, zz,
 * yz, xz, xy, force per length^2, tension positive, so that under a pressure p at z = 0 zz is -p;
 * displacements are along x, y, z, length, that along z into the body.
 *
 * *field is set on success only.  FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_WIDTH, FUGE_ERR_ELEMENT, FUGE_ERR_MODULUS, FUGE_ERR_OPTION, FUGE_ERR_OVERFLOW,
 * FUGE_ERR_MEMORY; grids from a library without FFTW: FUGE_ERR_UNSUPPORTED. */

typedef struct fuge_field fuge_field;

/* Free and set *field to NULL; NULL and *field == NULL are fine. */
void fuge_field_free(fuge_field **field);

/* Under cells on a half-plane.
 *   n, x, width, element, symmetric  as in fuge_halfplane_matrix; FUGE_CENTRE and FUGE_MEAN are
 *                                    strips of pressure force/width, FUGE_HAT hats with the peak
 *                                    force/width
 *   force                            n; per unit depth, compression positive, of any sign: those
 *                                    of fuge_get_force.  Cells without force cost nothing
 *   young, poisson, plane_state      of the body, as in fuge_plane_modulus; a rigid one (young
 *                                    INFINITY) does not move
 * Along z displacements have the datum of fuge_halfplane_matrix; a line load moves points straight
 * below it along z only.  At z = 0 stresses are those of the surface, at an end of a strip their
 * means from both sides, although xz straight below it tends to pressure/pi or, at the right end, to
 * -pressure/pi. */
int fuge_field_halfplane(int n, const double *x, const double *width, const double *force,
                         int element, int symmetric, double young, double poisson,
                         int plane_state, fuge_field **field, char *message, size_t len);

/* Under n equal cells side by side, of which the first one has its centre at x = 0.
 *   spacing            > 0; width of a cell, length
 *   element, boundary  as in fuge_operator_halfplane
 * With FUGE_PERIODIC the field is known below the centres of the cells only.  The mean pressure is
 * then a stress zz = -mean at all depths; what stress it has along the surface depends on how the
 * body is held far away.  Here it is 0: a body that cannot expand has in addition
 * poisson/(1 - poisson) times the mean of zz.  Displacements count, at each depth, from the mean at
 * that depth. */
int fuge_field_halfplane_grid(int n, double spacing, const double *force, int element,
                              int boundary, double young, double poisson, int plane_state,
                              fuge_field **field, char *message, size_t len);

/* Under rectangles on a half-space, each a uniform pressure.
 *   n .. width_y, symmetric_x, symmetric_y  as in fuge_halfspace_matrix
 *   force                                   n; those of 0 cost nothing
 *   young, poisson                          of the body, not of the pair
 * Displacements vanish far away.  At z = 0 stresses are limits from inside, on an edge between
 * different pressures the means of both sides, at a corner those around it; at a corner xy is
 * infinite if poisson < 0.5 and the pressures around it do not balance: its logarithm is left out.
 * Rectangles may overlap: their pressures add up. */
int fuge_field_halfspace(int n, const double *x, const double *y, const double *width_x,
                         const double *width_y, const double *force, int symmetric_x,
                         int symmetric_y, double young, double poisson, fuge_field **field,
                         char *message, size_t len);

/* Under nx x ny equal cells side by side: cell i + nx*j has its centre at (spacing_x*i,
 * spacing_y*j).  boundary as in fuge_operator_halfspace; of periodic ones all holds that is said
 * above. */
int fuge_field_halfspace_grid(int nx, int ny, double spacing_x, double spacing_y,
                              const double *force, int boundary, double young, double poisson,
                              fuge_field **field, char *message, size_t len);

/* Under n rings about one axis, radius (n + 1) as in fuge_ring_matrix, force (n) of uniform
 * pressures.  At an edge of a ring stresses are the means from both sides. */
int fuge_field_rings(int n, const double *radius, const double *force, double young,
                     double poisson, fuge_field **field, char *message, size_t len);

/* Under a smooth punch of fuge_solve_smooth_punch, to rounding; along z displacements have the datum
 * of the approach in fuge_smooth_get_report. */
int fuge_field_smooth(const fuge_smooth *contact, double young, double poisson, int plane_state,
                      fuge_field **field, char *message, size_t len);

/* Under a round punch of fuge_solve_round_punch or fuge_solve_round_powers, to rounding.  In the tip
 * of a cone zz is -DBL_MAX. */
int fuge_field_round(const fuge_round *contact, double young, double poisson, fuge_field **field,
                     char *message, size_t len);

/* The same in bodies of layers (layers .. bonded as in fuge_layers.h), in the body that these
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

/* Tensors, or displacements, at places.
 *   place   in   3 x points: x, y, z of point k at place + 3*k
 *   below   in   points, or NULL for all 0.  In layers, at an interface, 0: just above it, otherwise
 *                just below it
 *   tensor, displacement  out  6 x points, 3 x points; they may not overlap another array
 * To rounding at any depth and distance, in layers to 1e-8 of the largest; many points under many
 * cells cost less than each point for each cell.  FUGE_ERR_GRID for z < 0; FUGE_ERR_UNSUPPORTED for
 * a periodic grid. */
int fuge_field_stress(const fuge_field *field, int points, const double *place, const int *below,
                      double *tensor, char *message, size_t len);
int fuge_field_displacement(const fuge_field *field, int points, const double *place,
                            const int *below, double *displacement, char *message, size_t len);

/* The same below the centres of the cells of a grid, by FFT: a depth costs O(n log n).
 *   depth, below  in   depths; depth >= 0, in any order, length
 *   tensor        out  6 x cells x depths: of cell i at depth k at tensor + 6*(i + cells*k)
 *   displacement  out  3 x cells x depths
 * FUGE_ERR_UNSUPPORTED for a field that is not that of a grid. */
int fuge_field_grid_stress(const fuge_field *field, int depths, const double *depth,
                           const int *below, double *tensor, char *message, size_t len);
int fuge_field_grid_displacement(const fuge_field *field, int depths, const double *depth,
                                 const int *below, double *displacement, char *message,
                                 size_t len);

/* measure: which stress is to be largest. */
enum {
  FUGE_MEASURE_VON_MISES = 0,   /* sqrt(3 J_2) */
  FUGE_MEASURE_TRESCA = 1       /* twice the largest shear stress */
};

/* location of a largest stress */
enum {
  FUGE_PEAK_INSIDE = 0,         /* below the surface */
  FUGE_PEAK_SURFACE = 1,        /* at the surface */
  FUGE_PEAK_SINGULAR = 2        /* infinite, at an edge of the contact or in a tip */
};

/* Without forces value, place and tensor are 0. */
typedef struct fuge_stress_peak {
  int location;                 /* FUGE_PEAK_... */
  int layer;                    /* in a body of layers: 0 is the top one, the last number the
                                   substrate; layers that are bonded to the same material are one
                                   with it; otherwise -1 */
  int cell;                     /* in layers: the cell above; otherwise -1 */
  int reserved_int[5];
  double value;                 /* force per length^2; +infinity if singular */
  double place[3];              /* x, y, z, length; y is 0 in a plane; about an axis it is radius,
                                   0, z */
  double tensor[6];             /* xx, yy, zz, yz, xz, xy there; about an axis x is the radius */
  double reserved[6];
} fuge_stress_peak;

/* The largest stress in the body and where it is: value and place of the field that these forces
 * have.  The relative error of the value is below 1e-6, and below 1e-3 where the stress has a cusp,
 * as at the surface beside the rim of a contact; the place is as exact as the root of that.
 *
 * Uniform pressure jumps from cell to cell, and close to the surface the stresses follow the cells
 * rather than the contact.  On strips, rectangles and rings the search therefore takes the middle of
 * the cell with the largest pressure at the surface, on rectangles and rings with Poisson's ratios
 * below 0.2 those of all cells and of equal ones next to them, and below the surface depths from a
 * quarter of the (lesser) width of a cell on.  Under hats, smooth and round punches it takes all
 * depths.  In layers it takes all depths below the centres of the
 * cells of a grid, both sides of their interfaces, and the surface.
 *
 * Where the pressure of the contact is infinite so is the stress, and any number found would be one
 * of the grid: then location is FUGE_PEAK_SINGULAR, value +infinity, place that edge or tip and
 * tensor NaN.  Cells tell it from the forces of up to seven cells at an edge, which grow towards it
 * as under a flat punch (on rectangles in three rows side by side); edges of very small pieces of
 * contact are not judged.  Tips of round punches and edges within their contact are singular unless
 * Poisson's ratio is 0.5.  In layers it is that of the grid.
 *
 * In a symmetric model the peak is at x >= 0, or y >= 0.  *peak is untouched if there is an error.
 * FUGE_ERR_OPTION for measure; FUGE_ERR_OVERFLOW if no stress is finite; FUGE_ERR_UNSUPPORTED for a
 * periodic grid without layers, and for layers without a grid. */
int fuge_field_largest(const fuge_field *field, int measure, fuge_stress_peak *peak, char *message,
                       size_t len);

/* The largest stresses of the surface or of an interface, and the cells above them. */
typedef struct fuge_interface_stress {
  double depth;                 /* length */
  double tension_above;         /* the largest principal stress, tension positive, above the
                                   interface and below it; at the surface, and at a rigid base,
                                   both are those in the layers; force per length^2 */
  double tension_below;
  double shear;                 /* the largest shear stress between both sides */
  double opening;               /* the largest stress zz, which opens the interface */
  int cell_above;
  int cell_below;
  int cell_of_shear;
  int cell_of_opening;
} fuge_interface_stress;

/* Those of the surface and of all interfaces of layers below a grid, from above.
 *   capacity     in   length of peaks
 *   interfaces   out  their number, at most layers: layers that are bonded to the same material
 *                     are one with it
 *   peaks        out  interfaces + 1, of which the first capacity are written; NULL if not needed
 * At the surface stresses jump from cell to cell at the edge of the contact, and their error is
 * of the order of a cell.  FUGE_ERR_UNSUPPORTED for a body without layers, and without a grid. */
int fuge_field_interfaces(const fuge_field *field, int capacity, int *interfaces,
                          fuge_interface_stress *peaks, char *message, size_t len);

/* ---- stress measures -----------------------------------------------------
 *
 * Scalars of stresses, point by point.  A tensor is 6 x points: xx, yy, zz, yz, xz, xy.  Results
 * have the unit of the stress; they are NaN where a component is NaN or infinite.  Results may not
 * overlap inputs.
 * FUGE_ERR_POINTER, FUGE_ERR_SIZE. */

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

#ifdef __cplusplus
}
#endif

#endif
