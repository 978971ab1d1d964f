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
#include "fuge_area.h"
#include "fuge_core.h"
#include "fuge_punch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- stresses of a half-plane -------------------------------------------- */

/* Stresses in a half-plane under forces on its cells, to rounding at any depth and distance: zz
 * relative to the sum of its terms, xx and xz relative to the largest of the three.
 *   n                  in   cells
 *   x, width, element  in   as in fuge_halfplane_matrix; FUGE_CENTRE and FUGE_MEAN are strips of
 *                           pressure force/width, FUGE_HAT hats with the peak force/width
 *   force              in   n; per unit depth, compression positive, of any sign: those of
 *                           fuge_get_force.  Cells without force cost nothing
 *   symmetric          in   1: half of a symmetric model, as in fuge_halfplane_matrix: each force
 *                           is the sum over a cell and its mirror image, and points may lie on
 *                           both sides.  0: all cells are passed
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
                          int element, int symmetric, int points, const double *px,
                          const double *pz, double *stress, char *message, size_t len);

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
                                int symmetric, int points, const double *px, const double *pz,
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
 *   symmetric_x       in   1: half of a model symmetric about x = 0, as in fuge_halfspace_matrix;
 *                          points may lie on both sides.  0: all rectangles are passed
 *   symmetric_y       in   the same about y = 0
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
                          int symmetric_x, int symmetric_y, int points, const double *px,
                          const double *py, const double *pz, double *stress, char *message,
                          size_t len);

/* Displacements at points of a half-space under the forces of rectangles.
 *   young, poisson    in   of the body, not of the pair; force per length^2, and none;
 *                          young may be INFINITY
 *   displacement      out  3 x points: along x, y and z, z into the body; length
 * All else as in fuge_halfspace_stress.  Displacements vanish far away; those along z at the
 * centres of the rectangles are the matrix of fuge_halfspace_matrix (FUGE_CENTRE, e_star =
 * young/(1 - poisson^2)) times the forces. */
int fuge_halfspace_displacement(int n, const double *x, const double *y, const double *width_x,
                                const double *width_y, const double *force, double young,
                                double poisson, int symmetric_x, int symmetric_y, int points,
                                const double *px, const double *py, const double *pz,
                                double *displacement, char *message, size_t len);

/* ---- stresses on grids ---------------------------------------------------
 *
 * Below the centres of equal cells side by side, by FFT: a depth costs O(n log n), and the forces
 * are transformed once for all of them.  The results are those of the sections above at these
 * points.  They may not overlap inputs.  FUGE_ERR_UNSUPPORTED from a library without FFTW.
 *
 * With FUGE_PERIODIC the mean pressure is a stress zz = -mean at all depths; what stress it has
 * along the surface depends on how the body is held far away.  Here it is 0: a body that cannot
 * expand has in addition poisson/(1 - poisson) times the mean of zz, in plane strain and in a
 * half-space.  Displacements count, at each depth, from the mean at that depth. */

/* Stresses in a half-plane.
 *   n          in   cells, the period with FUGE_PERIODIC
 *   spacing    in   > 0; width of a cell, length
 *   force      in   n; per unit depth, compression positive, of any sign
 *   element    in   FUGE_CENTRE and FUGE_MEAN: strips of pressure force/spacing; FUGE_HAT
 *   boundary   in   FUGE_FREE or FUGE_PERIODIC
 *   depths     in   >= 0
 *   depth      in   depths; >= 0, in any order, length
 *   stress     out  xx, zz, xz of cell i at depth k at stress + 3*(i + n*k); force per length^2
 * FUGE_ERR_SIZE, FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH, FUGE_ERR_ELEMENT,
 * FUGE_ERR_OPTION for boundary, FUGE_ERR_GRID for a depth < 0, FUGE_ERR_OVERFLOW,
 * FUGE_ERR_MEMORY. */
int fuge_halfplane_stress_grid(int n, double spacing, const double *force, int element,
                               int boundary, int depths, const double *depth, double *stress,
                               char *message, size_t len);

/* Displacements in a half-plane.
 *   young, poisson, plane_state  in   of the body, as in fuge_plane_modulus
 *   displacement                 out  along x and z of cell i at depth k at
 *                                     displacement + 2*(i + n*k), length
 * With FUGE_FREE the datum is that of fuge_halfplane_displacement.  Other arguments and errors as
 * above; also FUGE_ERR_MODULUS, FUGE_ERR_OPTION for plane_state. */
int fuge_halfplane_displacement_grid(int n, double spacing, const double *force, int element,
                                     int boundary, double young, double poisson, int plane_state,
                                     int depths, const double *depth, double *displacement,
                                     char *message, size_t len);

/* Stresses in a half-space.
 *   nx, ny                in   cells along x and y; cell (i, j) is cell i + nx*j
 *   spacing_x, spacing_y  in   > 0; length
 *   force                 in   nx*ny; of the cells, compression positive, of any sign
 *   boundary              in   FUGE_FREE, FUGE_PERIODIC, or FUGE_PERIODIC_X, FUGE_PERIODIC_Y: the
 *                              mean along that direction is then in plane strain
 *   poisson               in   of the body, in (-1, 0.5]
 *   stress                out  xx, yy, zz, yz, xz, xy of cell i at depth k at
 *                              stress + 6*(i + nx*ny*k); force per length^2
 * Other arguments and errors as above; also FUGE_ERR_MODULUS for poisson. */
int fuge_halfspace_stress_grid(int nx, int ny, double spacing_x, double spacing_y,
                               const double *force, int boundary, double poisson, int depths,
                               const double *depth, double *stress, char *message, size_t len);

/* Displacements in a half-space.
 *   young         in   of the body, > 0, INFINITY for a rigid one
 *   displacement  out  along x, y, z of cell i at depth k at displacement + 3*(i + nx*ny*k)
 * With FUGE_PERIODIC_X and _Y the datum is that of fuge_operator_halfspace.
 * Other arguments and errors as above. */
int fuge_halfspace_displacement_grid(int nx, int ny, double spacing_x, double spacing_y,
                                     const double *force, int boundary, double young,
                                     double poisson, int depths, const double *depth,
                                     double *displacement, char *message, size_t len);

/* ---- stresses in layers ---------------------------------------------------
 *
 * In a body of layers (fuge_layers.h, whose arguments layers .. bonded come first), below the
 * centres of the cells of a grid: in the body that these describe, not in the other one.  Other
 * arguments and errors are those of the sections above, without the moduli of one body.
 *   below   in   depths, or NULL for all 0.  At an interface, 0: just above it, otherwise just
 *                below it.  Stresses along the surface differ on the two sides and, where layers
 *                slide, so do displacements along it
 * With FUGE_PERIODIC the mean pressure gives the half-space below the layers no stress along the
 * surface, and the layers the same strain as it has.  On a rigid base layers have no strain along
 * the surface, and those that slide on it no resultant force along it: both are the limit of long
 * waves in one direction.  Displacements count from the mean at each depth, on a rigid base from
 * the base, as those of the operator.  FUGE_ERR_GRID also for a depth in a rigid base,
 * FUGE_ERR_ELEMENT for FUGE_HAT; other errors of the layers as in fuge_layers.h. */

int fuge_layered_halfplane_stress_grid(int layers, const double *thickness, const double *young,
                                       const double *poisson, int bonded, int n, double spacing,
                                       const double *force, int element, int boundary,
                                       int depths, const double *depth, const int *below,
                                       double *stress, char *message, size_t len);

int fuge_layered_halfplane_displacement_grid(int layers, const double *thickness,
                                             const double *young, const double *poisson,
                                             int bonded, int n, double spacing,
                                             const double *force, int element, int boundary,
                                             int depths, const double *depth, const int *below,
                                             double *displacement, char *message, size_t len);

int fuge_layered_halfspace_stress_grid(int layers, const double *thickness, const double *young,
                                       const double *poisson, int bonded, int nx, int ny,
                                       double spacing_x, double spacing_y, const double *force,
                                       int boundary, int depths, const double *depth,
                                       const int *below, double *stress, char *message,
                                       size_t len);

int fuge_layered_halfspace_displacement_grid(int layers, const double *thickness,
                                             const double *young, const double *poisson,
                                             int bonded, int nx, int ny, double spacing_x,
                                             double spacing_y, const double *force, int boundary,
                                             int depths, const double *depth, const int *below,
                                             double *displacement, char *message, size_t len);

/* The same at points, below any strips or rectangles.
 *   x, width .. points, px, pz  in  as in fuge_halfplane_stress and fuge_halfspace_stress
 *   below                       in  points, or NULL: as above
 * In plane strain the datum along z is that of fuge_layered_halfplane_matrix; on an area
 * displacements vanish far away.  The time grows with points times cells: on grids the functions
 * above are faster. */
int fuge_layered_halfplane_stress(int layers, const double *thickness, const double *young,
                                  const double *poisson, int bonded, int n, const double *x,
                                  const double *width, const double *force, int element,
                                  int symmetric, int points, const double *px, const double *pz,
                                  const int *below, double *stress, char *message, size_t len);

int fuge_layered_halfplane_displacement(int layers, const double *thickness, const double *young,
                                        const double *poisson, int bonded, int n,
                                        const double *x, const double *width,
                                        const double *force, int element, int symmetric,
                                        int points, const double *px, const double *pz,
                                        const int *below, double *displacement, char *message,
                                        size_t len);

int fuge_layered_halfspace_stress(int layers, const double *thickness, const double *young,
                                  const double *poisson, int bonded, int n, const double *x,
                                  const double *y, const double *width_x, const double *width_y,
                                  const double *force, int symmetric_x, int symmetric_y,
                                  int points, const double *px, const double *py,
                                  const double *pz, const int *below, double *stress,
                                  char *message, size_t len);

int fuge_layered_halfspace_displacement(int layers, const double *thickness, const double *young,
                                        const double *poisson, int bonded, int n,
                                        const double *x, const double *y, const double *width_x,
                                        const double *width_y, const double *force,
                                        int symmetric_x, int symmetric_y, int points,
                                        const double *px, const double *py, const double *pz,
                                        const int *below, double *displacement, char *message,
                                        size_t len);

/* The largest von Mises or Tresca stress in a body of layers. */
typedef struct fuge_layer_peak {
  double value;                 /* force per length^2; 0, as depth and tensor, without forces */
  double depth;                 /* length */
  double tensor[6];             /* xx, yy, zz, yz, xz, xy there */
  int layer;                    /* 0 is the top layer, the last number the substrate; layers that
                                   are bonded to the same material are one with it */
  int cell;                     /* the cell above */
} fuge_layer_peak;

/* That below the centres of the cells of a grid: of all layers, both sides of their interfaces,
 * the surface, and all depths from a quarter of a cell on.
 *   measure  in   FUGE_MEASURE_VON_MISES or FUGE_MEASURE_TRESCA
 *   peak     out
 * Where the pressure grows towards the edge of a flat punch it is that of the grid.
 * FUGE_ERR_OPTION for measure; FUGE_ERR_OVERFLOW if no stress is finite. */
int fuge_layered_halfplane_peak(int layers, const double *thickness, const double *young,
                                const double *poisson, int bonded, int n, double spacing,
                                const double *force, int element, int boundary, int measure,
                                fuge_layer_peak *peak, char *message, size_t len);

int fuge_layered_halfspace_peak(int layers, const double *thickness, const double *young,
                                const double *poisson, int bonded, int nx, int ny,
                                double spacing_x, double spacing_y, const double *force,
                                int boundary, int measure, fuge_layer_peak *peak,
                                char *message, size_t len);

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

/* Those of the surface and of all interfaces below a grid.
 *   interfaces   out  their number, at most layers: layers that are bonded to the same material
 *                     are one with it
 *   peaks        out  interfaces + 1, room for layers + 1: the surface, then from above
 * At the surface stresses jump from cell to cell at the edge of the contact, and their error is
 * of the order of a cell. */
int fuge_layered_halfplane_interfaces(int layers, const double *thickness, const double *young,
                                      const double *poisson, int bonded, int n, double spacing,
                                      const double *force, int element, int boundary,
                                      int *interfaces, fuge_interface_stress *peaks,
                                      char *message, size_t len);

int fuge_layered_halfspace_interfaces(int layers, const double *thickness, const double *young,
                                      const double *poisson, int bonded, int nx, int ny,
                                      double spacing_x, double spacing_y, const double *force,
                                      int boundary, int *interfaces,
                                      fuge_interface_stress *peaks, char *message, size_t len);

/* ---- stresses of round bodies -------------------------------------------- */

/* Stresses in a half-space under forces on rings about one axis, to rounding at any depth and
 * distance.
 *   n        in   rings
 *   radius   in   n + 1, as in fuge_ring_matrix
 *   force    in   n; the resultants of uniform pressures, compression positive, of any sign: those
 *                 of fuge_get_force.  Rings without force cost nothing
 *   poisson  in   Poisson's ratio of the body, in (-1, 0.5]
 *   points   in   >= 0
 *   pr, pz   in   points; >= 0 from the axis, and >= 0 into the body; length
 *   stress   out  4 for each point: rr, tt (around the axis), zz, rz of point k at stress + 4*k;
 *                 force per length^2, tension positive; it may not overlap another array
 * At z = 0 they are the limits from inside.  At an edge of a ring, where zz jumps by the
 * pressure, they are the means from both sides, although rz straight below it tends to
 * pressure/pi or, at the outer edge, to -pressure/pi.
 * Errors of fuge_ring_matrix; FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_WIDTH also for
 * pr < 0, FUGE_ERR_GRID for pz < 0, FUGE_ERR_MODULUS for poisson, FUGE_ERR_OVERFLOW for a
 * point beyond 1e60 radii, FUGE_ERR_MEMORY. */
int fuge_ring_stress(int n, const double *radius, const double *force, double poisson, int points,
                     const double *pr, const double *pz, double *stress, char *message,
                     size_t len);

/* Displacements in a half-space under forces on rings; fuge_ring_displacement has those of the
 * surface alone.
 *   young, poisson  in   of the body; a rigid one (young INFINITY) does not move
 *   displacement    out  2 for each point: away from the axis and into the body; length
 * They vanish far away.  Other arguments and errors as above; FUGE_ERR_MODULUS also for young,
 * FUGE_ERR_OVERFLOW for displacements out of range. */
int fuge_ring_interior_displacement(int n, const double *radius, const double *force,
                                    double young, double poisson, int points, const double *pr,
                                    const double *pz, double *displacement, char *message,
                                    size_t len);

/* Stresses and displacements in a half-space under a round punch, to rounding, with the arguments
 * of fuge_ring_stress and fuge_ring_interior_displacement.
 *   contact  in  of fuge_solve_round_punch or fuge_solve_round_powers.  Without load there are
 *                none
 * In the tip of a cone, where the pressure is infinite, the stress zz is -DBL_MAX, and rr and tt
 * are (1 + 2 poisson)/2 times it. */
int fuge_round_stress(const fuge_round *contact, double poisson, int points, const double *pr,
                      const double *pz, double *stress, char *message, size_t len);

int fuge_round_displacement(const fuge_round *contact, double young, double poisson, int points,
                            const double *pr, const double *pz, double *displacement,
                            char *message, size_t len);

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

/* ---- largest stresses ----------------------------------------------------
 *
 * The largest von Mises or Tresca stress under a contact and where it is, by a search from
 * candidates at all depths below all parts of the contact: value and place of the field that
 * these forces have, the value to 1e-10 or better and the place to its root.
 *
 * Uniform pressure jumps from cell to cell, and close to the surface the stresses follow the cells
 * rather than the contact.  On strips, rectangles and rings the search therefore takes the middles
 * of cells at the surface, beside rectangles and rings also those of equal cells next to them, and
 * below the surface depths from a quarter of the (lesser) width of a cell on: what may lie between
 * is not resolved by the cells.  Under hats, smooth and round punches it takes all depths.
 *
 * Where the pressure of the contact is infinite so is the stress, and any number found would be one
 * of the grid: then location is FUGE_PEAK_SINGULAR, value +infinity, place that edge or tip and
 * tensor NaN.  Cells tell it from the forces of up to seven cells at an edge, which grow towards it
 * as under a flat punch (on rectangles in three rows side by side); edges of very small pieces of
 * contact are not judged.  Tips of round punches and edges within their contact are singular unless
 * Poisson's ratio is 0.5. */

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
  int reserved_int[7];
  double value;                 /* force per length^2; +infinity if singular */
  double place[3];              /* x, y, z, length; y is 0 in a plane; about an axis it is radius,
                                   0, z */
  double tensor[6];             /* xx, yy, zz, yz, xz, xy there; about an axis x is the radius */
  double reserved[6];
} fuge_stress_peak;

/* Under the forces of cells on a half-plane: n .. element and symmetric as in
 * fuge_halfplane_stress, plane_state and poisson of the body as in fuge_halfplane_tensor.  In a
 * symmetric model the peak is at x >= 0.  *peak is untouched if there is an error.
 * FUGE_ERR_OPTION for plane_state or measure, FUGE_ERR_MODULUS for poisson, otherwise those of
 * fuge_halfplane_stress. */
int fuge_halfplane_peak(int n, const double *x, const double *width, const double *force,
                        int element, int plane_state, double poisson, int symmetric, int measure,
                        fuge_stress_peak *peak, char *message, size_t len);

/* Under a smooth punch, the value to rounding. */
int fuge_smooth_peak(const fuge_smooth *contact, int plane_state, double poisson, int measure,
                     fuge_stress_peak *peak, char *message, size_t len);

/* Under the forces of rectangles on a half-space, arguments and errors as for
 * fuge_halfspace_stress; FUGE_ERR_OPTION for measure.  In a symmetric model the peak is at x >= 0,
 * or y >= 0. */
int fuge_halfspace_peak(int n, const double *x, const double *y, const double *width_x,
                        const double *width_y, const double *force, double poisson,
                        int symmetric_x, int symmetric_y, int measure, fuge_stress_peak *peak,
                        char *message, size_t len);

/* Under the forces of n rings between n + 1 radii, arguments and errors as for fuge_ring_stress;
 * FUGE_ERR_OPTION for measure. */
int fuge_ring_peak(int n, const double *radius, const double *force, double poisson, int measure,
                   fuge_stress_peak *peak, char *message, size_t len);

/* Under a round punch. */
int fuge_round_peak(const fuge_round *contact, double poisson, int measure, fuge_stress_peak *peak,
                    char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
