/* fuge - problems, operators and solvers.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_CORE_H
#define FUGE_CORE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FUGE_VERSION "0.1.0"

enum {
  FUGE_MESSAGE_LENGTH = 256     /* characters of the longest message */
};

/* ---- status ------------------------------------------------------------- */

enum {
  FUGE_DONE = 0,                   /* done */
  FUGE_WARN_RESIDUAL = 1,          /* done, but the residual is above the tolerance */
  FUGE_WARN_NOT_UNIQUE = 2,        /* done, but the solution is not unique: either the forces
                                      (alpha singular on the points that touch), or a motion
                                      that the contact does not resist, or both */
  FUGE_WARN_ILL_CONDITIONED = 3,   /* done, but the forces may be far off: the equations hold, but
                                      info.force_error is above 1e-3 */
  FUGE_WARN_PAIRS = 4,             /* done, but pairs share a node */
  FUGE_WARN_NO_CONTACT = 5,        /* done, but no point touches and all gaps open */
  FUGE_WARN_CASES = 6,             /* done, but some load cases failed or have a warning */
  FUGE_WARN_NOT_PROVED = 7,        /* done, but the solution is not proved */
  FUGE_WARN_KINK = 8,              /* done, but at a kink: the gradient is that of one side */
  FUGE_WARN_UNREACHABLE = 9,       /* done, but for other forces: those wanted are not possible */
  FUGE_WARN_ACCURACY = 10,         /* done, but less exactly than wanted */
  FUGE_ERR_SIZE = -1,              /* a size or an index is invalid, or arrays differ in length:
                                      n < 1, lda < n, a range beyond the last entry */
  FUGE_ERR_POINTER = -2,           /* a required pointer is NULL, or an array is not contiguous */
  FUGE_ERR_NOT_FINITE = -3,        /* an input is NaN or infinite */
  FUGE_ERR_WIDTH = -4,             /* a width or a position is out of range: cell width <= 0;
                                      cells overlap; x < 0 in a symmetric model; x of a profile
                                      does not increase, or a point lies outside it */
  FUGE_ERR_MODULUS = -5,           /* an elastic modulus or Poisson's ratio is out of range */
  FUGE_ERR_ELEMENT = -6,           /* unknown element */
  FUGE_ERR_GRID = -7,              /* the grid is not uniform, as this element or call requires */
  FUGE_ERR_NOT_SYMMETRIC = -8,     /* the influence or stiffness matrix is not symmetric:
                                      asymmetry above 1e-10 of the range of alpha.  Only
                                      symmetric problems are contact */
  FUGE_ERR_NOT_DEFINITE = -9,      /* the influence or stiffness matrix is not positive definite:
                                      for alpha, on the forces without resultant */
  FUGE_ERR_NO_EQUILIBRIUM = -10,   /* no contact forces can be in equilibrium with this load:
                                      load < 0, or resultants that no contact forces carry */
  FUGE_ERR_ITERATION_LIMIT = -11,  /* the iteration limit was reached */
  FUGE_ERR_MEMORY = -12,           /* out of memory */
  FUGE_ERR_CALL_ORDER = -13,       /* a call came before another one that it requires */
  FUGE_ERR_OPTION = -14,           /* an option has an invalid value */
  FUGE_ERR_UNSUPPORTED = -15,      /* this engine or operator cannot solve this kind of problem */
  FUGE_ERR_OVERFLOW = -16,         /* numbers are too large or too small for double precision */
  FUGE_ERR_CALLBACK = -17,         /* a callback failed or returned NaN or infinity */
  FUGE_ERR_CANCELLED = -18,        /* the progress monitor cancelled the solve */
  FUGE_ERR_FILE = -19,             /* a file cannot be read or written */
  FUGE_ERR_GAP = -20,              /* an upper stop lies below the lower one: gap_upper < 0 */
  FUGE_ERR_MODES = -21,            /* rigid modes depend on each other, or one moves no point */
  FUGE_ERR_DOF = -22,              /* a degree of freedom is out of range or named twice */
  FUGE_ERR_MESH = -23,             /* faces have no area, look the wrong way or not at each other */
  FUGE_ERR_LAW = -24               /* a compliance, a limit of a force or a stiffness is negative */
};

/* Meaning of a status, as in the comments above; a constant string, never NULL. */
const char *fuge_status_text(int status);

/* Version of the linked library; compare it with FUGE_VERSION. */
const char *fuge_version(void);

/* ---- options and report ------------------------------------------------- */

enum {                          /* fuge_options.method */
  FUGE_AUTO = 0,                /* for a matrix the active set, or the tableau if the history
                                   is kept; for any other operator the iteration */
  FUGE_TABLEAU = 1,             /* the paper's tableau, Phase I of the simplex method */
  FUGE_ACTIVE_SET = 2,          /* block principal pivoting: fastest for a matrix */
  FUGE_ITERATIVE = 3            /* products only: fastest for many points */
};

enum {                          /* fuge_options.pivot_rule, of the tableau */
  FUGE_PAPER_RULE = 0,          /* first an artificial variable leaves, then lowest column number */
  FUGE_MOST_NEGATIVE = 1,       /* most negative entry of the last row */
  FUGE_GREATEST_DECREASE = 2    /* greatest decrease of the sum of artificials */
};

typedef struct fuge_options {
  int method;
  int pivot_rule;
  int max_iterations;           /* limit of pivots or contact sets, on all grids;
                                   0: 50 for each row */
  int keep_history;             /* nonzero: keep all steps for fuge_get_history */
  int threads;                  /* that share the work of a solve and of its derivatives, 1 by
                                   default; 0: as many as the process may use cores.  No
                                   result depends on it */
  int reserved_int[3];
  double tolerance;             /* largest relative residual without a warning */
  double reserved[7];
} fuge_options;

typedef struct fuge_info {
  int status;                   /* what fuge_solve returned */
  int iterations;               /* pivots of the tableau, else contact sets, on all grids */
  int contacts;                 /* points with a contact force */
  int products;                 /* products alpha f by the operator; those on coarser grids
                                   count by their cost, rounded up */
  int preconditionings;         /* applications of a preconditioner, likewise */
  int reserved_int[3];
  double residual;              /* certificate: largest scaled violation of the problem */
  double force_error;           /* estimate of the largest error of a force relative to the
                                   largest force, for the data as stored; 1: no digit is
                                   known, as where the forces are not unique; 0 without forces */
  double energy;                /* elastic energy, half the sum of f (alpha + D) f and q S q; force
                                   times length */
  double reserved[5];
} fuge_info;

/* Set *opt to the defaults; zeros are not the defaults. */
void fuge_default_options(fuge_options *opt);

/* ---- one call ----------------------------------------------------------- */

/* Solve the paper's problem with the default options.
 *   alpha     in   lda x n, the first n rows count; length per force
 *   gap       in   n, initial gaps, including those that external loads cause; length
 *   load      in   F_0 >= 0; force.  0: no forces, the bodies just touch
 *   force     out  n; force        gap_out  out  n; length
 *   approach  out  v_0; length
 * force or gap_out may be the same array as gap.  Errors as for fuge_operator_dense and
 * fuge_solve. */
int fuge_solve_dense(int n, const double *alpha, int lda, const double *gap, double load,
                     double *force, double *gap_out, double *approach,
                     char *message, size_t len);

/* ---- operators ---------------------------------------------------------- */

typedef struct fuge_operator fuge_operator;

/* A dense matrix as operator.  alpha (lda x n, lda >= n) is not copied: keep it unchanged
 * until the operator is freed, and create a new operator after any change, because solvers
 * keep the factor of the matrix from solve to solve.  *op is set on success only.
 * FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_OVERFLOW. */
int fuge_operator_dense(int n, const double *alpha, int lda, fuge_operator **op,
                        char *message, size_t len);

/* The product u = A f, computed by the caller.
 *   f     in   n forces
 *   u     out  n displacements; set all of them, u is not zero on entry
 *   user  in   the pointer passed to fuge_operator_callback
 * Return 0.  Any other value, and NaN or infinity in u, end the solve with
 * FUGE_ERR_CALLBACK; the message has the number of the product, from 1, and the returned
 * value if it is positive.  A must be linear, symmetric and the same in all calls, or the
 * solution is not certified.  The function may neither free the operator and its solvers
 * nor leave by longjmp or an exception.  Solvers in several threads that share the
 * operator call it from all of them. */
typedef int (*fuge_apply)(int n, const double *f, double *u, void *user);

/* An operator by its products alone.  user is passed on to apply and may be NULL.  *op is
 * set on success only. */
int fuge_operator_callback(int n, fuge_apply apply, void *user, fuge_operator **op,
                           char *message, size_t len);

/* Optional, to need fewer products: an approximate inverse of A, from n lengths (f) to
 * n forces (u), linear, symmetric and positive definite; same rules and same user.
 * For callback operators only (FUGE_ERR_UNSUPPORTED), and not during a solve.  It
 * replaces an earlier preconditioner or diagonal. */
int fuge_operator_set_preconditioner(fuge_operator *op, fuge_apply preconditioner,
                                     char *message, size_t len);

/* The preconditioner 1/alpha_kk, likewise.  diagonal: n coefficients alpha_kk > 0, which
 * are copied; length per force.  FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_DEFINITE for one <= 0. */
int fuge_operator_set_diagonal(fuge_operator *op, const double *diagonal,
                               char *message, size_t len);

/* Points that are equal cells of a grid, for callback operators only and not during a solve:
 * with fuge_operator_set_auxiliary, or with a preconditioner and fuge_operator_set_coarser, a
 * callback operator needs as few products as the built-in operators of grids.  The solution is
 * that of apply alone, to the tolerance.
 *   nx, ny  in  cells in a row, and rows; point i + nx*j is the cell i of row j, from 0; ny = 1
 *               for cells side by side on a line
 * Another grid than before forgets what those calls have set.  FUGE_ERR_SIZE unless
 * nx*ny = n. */
int fuge_operator_set_grid(fuge_operator *op, int nx, int ny, char *message, size_t len);

/* The coarser grid, from which a solve gets the forces to start with: coarse is the same body,
 * or one similar to it, on cells twice as wide in both directions, (nx + 1)/2 x (ny + 1)/2 of
 * them, rounded down.  Each replaces 2 x 2 cells of op, the last one of a row or column of an
 * odd number fewer; a direction of one cell keeps it.  coarse is another callback operator,
 * with a grid and a preconditioner (if op has one), and a coarser one in turn, down to about 32
 * cells; or one of fuge_operator_halfplane or fuge_operator_halfspace, which makes all coarser
 * ones itself.  coarse is not copied: free it after the solves with op.
 * FUGE_ERR_CALL_ORDER before fuge_operator_set_grid, FUGE_ERR_SIZE for another grid. */
int fuge_operator_set_coarser(fuge_operator *op, const fuge_operator *coarse,
                              char *message, size_t len);

/* A similar body that the library knows: auxiliary, of fuge_operator_halfplane or
 * fuge_operator_halfspace, has the cells of op, and its displacements are close to those of
 * apply, such as those of the body without its layers.  op gets its grid; where none has been
 * set for op, its preconditioner and its coarser grids; its windows for contacts that fill a
 * small fraction of the grid; and the size of the terms by which the residual is judged.  The
 * closer the bodies, the fewer products; it pays as long as the force of one cell displaces it
 * less than about four times as far as on auxiliary.  auxiliary is not copied: free it after
 * the solves with op.  FUGE_ERR_SIZE for other cells, FUGE_ERR_UNSUPPORTED for another
 * operator, one of fuge_mpi.h too. */
int fuge_operator_set_auxiliary(fuge_operator *op, const fuge_operator *auxiliary,
                                char *message, size_t len);

/* What products do not show of the coefficients of A, for callback operators only and not
 * during a solve; length per force, 0 at first.
 *   datum  in  a constant that apply leaves out of all coefficients: it returns
 *              u = (A - datum) f, and the library adds datum times the sum of the forces.  A
 *              large one left in A, such as that of a soft support, costs u its digits
 *   mean   in  mean of |alpha_ij - datum|, such as that of the displacements by one force of
 *              1; 0 if unknown.  Where displacements are small beside their terms, as on a
 *              periodic surface in nearly complete contact, the residual is judged by the
 *              terms, mean times the sum of the forces: without it solves go on for longer
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for mean < 0. */
int fuge_operator_set_coefficients(fuge_operator *op, double datum, double mean,
                                   char *message, size_t len);

/* The product u = A f of any operator, without a contact problem: the displacements by given
 * forces.
 *   n  in   the number of points of op
 *   f  in   n forces, of either sign
 *   u  out  n displacements, datum included; length.  It may be the same array as f
 * Several threads may call it at once.  FUGE_ERR_SIZE for another n, FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; for a callback operator FUGE_ERR_CALLBACK. */
int fuge_operator_apply(const fuge_operator *op, int n, const double *f, double *u,
                        char *message, size_t len);

/* Free and set *op to NULL; NULL and *op == NULL are fine.  Free its solvers first. */
void fuge_operator_free(fuge_operator **op);

/* ---- solver ------------------------------------------------------------- */

typedef struct fuge_solver fuge_solver;

/* opt may be NULL for the defaults.  *s is set on success only; op must outlive it.
 * FUGE_ERR_OPTION for values that fuge_default_options and the enums above do not allow. */
int fuge_solver_new(const fuge_operator *op, const fuge_options *opt, fuge_solver **s,
                    char *message, size_t len);

/* Free and set *s to NULL; NULL and *s == NULL are fine. */
void fuge_solver_free(fuge_solver **s);

/* Progress of a solve, called once in each iteration, and now and then while the
 * iterative engine takes long to estimate the error of the forces.
 *   iteration  increases from call to call, from 1 in each solve
 *   residual   >= 0, no unit.  Tableau: z relative to its start; other engines: the
 *              largest scaled violation.  It need not decrease monotonically
 *   contacts   points in contact at present
 * A nonzero result cancels: fuge_solve returns FUGE_ERR_CANCELLED without a solution, and
 * can be called again.  Do not call functions with this solver from inside. */
typedef int (*fuge_progress)(int iteration, double residual, int contacts, void *user);

/* Call progress from now on, with user; NULL for none.  fuge_reset keeps it.  A solve
 * with zero load has no iterations.  The pivots of the tableau are followed by the
 * contact sets of its final solve. */
int fuge_set_progress(fuge_solver *s, fuge_progress progress, void *user);

/* Solve.  The active set starts from the contact set of the last solve, the iteration from
 * its forces if the load has changed by less than a quarter.
 * FUGE_ERR_CALL_ORDER before gaps and motions are set; FUGE_ERR_NO_EQUILIBRIUM,
 * FUGE_ERR_MODES, FUGE_ERR_NOT_DEFINITE, FUGE_ERR_ITERATION_LIMIT, FUGE_ERR_UNSUPPORTED,
 * FUGE_ERR_OVERFLOW, FUGE_ERR_CALLBACK, FUGE_ERR_CANCELLED. */
int fuge_solve(fuge_solver *s);

/* Solve load cases that differ in gaps and loads only, each by one call of fuge_solve in all
 * but time: by a matrix it starts from the contact set of the case most like it among those
 * before, with the factor at hand.
 *   cases      in   number of cases, at least 1
 *   gap        in   n x cases, column k is case k, displacements by its external loads
 *                   included; length.  NULL: those of fuge_set_gap
 *   resultant  in   m x cases, resultants of the motions, and motions that are prescribed.
 *                   NULL: those of fuge_set_load, fuge_set_approach or fuge_set_modes.
 *                   Not both NULL
 *   force      out  n x cases;  gap_out  out  n x cases;  motion  out  m x cases
 *   status     out  cases: what fuge_solve would have returned.  Each of the four may be NULL
 * A case that fails harms no other: its columns are left as they are.  The progress function
 * hears of each case, once: its number from 1, its residual and its contacts.  Returns
 * FUGE_DONE if all cases are, FUGE_WARN_CASES with the message of the first other one if not.
 * Errors, nothing is written: FUGE_ERR_SIZE, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY,
 * FUGE_ERR_CANCELLED, FUGE_ERR_UNSUPPORTED where ranks share the points.
 * After this call the results of fuge_solve are not available. */
int fuge_solve_cases(fuge_solver *s, int cases, const double *gap, const double *resultant,
                     double *force, double *gap_out, double *motion, int *status);

/* States of the points (n) and report of one of the cases, which count from 0, and the message
 * of its solve, as fuge_solver_message.  FUGE_ERR_CALL_ORDER unless fuge_solve_cases was the
 * last solve, FUGE_ERR_SIZE if there is no such case. */
int fuge_get_case_states(const fuge_solver *s, int which, int *state);
int fuge_get_case_info(const fuge_solver *s, int which, fuge_info *info);
int fuge_case_message(const fuge_solver *s, int which, char *message, size_t len);

/* The smallest and the largest value of each row of `values` (n x cases), such as the forces of
 * all cases or the displacements of all degrees of freedom, and the first case that has it,
 * from 0; -1 where all values are NaN, which do not count.  All four are n, each may be NULL.
 * FUGE_ERR_SIZE, FUGE_ERR_MEMORY. */
int fuge_find_envelope(int n, int cases, const double *values, double *smallest, double *largest,
                       int *smallest_case, int *largest_case, char *message, size_t len);

/* Forget results, contact set and history: the next fuge_solve starts from scratch.
 * Operator, options and problem stay. */
int fuge_reset(fuge_solver *s);

/* ---- problem ------------------------------------------------------------ */

/* Parts that are set each on its own and in any order; the others stay:
 *     gaps        fuge_set_gap
 *     exclusions  fuge_set_excluded; none at first
 *     compliances fuge_set_compliance; none at first
 *     limits      fuge_set_limits; none at first
 *     motions     fuge_set_load, fuge_set_approach or fuge_set_modes, each of which
 *                 replaces all motions and takes away their springs; then fuge_set_motion,
 *                 fuge_set_resultant and fuge_set_motion_stiffness change one.  At first there
 *                 is one translation, with neither load nor approach set
 * All arrays are copied.  Success makes earlier results unavailable; an error changes
 * nothing.  Each part is checked when it is set; whether the parts fit together, and modes
 * are independent, is checked by fuge_solve. */

/* Initial gaps.
 *   gap        in  n; length
 *   gap_upper  in  n, play d between the two stops; length.  HUGE_VAL: one-sided,
 *                  0: tied.  NULL: one-sided everywhere.  FUGE_ERR_GAP if negative */
int fuge_set_gap(fuge_solver *s, const double *gap, const double *gap_upper);

/* Points that carry no force, where excluded (n) is not zero; NULL for none.  Their gaps
 * are computed nevertheless, and may be negative. */
int fuge_set_excluded(fuge_solver *s, const int *excluded);

/* A spring between the bodies at each point, such as a gasket, a bed or a member: the force f
 * closes its gap by compliance*f more, c = g + (alpha + D) f - R q with D = diag(compliance).
 *   compliance  in  n, >= 0; length per force.  NULL: none
 * Of a dense operator the solver keeps a copy of the matrix then, with springs, unless the
 * iteration solves.  Every engine and fuge_follow_path know compliances and springs on motions.
 * FUGE_ERR_LAW for a negative one, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW. */
int fuge_set_compliance(fuge_solver *s, const double *compliance);

/* Limits of the forces, such as hardness times area, the yield force of a support or the force
 * at which a clamp slips.  A point whose force has reached its limit gives way: its gap may be
 * negative then, at the upper stop greater than the play.
 *   limit        in  n, >= 0, of the force at the lower stop; force.  HUGE_VAL: none, 0: the
 *                    point does not push.  NULL: none everywhere
 *   limit_upper  in  n, >= 0, of the size of the force at the upper stop, for a tied point of a
 *                    pulling force; likewise
 * Resultants beyond the limits are FUGE_ERR_NO_EQUILIBRIUM of fuge_solve.  Every engine knows
 * limits, and so does fuge_follow_path.  FUGE_ERR_LAW for a negative one, FUGE_ERR_NOT_FINITE
 * for NaN. */
int fuge_set_limits(fuge_solver *s, const double *limit, const double *limit_upper);

/* One translation, free under the load F_0 >= 0; force.  With fuge_set_gap(s, gap, NULL)
 * and fuge_set_excluded(s, NULL) this is the paper's problem again.  For a load that pulls
 * on two-sided points use fuge_set_resultant(s, 0, load). */
int fuge_set_load(fuge_solver *s, double load);

/* One translation, prescribed; length.  The load is then a result: fuge_get_resultant. */
int fuge_set_approach(fuge_solver *s, double approach);

/* m rigid motions, all free.
 *   m          in  0 .. n.  0: none, c = g + alpha f
 *   modes      in  R, n x m, column-major; length per unit of the motion
 *   resultant  in  w, m; force times length per unit of the motion.  Both may be NULL
 *                  if m = 0
 * FUGE_ERR_SIZE for m < 0, FUGE_ERR_MODES for m > n; where ranks share a grid, for m above the
 * number of all its cells. */
int fuge_set_modes(fuge_solver *s, int m, const double *modes, const double *resultant);

/* Prescribe the motion of mode 0 .. m-1 (FUGE_ERR_SIZE for another), or change its value. */
int fuge_set_motion(fuge_solver *s, int mode, double motion);

/* Let the motion of a mode be free under a resultant of either sign, or change the
 * resultant. */
int fuge_set_resultant(fuge_solver *s, int mode, double resultant);

/* A spring on the motion of a mode, such as an elastic bearing: of the resultant w it carries
 * S q, R^T f = w - S q with S = diag(stiffness); none where the motion is prescribed.
 *   stiffness  in  >= 0; resultant per unit of the motion.  0: none
 * FUGE_ERR_SIZE for another mode than 0 .. m-1, FUGE_ERR_LAW if negative, FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_OVERFLOW; engines as for fuge_set_compliance. */
int fuge_set_motion_stiffness(fuge_solver *s, int mode, double stiffness);

/* Number m of modes of the problem, free and prescribed; at any time. */
int fuge_get_mode_count(const fuge_solver *s, int *m);

/* ---- load path ---------------------------------------------------------- */

enum {                          /* state of a contact point */
  FUGE_AT_LOWER_STOP = 1,       /* gap 0, force >= 0; of either sign if tied */
  FUGE_OPEN = 0,                /* between the stops, or beyond one of limit 0; no force */
  FUGE_AT_UPPER_STOP = -1,      /* gap = play, force <= 0 */
  FUGE_LIMITED_LOWER = 2,       /* force at the limit of the lower stop, gap <= 0 */
  FUGE_LIMITED_UPPER = -2       /* force at the limit of the upper stop, gap >= play */
};

/* The exact course of the contact as the load of one translation grows from 0 to load,
 * without load steps: every load at which a point comes into contact or leaves it.
 *   op         in   a dense operator, n points
 *   gap        in   n; length             load  in  >= 0; force
 *   capacity   in   entries that fit into the six arrays, each of which may be NULL
 *   parameter  out  the load, ascending; the first entry is the start, 0, before any
 *                   point touches, the others are the events; force
 *   motion     out  v_0 there; length
 *   rate       out  dv_0/dF_0 from there to the next entry, 1 over the contact stiffness
 *   point      out  the point that changes; -1 for the start
 *   state      out  its new state: FUGE_AT_LOWER_STOP or FUGE_OPEN
 *   contacts   out  points in contact from there on
 *   entries    out  number of entries, of which the first capacity are written
 * Points that change together have an entry each; motion, rate and contacts are then
 * those after all of them.  Both ends of every piece are held against the conditions of
 * contact: FUGE_WARN_RESIDUAL if they violate them by more than 1e-10.
 * FUGE_ERR_UNSUPPORTED for another operator, FUGE_ERR_NO_EQUILIBRIUM for a load < 0. */
int fuge_load_path(const fuge_operator *op, const double *gap, double load, int capacity,
                   double *parameter, double *motion, double *rate, int *point, int *state,
                   int *contacts, int *entries, char *message, size_t len);

/* The same between two general problems: from that of the solver, in equilibrium, to one
 * with other resultants and prescribed motions, all of which change linearly with a
 * parameter from 0 to 1.  No fuge_solve is needed, and the results of one stay.
 *   finish     in   m; at the end, resultants of free motions and prescribed motions
 *   parameter  out  ascending, 0 at the start; the events are those before 1
 *   motion     out  m for each entry: q there, entry k at motion + k*m; after the jump if
 *                   q jumps, as it may if no contact resists it
 *   rate       out  m for each entry: dq/d(parameter) from there to the next one
 *   state      out  any state
 *   contacts   out  points at a stop or at their limit from there on
 * The other arguments are as above.  Compliances, limits of the forces and springs on motions
 * hold all along; a point that comes to its limit or leaves it has an entry.
 * FUGE_ERR_NO_EQUILIBRIUM if equilibrium ends on the path, also where the limits carry no
 * more: the message has the parameter; choose an end before it.  FUGE_ERR_CALL_ORDER and
 * FUGE_ERR_UNSUPPORTED as for fuge_solve with a matrix. */
int fuge_follow_path(const fuge_solver *s, const double *finish, int capacity, double *parameter,
                     double *motion, double *rate, int *point, int *state, int *contacts,
                     int *entries);

/* ---- results ------------------------------------------------------------ */

/* FUGE_ERR_CALL_ORDER unless the last fuge_solve has found a solution of the present
 * problem.  m is that of fuge_get_mode_count: 1 without fuge_set_modes. */
int fuge_get_force(const fuge_solver *s, double *force);          /* n; force */
int fuge_get_gap(const fuge_solver *s, double *gap);              /* n; length */
int fuge_get_states(const fuge_solver *s, int *state);            /* n; FUGE_OPEN .. as above */
int fuge_get_motion(const fuge_solver *s, double *motion);        /* m: q; one translation: v_0 */
int fuge_get_resultant(const fuge_solver *s, double *resultant);  /* m: R^T f; one translation:
                                                                     the sum of the forces */

/* Derivative of the last solution in a direction, exact as long as the contact set does
 * not change: the changes of force and gap (n each) and of all motions (m) for changes of the
 * gaps (n; NULL for none) and of the loads (m; NULL for none), which are the resultants of free
 * motions and the values of prescribed ones.  gap and motion may be NULL.  Of one translation,
 * with gap_change NULL and a load_change of 1, the contact stiffness is 1/motion; a unit
 * gap_change at k gives column k of the sensitivity to the gaps.  After a dense engine each
 * call costs four triangular solves, after the iteration products on the contact set, to the
 * tolerance of the solve.  FUGE_ERR_CALL_ORDER also after a solve with zero load;
 * FUGE_ERR_NO_EQUILIBRIUM where the contact does not resist what the changes load; by products
 * also FUGE_ERR_ITERATION_LIMIT where alpha is too badly conditioned on the contact. */
int fuge_get_derivatives(const fuge_solver *s, const double *gap_change, const double *load_change,
                         double *force, double *gap, double *motion);

/* Bounds of the error of the last solution.  They are theorems about the data as they are stored,
 * rounding included: the exact solution of the problem is within them.
 *   force_bound   out  n, of |force - exact force|; force
 *   gap_bound     out  n, of |gap - exact gap|; length
 *   motion_bound  out  m, of |motion - exact motion|, 0 for a prescribed one; length for a
 *                      translation
 *   proved        out  n, 1 where it is proved that the point has the state of fuge_get_states and
 *                      is not on the border to another one, else 0
 * Each of the four may be NULL.  By a matrix any problem, in the time of a few solves from cold and
 * with memory for three copies of the matrix; its lower triangle counts.  By a
 * half-plane or half-space on a grid one translation, free or prescribed, for the exact
 * coefficients of the elements, by two products.  FUGE_DONE with a message in the solver: all is
 * bounded, but the states of some points are not proved.  FUGE_WARN_NOT_PROVED: the message says
 * why bounds are infinite, HUGE_VAL; so is each one by another operator.  The solution stays.
 * FUGE_ERR_CALL_ORDER as above, FUGE_ERR_MEMORY, FUGE_ERR_UNSUPPORTED where ranks share the
 * points. */
int fuge_prove(const fuge_solver *s, double *force_bound, double *gap_bound,
               double *motion_bound, int *proved);

/* ---- design ------------------------------------------------------------- */

/* The gradient of an objective J at the last solution, over all data of the problem at once: the
 * reverse of fuge_get_derivatives, in the time of one call of it, whatever the number of data.  It
 * is exact as long as the contact set does not change.
 *   force_weight      n, dJ/df; NULL if J does not depend on the forces; unit of J per force
 *   gap_weight        n, dJ/dc, by the gaps under load, NULL as above; unit of J per length
 *   motion_weight     m, dJ/dq, NULL as above
 *   gap               out  n, dJ/dg, by the initial gaps; unit of J per length
 *   load              out  m, dJ/dw, by the resultants; where a motion is prescribed, by the
 *                          motion
 *   compliance        out  n, by the compliances; where there is none, by the first bit of one
 *   motion_stiffness  out  m, by the springs on the motions; 0 where a motion is prescribed
 *   gap_upper         out  n, by the plays; 0 but at the upper stop, and where a tied point pulls
 *   limit             out  n, by the limits of the forces; 0 but where a force has reached its
 *                          limit, by the first bit of one that is 0
 *   limit_upper       out  n, by the limits at the upper stops
 *   log_modulus       out  1, e_star*dJ/de_star: by the logarithm of the modulus to which all
 *                          displacements by contact forces are inversely proportional; unit of J
 *   at_kink           out  n, 1 for a point on the border between two states, else 0
 * Each gradient may be NULL, and those by gaps and loads may be arrays of the weights.  The gradient
 * by a coefficient of the influence matrix is gap[i]*force[j].  FUGE_WARN_KINK, unless the solve had
 * a warning, which holds for the gradient too: points lie on the border between two states, as one
 * that touches without force, and the gradient is that of one side of a kink.  After the iteration
 * products on the contact set, one more for weights of gaps, and one where displacements are small
 * beside gaps or compliances.  Errors as for fuge_get_derivatives; FUGE_ERR_NO_EQUILIBRIUM if J
 * depends on a motion that the contact does not resist; FUGE_ERR_OVERFLOW; those of the product. */
int fuge_get_gradients(const fuge_solver *s, const double *force_weight, const double *gap_weight,
                       const double *motion_weight, double *gap, double *load, double *compliance,
                       double *motion_stiffness, double *gap_upper, double *limit,
                       double *limit_upper, double *log_modulus, int *at_kink);

/* The initial gaps that give wanted contact forces, by one product.  The modes, prescribed motions
 * and laws of the solver count, its gaps and resultants do not, and stay.
 *   force      n, wanted; force: pressures times the areas of the points
 *   clearance  >= 0, the gap that is left under load where no force is wanted; length; with 0
 *              these points just touch
 *   gap        out  n, for fuge_set_gap; length.  A free translation takes up a constant: where it
 *                   is the only motion the smallest gap is 0.  Other free motions will be 0
 *   reached    out  n, forces that these gaps give; NULL if not needed
 *   resultant  out  m, their resultants, the loads that belong to them; NULL if not needed
 * FUGE_WARN_UNREACHABLE if a point cannot have its force: none that pulls at a lower stop, none
 * beyond a limit, none where excluded.  Its nearest one is taken then; the message has the number
 * of such points and the first.  FUGE_ERR_POINTER, FUGE_ERR_NOT_FINITE, FUGE_ERR_GAP for a negative
 * clearance, FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY, those of the product. */
int fuge_gap_for_pressure(const fuge_solver *s, const double *force, double clearance, double *gap,
                          double *reached, double *resultant);

/* Report of the last fuge_solve, failed or not; FUGE_ERR_CALL_ORDER before the first. */
int fuge_get_info(const fuge_solver *s, fuge_info *info);

/* Steps first .. first+count-1 of the tableau (options.keep_history); step 0 is the
 * artificial start, each other one a pivot.
 *   basis      out  count rows of n+m column numbers, row k at basis + k*(n+m), counted from
 *                   1: 1 .. n forces, n+1 .. 2n gaps, then m free motions (v_0: 2n+1,
 *                   m = 1), then artificial variables.  Two equal rows: a gap went from
 *                   one stop to the other, or a force to its limit or from it
 *   z          out  count; sum of the artificial variables in your units
 *   available  out  number of steps kept
 * With count = 0 only available is set; basis and z may then be NULL.  A solve with zero
 * load needs no pivots and keeps no steps.  FUGE_ERR_SIZE for a range beyond those kept. */
int fuge_get_history(const fuge_solver *s, int first, int count, int *basis, double *z,
                     int *available);

/* Message of the last call on s; a getter that succeeds leaves that of the call before.  At
 * most len bytes are written, always ended by NUL. */
int fuge_solver_message(const fuge_solver *s, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
