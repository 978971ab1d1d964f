/* fuge - frictionless elastic contact.  SPDX-License-Identifier: BSD-3-Clause
 *
 * THE PROBLEM.  n candidate points of two elastic bodies, pressed together by a
 * load F_0 >= 0.  Given the influence matrix alpha (displacement into the body
 * per contact force), the initial gaps g and F_0, find forces f, gaps c and the
 * rigid approach v_0 with
 *
 *     c = g + alpha f - v_0                      gaps
 *     c >= 0,  f >= 0,  f_k c_k = 0              contact, no adhesion
 *     f_1 + .. + f_n = F_0                       equilibrium
 *
 * (Fischer, Hoyer, Melosh, equations 9 to 11).  alpha is symmetric and positive
 * definite on the forces with zero sum; for F_0 > 0 the answer is then unique, for
 * F_0 = 0 v_0 is the largest possible, min g.  g may have any datum: it moves v_0
 * only.  Units are yours, as long as they agree:
 * length for gaps and v_0, force for f and F_0, length per force for alpha.
 *
 * In general there are m rigid motions q, such as a translation and a tilt, or those of
 * several bodies; column j of R (n x m) says how far each point closes per unit of q_j:
 *
 *     c = g + alpha f - R q                      gaps
 *     0 <= c <= d                                play d >= 0 between two stops,
 *     f >= 0 where c = 0,  f <= 0 where c = d,   d infinite: one-sided, as above
 *     f = 0 between                              d = 0: tied, c = 0 and f of either sign
 *     (R^T f)_j = w_j  or  q_j given             each motion free under its resultant
 *                                                w_j, or prescribed
 *
 * and points may be excluded: no force, any gap.  The paper's problem is R = 1, q = v_0,
 * w = F_0.  alpha has to be positive definite on the forces with R^T f = 0 in the free
 * motions.  The forces are then unique; a free motion that no contact holds (w = 0, or a
 * body about to tip) is not: any of those possible is given, with FUGE_WARN_NOT_UNIQUE.
 * General problems need a dense operator, for the active set or the tableau; the
 * iteration takes the plain problem and a prescribed translation.
 *
 * CONVENTIONS.  Matrices are column-major: alpha(i,k) is alpha[i + k*lda], i, k
 * from 0.  Points in messages count from 1.  Every int function returns a status:
 * 0 done, > 0 done with a warning, < 0 an error that left all outputs untouched
 * (fuge_status_text says what each means).  Nothing is printed, nothing aborts,
 * there is no global state.  NULL where it is not allowed gives FUGE_ERR_POINTER.
 *
 * THREADS.  Calls in different threads at once are safe if no two of them have the same
 * solver or body, be it only to read results.  An operator may be shared by the solvers
 * of several threads, unless one makes, changes or frees it meanwhile; it and its matrix
 * are only read.
 *
 * CALL ORDER.  Either fuge_solve_dense alone, or
 *     fuge_operator_dense, _halfplane or _callback -> fuge_solver_new
 *     -> fuge_set_gap, and fuge_set_load or another of the section "problem"
 *     -> fuge_solve -> fuge_get_... -> (set, solve, get again)
 *     -> fuge_solver_free -> fuge_operator_free
 */
#ifndef FUGE_H
#define FUGE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FUGE_VERSION "0.1.0"

/* ---- status ------------------------------------------------------------- */

enum {
  FUGE_DONE = 0,                   /* done */
  FUGE_WARN_RESIDUAL = 1,          /* done, but the residual is above the tolerance */
  FUGE_WARN_NOT_UNIQUE = 2,        /* done, but the solution is not unique: either the forces
                                      (alpha singular on the contact), or a motion that the
                                      contact does not resist */
  FUGE_ERR_SIZE = -1,              /* a size or an index is invalid, or arrays differ in length:
                                      n < 1, lda < n, a range beyond the last entry */
  FUGE_ERR_POINTER = -2,           /* a required pointer is NULL, or an array is not contiguous */
  FUGE_ERR_NOT_FINITE = -3,        /* an input is NaN or infinite */
  FUGE_ERR_WIDTH = -4,             /* a width or a position is out of range: cell width <= 0;
                                      x < 0 in a symmetric model; x of a profile does not
                                      increase, or a point lies outside it */
  FUGE_ERR_MODULUS = -5,           /* an elastic modulus or Poisson's ratio is out of range */
  FUGE_ERR_ELEMENT = -6,           /* unknown element */
  FUGE_ERR_GRID = -7,              /* the grid is not uniform, as this element or call requires */
  FUGE_ERR_NOT_SYMMETRIC = -8,     /* the influence or stiffness matrix is not symmetric:
                                      asymmetry above 1e-10 of the range of alpha */
  FUGE_ERR_NOT_DEFINITE = -9,      /* the influence or stiffness matrix is not positive definite:
                                      for alpha, on the forces without resultant */
  FUGE_ERR_NO_EQUILIBRIUM = -10,   /* no contact forces can be in equilibrium with this load:
                                      load < 0, or resultants that no contact forces carry */
  FUGE_ERR_ITERATION_LIMIT = -11,  /* the iteration limit was reached */
  FUGE_ERR_MEMORY = -12,           /* out of memory */
  FUGE_ERR_CALL_ORDER = -13,       /* a call came before another one that it requires */
  FUGE_ERR_OPTION = -14,           /* an option has an invalid value */
  FUGE_ERR_UNSUPPORTED = -15,      /* this engine or operator cannot solve this kind of problem */
  FUGE_ERR_OVERFLOW = -16,         /* magnitudes exceed the range of double precision */
  FUGE_ERR_CALLBACK = -17,         /* a callback failed or returned NaN or infinity */
  FUGE_ERR_CANCELLED = -18,        /* the progress monitor cancelled the solve */
  FUGE_ERR_FILE = -19,             /* a file cannot be read or written */
  FUGE_ERR_GAP = -20,              /* an upper stop lies below the lower one: gap_upper < 0 */
  FUGE_ERR_MODES = -21,            /* rigid modes depend on each other, or one moves no point */
  FUGE_ERR_DOF = -22               /* a degree of freedom is out of range or named twice */
};

/* Meaning of a status, as in the comments above; a constant string, never NULL. */
const char *fuge_status_text(int status);

/* Version of the library that is linked; compare with FUGE_VERSION. */
const char *fuge_version(void);

/* ---- options and report ------------------------------------------------- */

enum {                          /* fuge_options.method */
  FUGE_AUTO = 0,                /* for a matrix the active set, or the tableau if the history
                                   is kept; for any other operator the iteration */
  FUGE_TABLEAU = 1,             /* the paper's tableau, Phase I of the simplex method */
  FUGE_ACTIVE_SET = 2,          /* block principal pivoting: the fast one for a matrix */
  FUGE_ITERATIVE = 3            /* products only: the fast one for many points */
};

enum {                          /* fuge_options.pivot_rule, of the tableau */
  FUGE_PAPER_RULE = 0,          /* drive an artificial out, then lowest column number */
  FUGE_MOST_NEGATIVE = 1,       /* most negative entry of the last row */
  FUGE_GREATEST_DECREASE = 2    /* greatest decrease of the sum of artificials */
};

typedef struct fuge_options {
  int method;
  int pivot_rule;
  int max_iterations;           /* most pivots or contact sets, on all grids; 0: 50 for each row */
  int keep_history;             /* nonzero: fuge_get_history will have all steps */
  int reserved_int[4];
  double tolerance;             /* largest relative residual that counts as done */
  double reserved[7];
} fuge_options;

typedef struct fuge_info {
  int status;                   /* what fuge_solve returned */
  int iterations;               /* pivots of the tableau, else contact sets, on all grids */
  int contacts;                 /* points with a contact force */
  int products;                 /* products alpha f by the operator, those on coarser grids
                                   by their share, rounded up */
  int preconditionings;                  /* preconditioner applications, likewise */
  int reserved_int[3];
  double residual;              /* certificate: largest scaled violation of the problem */
  double reserved[7];
} fuge_info;

/* Fill *opt with the defaults. */
void fuge_default_options(fuge_options *opt);

/* ---- one call ----------------------------------------------------------- */

/* Solve with the default options.
 *   alpha     in   lda x n, the first n rows count; length per force
 *   gap       in   n, initial gaps (external load included); length
 *   load      in   F_0 >= 0; force.  0: no forces, the bodies just touch
 *   force     out  n; force        gap_out  out  n; length
 *   approach  out  v_0; length
 * Outputs may be the same array as gap. */
int fuge_solve_dense(int n, const double *alpha, int lda, const double *gap, double load,
                     double *force, double *gap_out, double *approach);

/* The status that fuge_solve_dense returns for these data, with its message: what is
 * wrong, where, and how to mend it.  Solves to find out.  At most len bytes go to
 * message, always ended by NUL. */
int fuge_check_dense(int n, const double *alpha, int lda, const double *gap, double load,
                     char *message, size_t len);

/* ---- two bodies --------------------------------------------------------- */

enum {                          /* state */
  FUGE_PLANE_STRAIN = 0,        /* long bodies, no strain out of the plane */
  FUGE_PLANE_STRESS = 1         /* thin bodies, no stress out of the plane */
};

/* A rigid body has the modulus INFINITY.  Messages as for fuge_check_dense; message may
 * be NULL. */

/* Modulus of one body's surface: E/(1-nu^2) in plane strain, E in plane stress.
 *   young    in   E > 0; force per length^2
 *   poisson  in   nu, above -1 and at most 0.5
 *   modulus  out  force per length^2
 * FUGE_ERR_MODULUS for E or nu out of range: with such a nu the shear or the bulk
 * modulus is not positive.  FUGE_ERR_OPTION for another state. */
int fuge_plane_modulus(double young, double poisson, int state, double *modulus,
                       char *message, size_t len);

/* Combined modulus of two bodies, 1/e_star = 1/e1 + 1/e2: the e_star of the half-plane.
 * One of e1 and e2 may be INFINITY; FUGE_ERR_MODULUS if both are. */
int fuge_combined_modulus(double e1, double e2, double *e_star, char *message, size_t len);

/* Parts of the displacement alpha f that bodies 1 and 2 take: e_star/e1 and e_star/e2,
 * of sum 1. */
int fuge_displacement_shares(double e1, double e2, double *share1, double *share2,
                             char *message, size_t len);

/* ---- profiles ----------------------------------------------------------- */

/* Read a profile from a text file: on each line x and z, separated by blanks, tabs, a
 * comma or a semicolon; x strictly increasing, 2 points or more.  Blank lines, comments
 * after # or ! and one line of words before the numbers are skipped.  Heights z are
 * positive upwards: the initial gap of two profiles is upper - lower.
 *   path      in   name of the file
 *   capacity  in   length of x and z; each may be NULL if not wanted
 *   x, z      out  in the unit of the file
 *   count     out  points in the file; only the first capacity are written
 *   message   out  at most len bytes, ended by NUL; may be NULL
 * FUGE_ERR_FILE: the message has the file, the line and the reason. */
int fuge_read_profile(const char *path, int capacity, double *x, double *z, int *count,
                      char *message, size_t len);

/* Heights of the profile x, z (n >= 2, x strictly increasing) by linear interpolation.
 *   centre  in   points, any order, within x[0] .. x[n-1]; length
 *   height  out  points; no array may overlap another
 * FUGE_ERR_WIDTH: a centre is outside, or x does not increase. */
int fuge_sample_profile(int n, const double *x, const double *z, int points, const double *centre,
                        double *height, char *message, size_t len);

enum {                          /* form */
  FUGE_LEVEL_MEAN = 0,          /* the mean height */
  FUGE_LEVEL_LINE = 1           /* the least-squares line */
};

/* Take the mean or the line off z (n >= 2), in place.  Points count by the length they
 * stand for. */
int fuge_level_profile(int n, const double *x, double *z, int form, char *message, size_t len);

/* ---- half-plane --------------------------------------------------------- */

enum {                          /* element: what a force and a displacement mean */
  FUGE_CENTRE = 0,              /* uniform pressure f/width on a cell, displacement at its centre */
  FUGE_MEAN = 1,                /* the same pressure, mean displacement of a cell: any widths */
  FUGE_HAT = 2                  /* pressure a hat with peak f/width at x and base 2 width,
                                   displacement at x */
};

/* Influence matrix of cells on an elastic half-plane.
 *   x, width  in   n; centres and widths of the cells; length
 *   e_star    in   E/(1-nu^2) in plane strain, E in plane stress; force per length^2
 *   alpha     out  lda x n; displacement per force per unit depth
 * The displacement by a line load is taken as zero at the distance D, twice the length
 * that the cells cover: all coefficients are positive.  FUGE_CENTRE and FUGE_HAT need
 * equal widths (FUGE_ERR_GRID otherwise). */
int fuge_halfplane_matrix(int n, const double *x, const double *width, double e_star,
                          int element, double *alpha, int lda);

/* The same, folded for a scene symmetric about x = 0: give the cells with x >= 0;
 * a force is the sum over a cell and its mirror image, the load is the whole one. */
int fuge_halfplane_symmetric_matrix(int n, const double *x, const double *width, double e_star,
                                    int element, double *alpha, int lda);

/* The checks of the two above (symmetric: 0 or 1) with a message, as fuge_check_dense. */
int fuge_check_halfplane(int n, const double *x, const double *width, double e_star,
                         int element, int symmetric, char *message, size_t len);

/* ---- edges of contact --------------------------------------------------- */

enum {                          /* what an edge is */
  FUGE_EDGE_REFINED = 0,        /* better than the grid; the others are the cell's edge because */
  FUGE_EDGE_FEW_CELLS = 1,      /* fewer than five cells are in contact */
  FUGE_EDGE_SINGULAR = 2,       /* the pressure does not fall like a square root, as under a corner */
  FUGE_EDGE_GRID_END = 3        /* contact reaches the last cell of the grid */
};

/* The intervals of contact on a half-plane and their edges, from the forces; for a
 * smooth gap to third order in the width; to second order with a small factor if there
 * are other contacts or the far edge is a corner.
 *   x, width    in   n; a uniform grid, ascending, all widths equal; length
 *   force       in   n; in contact where positive
 *   element     in   as for the matrix.  With FUGE_MEAN the gap has to be the mean over
 *                    a cell too: if it is the gap at the centre, say FUGE_HAT, whose
 *                    forces are the same
 *   symmetric   in   1: the folded scene, x[0] = 0 or width/2 if it starts on the axis;
 *                    an interval that touches the axis is given whole, left = -right,
 *                    of others the image at x > 0.  0: not folded
 *   capacity    in   length of the four arrays; each may be NULL if not wanted
 *   left, right out  the edges, from left to right; length
 *   left_kind, right_kind  out  FUGE_EDGE_...
 *   count       out  intervals that there are; only the first capacity are written
 *   message     out  at most len bytes, ended by NUL; may be NULL
 * FUGE_ERR_GRID if the grid is not uniform. */
int fuge_contact_edges(int n, const double *x, const double *width, const double *force,
                       int element, int symmetric, int capacity, double *left, double *right,
                       int *left_kind, int *right_kind, int *count, char *message, size_t len);

/* ---- operators ---------------------------------------------------------- */

typedef struct fuge_operator fuge_operator;

/* A dense matrix as operator.  alpha (lda x n) is not copied: keep it unchanged
 * until the operator is freed.  *op is set on success only. */
int fuge_operator_dense(int n, const double *alpha, int lda, fuge_operator **op);

/* A product u = A f by a function of yours.
 *   f     in   n forces       u  out  n displacements: every one, u is not zero before
 *   user  in   what fuge_operator_callback was given
 * Return 0; anything else, NaN or infinity in u ends the solve with FUGE_ERR_CALLBACK,
 * whose message has the number of the product and a positive value returned.  A must
 * be linear, symmetric and the same in all calls, else the answer is not certified.
 * The function may not free what calls it, nor leave by longjmp or an exception.
 * Solvers that run in several threads with one operator call it from all of them. */
typedef int (*fuge_apply)(int n, const double *f, double *u, void *user);

/* An operator that knows its products only.  user is passed on, never looked at: it
 * may be NULL.  *op is set on success only. */
int fuge_operator_callback(int n, fuge_apply apply, void *user, fuge_operator **op);

/* Optional, to need fewer products: an approximate inverse of A, from n lengths (f) to
 * n forces (u), linear, symmetric and positive definite; same rules and same user.
 * Only for callback operators (FUGE_ERR_UNSUPPORTED), and not during a solve.  The
 * last one set, preconditioner or diagonal, counts. */
int fuge_operator_set_preconditioner(fuge_operator *op, fuge_apply preconditioner);

/* The preconditioner 1/alpha_kk.  diagonal: n coefficients alpha_kk > 0, copied; length per force.
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_DEFINITE for one <= 0. */
int fuge_operator_set_diagonal(fuge_operator *op, const double *diagonal);
enum {                          /* boundary: what lies beyond the cells */
  FUGE_FREE = 0,                /* nothing: a free surface */
  FUGE_PERIODIC = 1             /* the same again and again, with the period n*spacing */
};

/* An elastic half-plane of n equal cells side by side, by FFT: products in O(n log n)
 * operations, O(n) memory.
 *   spacing   in   width of a cell; length
 *   e_star    in   as in fuge_halfplane_matrix
 *   element   in   FUGE_CENTRE, FUGE_MEAN or FUGE_HAT (the last two are the same here)
 *   boundary  in   FUGE_FREE: the matrix of fuge_halfplane_matrix;
 *                  FUGE_PERIODIC: displacements count from the mean of the surface
 * *op is set on success only.  n is limited by memory (FUGE_FREE: 64 n bytes while it is made,
 * 32 n in a product; FUGE_PERIODIC half of it), and for FUGE_FREE to nearly 2^30 by FFTW. */
int fuge_operator_halfplane(int n, double spacing, double e_star, int element, int boundary,
                            fuge_operator **op);

/* The status that fuge_operator_halfplane returns for these data, with its message, as
 * fuge_check_dense.  Makes the operator to find out. */
int fuge_check_operator_halfplane(int n, double spacing, double e_star, int element, int boundary,
                                  char *message, size_t len);

/* Free and set *op to NULL; NULL and *op == NULL are fine.  Free its solvers first. */
void fuge_operator_free(fuge_operator **op);

/* ---- solver ------------------------------------------------------------- */

typedef struct fuge_solver fuge_solver;

/* opt may be NULL for the defaults.  *s is set on success only; op must outlive it. */
int fuge_solver_new(const fuge_operator *op, const fuge_options *opt, fuge_solver **s);

/* Free and set *s to NULL; NULL and *s == NULL are fine. */
void fuge_solver_free(fuge_solver **s);

/* Progress of a solve, called once in each iteration.
 *   iteration  grows from call to call, from 1 in each solve
 *   residual   >= 0, no unit: how far it still is.  Tableau: z relative to its start;
 *              other engines: the largest scaled violation.  It need not fall steadily
 *   contacts   points taken for touching
 * Nonzero cancels: fuge_solve returns FUGE_ERR_CANCELLED without an answer, and can be
 * called again.  Do not call functions with this solver from inside. */
typedef int (*fuge_progress)(int iteration, double residual, int contacts, void *user);

/* Call progress from now on, with user; NULL for none.  fuge_reset leaves it. A solve
 * with zero load has no iterations.  After the pivots of the tableau come the
 * contact sets of its final solve. */
int fuge_set_progress(fuge_solver *s, fuge_progress progress, void *user);

/* Solve; FUGE_ERR_CALL_ORDER before gaps and motions are set.  The active set starts
 * from the contact set of the last solve, the iteration from its forces if the load is
 * within a quarter of the last one. */
int fuge_solve(fuge_solver *s);

/* Forget results, contact set and history: the next fuge_solve starts from scratch.
 * Operator, options and problem stay. */
int fuge_reset(fuge_solver *s);

/* ---- problem ------------------------------------------------------------ */

/* Three parts, each set on its own and in any order; the others stay:
 *     gaps        fuge_set_gap
 *     exclusions  fuge_set_excluded; none at first
 *     motions     fuge_set_load, fuge_set_approach or fuge_set_modes, each of which
 *                 replaces all motions; then fuge_set_motion and fuge_set_resultant
 *                 change one.  At first there is one translation, neither free nor given
 * All arrays are copied.  Success makes earlier results unavailable; an error changes
 * nothing.  What the parts say together is checked by fuge_solve:
 * FUGE_ERR_NO_EQUILIBRIUM, whose message says why, and FUGE_ERR_MODES.  Modes in
 * messages count from 1. */

/* Initial gaps.
 *   gap        in  n; length
 *   gap_upper  in  n, play d between the two stops; length.  HUGE_VAL: one-sided,
 *                  0: tied.  NULL: one-sided everywhere.  FUGE_ERR_GAP if negative */
int fuge_set_gap(fuge_solver *s, const double *gap, const double *gap_upper);

/* Points that take no part, where excluded (n) is not zero; NULL for none.  Their gaps
 * are computed all the same. */
int fuge_set_excluded(fuge_solver *s, const int *excluded);

/* One translation, free under the load F_0 >= 0; force.  With fuge_set_gap(s, gap, NULL)
 * and fuge_set_excluded(s, NULL) this is the plain problem again.  A load that pulls on
 * two-sided points: fuge_set_resultant(s, 0, load). */
int fuge_set_load(fuge_solver *s, double load);

/* One translation, prescribed; length.  The load is a result: fuge_get_resultant. */
int fuge_set_approach(fuge_solver *s, double approach);

/* m rigid motions, all free.
 *   m          in  0 .. n.  0: none, c = g + alpha f
 *   modes      in  R, n x m, column-major; length per unit of the motion
 *   resultant  in  w, m; force times length per unit of the motion.  Both may be NULL
 *                  if m = 0
 * FUGE_ERR_SIZE for m < 0, FUGE_ERR_MODES for m > n. */
int fuge_set_modes(fuge_solver *s, int m, const double *modes, const double *resultant);

/* Prescribe motion mode, 0 .. m-1 (else FUGE_ERR_SIZE), or change its value. */
int fuge_set_motion(fuge_solver *s, int mode, double value);

/* Free motion mode under a resultant of either sign, or change that. */
int fuge_set_resultant(fuge_solver *s, int mode, double resultant);

/* Number m of motions of the problem, free and prescribed; at any time. */
int fuge_get_mode_count(const fuge_solver *s, int *m);

/* ---- load path ---------------------------------------------------------- */

/* The exact course of the contact as the load grows from 0 to load, without load
 * steps: every load at which a point joins or leaves.  Points that change at the same
 * load have an entry each.
 *   op         in   a dense operator, n points
 *   gap        in   n; length             load  in  >= 0; force
 *   capacity   in   length of the five arrays; each may be NULL if not wanted
 *   loads      out  load at the event, ascending; the first ones are 0
 *   approach   out  v_0 there; length
 *   stiffness  out  dF_0/dv_0 from there to the next event; force per length
 *   point      out  the point, from 1; negative: it leaves
 *   contacts   out  points in contact from there on
 *   events     out  how many there are; only the first capacity are written
 *   message    out  at most len bytes, ended by NUL; may be NULL */
int fuge_load_path(const fuge_operator *op, const double *gap, double load, int capacity,
                   double *loads, double *approach, double *stiffness, int *point, int *contacts,
                   int *events, char *message, size_t len);

enum {                          /* state of a contact point */
  FUGE_AT_LOWER_STOP = 1,       /* gap 0, force >= 0; of either sign if tied */
  FUGE_OPEN = 0,                /* between the stops, no force */
  FUGE_AT_UPPER_STOP = -1       /* gap = play, force <= 0 */
};

/* The same between two general problems: from that of the solver, in equilibrium, to one
 * with other resultants and prescribed motions, all changing linearly with a parameter
 * from 0 to 1.  No fuge_solve is needed, and what one found stays.
 *   finish     in   m; resultants at the end, where prescribed the motions
 *   capacity   in   entries that the six arrays have room for; each may be NULL if not wanted
 *   parameter  out  ascending; the first entry is the start, 0, the others are the events
 *                   before 1
 *   motion     out  m for each entry: q there, entry k at motion + k*m; after the jump if
 *                   q jumps, which it may where nothing holds it
 *   rate       out  m for each entry: dq/d(parameter) from there to the next one
 *   point      out  the point that changes, from 1; 0 for the start
 *   side       out  its new state: FUGE_AT_LOWER_STOP, FUGE_OPEN or FUGE_AT_UPPER_STOP
 *   contacts   out  points at a stop from there on
 *   entries    out  how many there are; only the first capacity are written
 * Points that change together have an entry each; motion, rate and contacts are then
 * those after all of them.  FUGE_ERR_NO_EQUILIBRIUM if equilibrium ends on the way: the
 * message has the parameter; choose an end before it. */
int fuge_follow_path(const fuge_solver *s, const double *finish, int capacity, double *parameter,
                     double *motion, double *rate, int *point, int *side, int *contacts, int *entries,
                     char *message, size_t len);

/* ---- results ------------------------------------------------------------ */

/* Each gives FUGE_ERR_CALL_ORDER unless the last fuge_solve gave an answer for
 * the present problem.  m is that of fuge_get_mode_count: 1 without fuge_set_modes. */
int fuge_get_force(const fuge_solver *s, double *force);        /* n; force */
int fuge_get_gap(const fuge_solver *s, double *gap);            /* n; length */
int fuge_get_motion(const fuge_solver *s, double *q);            /* m: v_0; length, if m = 1 */
int fuge_get_resultant(const fuge_solver *s, double *w);        /* m: R^T f, the sum of the forces
                                                                   for a translation */

/* Derivative of the last solution in a direction, exact as long as the contact set
 * stays: changes of force and gap (n) and v_0 (1) for a change of the gaps (n; NULL
 * for none) and of the load.  gap and rigid may be NULL.  The contact stiffness is
 * 1/rigid for gap_change NULL and load_change 1; a unit gap_change at k gives column k
 * of the sensitivity to the gaps.  Two triangular solves each.  FUGE_ERR_CALL_ORDER
 * also after a solve with zero load; FUGE_ERR_SIZE unless there is one motion. */
int fuge_get_derivative(const fuge_solver *s, const double *gap_change, double load_change,
                        double *force, double *gap, double *rigid);

/* The same for m motions: load_change (m; NULL for none) are the changes of the
 * resultants of free motions and of the values of prescribed ones, rigid the changes of
 * all motions (m). */
int fuge_get_derivatives(const fuge_solver *s, const double *gap_change, const double *load_change,
                         double *force, double *gap, double *rigid);

/* Report of the last fuge_solve, failed or not. */
int fuge_get_info(const fuge_solver *s, fuge_info *info);

/* Course of the pivots (options.keep_history).  Steps first .. first+count-1;
 * step 0 is the artificial start.
 *   basis      out  count rows of n+m column numbers, row k at basis + k*(n+m):
 *                   1..n forces, n+1..2n gaps, then m free motions (v_0: 2n+1, m = 1),
 *                   then artificials.  The same basis twice: a gap went from one stop
 *                   to the other
 *   z          out  count; sum of the artificial variables in your units
 *   available  out  steps that there are
 * count = 0 only asks for available; basis and z may then be NULL. A solve with
 * zero load needs no pivots and keeps no steps. */
int fuge_get_history(const fuge_solver *s, int first, int count, int *basis, double *z,
                     int *available);

/* Message of the last call on s that set or solved, or of a getter that failed:
 * what, where, how to mend it; empty when all was well.  At most len bytes, always
 * ended by NUL. */
int fuge_solver_message(const fuge_solver *s, char *buf, size_t len);

#ifdef __cplusplus
}
#endif

#include "fuge_fe.h"
#include "fuge_smooth.h"

#endif
