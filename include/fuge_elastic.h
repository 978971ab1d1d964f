/* fuge - what all elastic bodies share: moduli, cells, fields inside.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_ELASTIC_H
#define FUGE_ELASTIC_H

#include <stddef.h>
#include "fuge_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- two bodies --------------------------------------------------------- */

enum {                          /* plane_state, of a body */
  FUGE_PLANE_STRAIN = 0,        /* long bodies, no strain out of the plane */
  FUGE_PLANE_STRESS = 1         /* thin bodies, no stress out of the plane */
};

/* Modulus of one body's surface; INFINITY for a rigid body: E/(1-nu^2) in plane
 * strain, E in plane stress.
 *   young    in   E > 0; force per length^2
 *   poisson  in   nu, above -1 and at most 0.5
 *   modulus  out  force per length^2
 * FUGE_ERR_MODULUS for E or nu out of range: with such a nu the shear or the bulk
 * modulus is not positive.  FUGE_ERR_OPTION for another plane_state. */
int fuge_plane_modulus(double young, double poisson, int plane_state, double *modulus,
                       char *message, size_t len);

/* Combined modulus of two bodies, 1/e_star = 1/e1 + 1/e2: the e_star of the half-plane.
 * One of e1 and e2 may be INFINITY; FUGE_ERR_MODULUS if both are. */
int fuge_combined_modulus(double e1, double e2, double *e_star, char *message, size_t len);

/* Shares of bodies 1 and 2 in the displacement alpha f: e_star/e1 and e_star/e2, whose
 * sum is 1. */
int fuge_displacement_shares(double e1, double e2, double *share1, double *share2,
                             char *message, size_t len);

/* ---- cells -------------------------------------------------------------- */

enum {                          /* element: what a force and a displacement stand for */
  FUGE_CENTRE = 0,              /* uniform pressure f/width on a cell, displacement at its centre */
  FUGE_MEAN = 1,                /* the same pressure, mean displacement of a cell: any widths */
  FUGE_HAT = 2                  /* pressure with peak f/width at x, falling linearly to zero at
                                   x - width and x + width, displacement at x */
};

enum {                          /* boundary: what lies beyond the cells */
  FUGE_FREE = 0,                /* a surface without pressure */
  FUGE_PERIODIC = 1             /* the cells repeat periodically, with the period n*spacing */
};

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
 * depths.  In layers it takes the depths from a quarter of a cell on below the centres of the cells
 * of a grid, both sides of their interfaces, and the surface.
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
  double reserved[5];
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
 * Scalars of stresses, point by point; each result may be NULL.
 *   tensor     in   6 x points: xx, yy, zz, yz, xz, xy
 *   principal  out  3 x points, principal stresses, the largest first; to rounding of the largest
 *   von_mises  out  points, sqrt(3 J_2)
 *   tresca     out  points, the largest principal stress minus the smallest one, which is twice
 *                   the largest shear stress
 *   mean       out  points, (xx + yy + zz)/3
 * In simple tension both von_mises and tresca are the stress, and a large hydrostatic stress costs
 * them no digits.  Results have the unit of the stress; they are NaN where a component is NaN or
 * infinite.  They may not overlap the tensor.  FUGE_ERR_POINTER, FUGE_ERR_SIZE. */
int fuge_measure_stresses(int points, const double *tensor, double *principal, double *von_mises,
                          double *tresca, double *mean, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
