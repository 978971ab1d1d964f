/* fuge - bodies of finite elements.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_FE_H
#define FUGE_FE_H

#include <stddef.h>
#include "fuge_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- condensation -------------------------------------------------------
 *
 * From the stiffness matrix K of a body to the influence matrix of its contact points (a
 * Schur complement), and back from contact forces to the displacements of the whole body.
 *
 *     fuge_body_dense, _band, _columns or _sparse -> fuge_body_fix, _set_load, _set_contact, ..
 *     -> fuge_body_condense -> fuge_body_get_...
 *     -> fuge_operator_dense(alpha), gaps + displacement, solve -> fuge_body_recover
 *     -> fuge_body_free
 *
 * Degrees of freedom count from 0; -1 stands for none.  K is symmetric, force per
 * displacement, and positive definite without the rows and columns of the fixed degrees of
 * freedom, or semidefinite if the body floats, that is, has rigid modes that its supports
 * do not prevent.
 *
 * Contact point i moves by u_i = sum over k < width of normal[k + i*width] *
 * u[dof[k + i*width]]: `normal` is the direction in which the contact force acts on the
 * body, into the body; the gap opens by u_i.  For two bodies in one K name the degrees of
 * freedom of both surfaces, with opposite normals.  Points may move alike, such as a bolt and a
 * gasket at one node; whether their forces are unique depends on gaps and compliances, and the
 * solver says so. */

typedef struct fuge_body fuge_body;

/* A body by its stiffness.  k: degrees x degrees, both triangles, ldk >= degrees.
 * ab: LAPACK's symmetric band storage with kd diagonals beside the main one, ldab > kd;
 * upper nonzero: K(i,j) = ab[kd + i - j + j*ldab], i <= j, else K(i,j) = ab[i - j + j*ldab],
 * i >= j.  The arrays are not copied: keep them as long as the body.  Their values are read
 * and checked by fuge_body_condense.  *body is set on success only.  FUGE_ERR_SIZE. */
int fuge_body_dense(int degrees, const double *k, int ldk, fuge_body **body,
                    char *message, size_t len);
int fuge_body_band(int degrees, int kd, const double *ab, int ldab, int upper, fuge_body **body,
                   char *message, size_t len);

/* The same for compressed columns: column j holds row[p] and value[p] for
 * column[j] <= p < column[j+1], rows in any order, repeated entries are added; both
 * triangles or one of them.  The first is factorised as a band, whose width depends on the
 * numbering of degrees of freedom; the second, for all but small models, by CHOLMOD, which the
 * library fuge_sparse needs. */
int fuge_body_columns(int degrees, const int *column, const int *row, const double *value,
                      fuge_body **body, char *message, size_t len);
int fuge_body_sparse(int degrees, const int *column, const int *row, const double *value,
                     fuge_body **body, char *message, size_t len);

/* Free and set *body to NULL; NULL and *body == NULL are fine. */
void fuge_body_free(fuge_body **body);

/* Fix `count` degrees of freedom at these displacements, or at zero (NULL).  Each call
 * replaces the one before.  The numbers are checked by fuge_body_condense. */
int fuge_body_fix(fuge_body *body, int count, const int *dof, const double *displacement);

/* External load, one force for each degree of freedom.  After fuge_body_condense this costs
 * one solve, and only fuge_body_get_displacement and fuge_body_get_modes change. */
int fuge_body_set_load(fuge_body *body, const double *load);

/* The body floats: these are the rigid modes that its supports allow (Z, degrees x m), or
 * fuge_body_condense finds them.  m = 0: the body does not float, as at first.
 * FUGE_ERR_MODES for m > degrees. */
int fuge_body_set_rigid_modes(fuge_body *body, int m, const double *rigid_modes);
int fuge_body_find_rigid_modes(fuge_body *body);

/* Rigid modes of nodes in the plane or in space: position is dimensions x nodes,
 * rigid_modes (dimensions*nodes) x 3 or x 6, translations before rotations about the
 * centre of the nodes.  FUGE_ERR_SIZE unless dimensions is 2 or 3 and nodes > 0;
 * FUGE_ERR_NOT_FINITE for a position. */
int fuge_rigid_modes(int dimensions, int nodes, const double *position, double *rigid_modes,
                     char *message, size_t len);

/* n contact points of `width` degrees of freedom each; see above.  The numbers are checked
 * by fuge_body_condense. */
int fuge_body_set_contact(fuge_body *body, int n, int width, const int *dof, const double *normal);

/* Condense: one Cholesky factorisation and n + 4 solves.  FUGE_ERR_SIZE, FUGE_ERR_DOF,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_NOT_SYMMETRIC, FUGE_ERR_NOT_DEFINITE (the message names the
 * degree of freedom), FUGE_ERR_MODES, FUGE_ERR_NO_EQUILIBRIUM (a load that no contact can
 * resist), FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY; FUGE_WARN_RESIDUAL if K is so close to singular
 * that few digits of alpha may be correct.  The getters below give FUGE_ERR_CALL_ORDER
 * before it, and after a call that changes the body. */
int fuge_body_condense(fuge_body *body);

/* Influence matrix alpha, n x n, lda >= n, for fuge_operator_dense; length per force. */
int fuge_body_get_influence(const fuge_body *body, double *alpha, int lda);

/* Displacements of the contact points by load and supports, n; length.  Add them to the
 * gaps. */
int fuge_body_get_displacement(const fuge_body *body, double *displacement);

/* Number m of rigid modes that the contact has to resist, 0 if the body does not float.
 * Those that move no contact point are left out. */
int fuge_body_get_mode_count(const fuge_body *body, int *m);

/* R (n x m) and w (m) for fuge_set_modes.  Either may be NULL. */
int fuge_body_get_modes(const fuge_body *body, double *modes, double *resultant);

/* Displacements of all degrees of freedom under contact forces (n) and motions (m; NULL if
 * m = 0) of a solution.  FUGE_WARN_RESIDUAL if K u is out of balance by more than 1e-10 of
 * the forces. */
int fuge_body_recover(const fuge_body *body, const double *force, const double *motion,
                      double *displacement);

/* Load cases, loads (degrees x cases), column k is case k: what fuge_solve_cases takes.
 *   supports      in   fixed x cases, displacements of the supports in each case, in the order of
 *                      fuge_body_fix; length.  NULL: those of fuge_body_fix in all cases
 *   displacement  out  n x cases, of the contact points by load and supports; add the gaps; length
 *   resultant     out  m x cases, of the rigid modes, for fuge_solve_cases; may be NULL if m = 0
 *   status        out  cases: FUGE_DONE, or why a load cannot be applied, such as
 *                      FUGE_ERR_NO_EQUILIBRIUM for one that no contact can resist
 * Each of the last three may be NULL.  The columns of a case that is refused are NaN, so that
 * fuge_solve_cases refuses it too, and the call gives FUGE_WARN_CASES with the message of the
 * first one.  The load of fuge_body_set_load does not count.  FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE
 * for supports, FUGE_ERR_MEMORY. */
int fuge_body_get_cases(fuge_body *body, int cases, const double *loads, const double *supports,
                        double *displacement, double *resultant, int *status);

/* Displacements (degrees x cases) of all degrees of freedom for the solutions of load cases.
 *   loads     in  degrees x cases, and supports, fixed x cases or NULL, as above
 *   force     in  n x cases, motion m x cases (NULL if m = 0), both of fuge_solve_cases
 *   status    in  cases, of fuge_solve_cases: columns of cases whose status is negative become
 *                 NaN.  NULL: all cases have a solution
 * FUGE_WARN_RESIDUAL as fuge_body_recover, for the worst case. */
int fuge_body_recover_cases(fuge_body *body, int cases, const double *loads,
                            const double *supports, const double *force, const double *motion,
                            double *displacement, const int *status);

/* Message of load case `which` of the last of these two calls: why its load is refused, or that
 * its displacements are out of balance; else empty.  FUGE_ERR_CALL_ORDER before the first call,
 * FUGE_ERR_SIZE if there is no such case. */
int fuge_body_case_message(const fuge_body *body, int which, char *message, size_t len);

/* Message of the last call on body; a getter that succeeds leaves that of the call before.
 * At most len bytes are written, always ended by NUL. */
int fuge_body_message(const fuge_body *body, char *message, size_t len);

/* ---- pairs of surfaces --------------------------------------------------
 *
 * From two surfaces whose nodes do not face each other to contact points: their gaps, and
 * the combinations of degrees of freedom of both bodies that fuge_body_set_contact takes.
 * Both bodies are in one stiffness matrix.  Sliding is small: the pairs are those of the
 * positions given.
 *
 *     fuge_pairs_create -> fuge_pairs_set_contact, fuge_pairs_set_opposite -> fuge_pairs_find
 *     (again for each further pair of surfaces) -> fuge_pairs_get_...
 *     -> fuge_body_set_contact(dof, normal), .., fuge_pairs_free
 *
 * Pressure = force/area. */

typedef struct fuge_pairs fuge_pairs;

/* Method: weighted gaps of the dual mortar method; or each node against the face across
 * from it, which fails the patch test: on meshes that do not match it does not reproduce a
 * uniform pressure. */
enum { FUGE_MORTAR = 0, FUGE_NODE_TO_FACE = 1 };

/* Normals: averaged at the nodes of the contact surface; those of the opposite faces;
 * given at the nodes of the contact surface. */
enum { FUGE_NORMALS_AVERAGED = 0, FUGE_NORMALS_OPPOSITE = 1, FUGE_NORMALS_GIVEN = 2 };

/* An empty set of pairs.  *pairs is set on success only.  FUGE_ERR_MEMORY. */
int fuge_pairs_create(fuge_pairs **pairs, char *message, size_t len);

/* Free and set *pairs to NULL; NULL and *pairs == NULL are fine. */
void fuge_pairs_free(fuge_pairs **pairs);

/* The surface whose nodes become contact points (with linear faces the coarser one, whose
 * pressures are smooth; with quadratic faces the finer one) and the opposite one, for the next
 * fuge_pairs_find; both are copied.
 *   dimensions  2 or 3
 *   node        positions, dimensions x nodes
 *   face        numbers of the nodes of each face, most x faces, from 0; unused places, at
 *               the end, are -1.  Faces have 2 or 3 nodes in the plane, 3, 4, 6 or 8 in
 *               space: corners first, then the nodes in the middle of the sides, that
 *               between corners 0 and 1, between 1 and 2, and so on.  In the plane the body
 *               lies to the left of the way from corner 0 to corner 1; in space the corners
 *               run counter-clockwise if seen from outside.
 *   dof         degrees of freedom of the nodes, dimensions x nodes, from 0; -1: does not
 *               move.  NULL: the surface is rigid.
 * Two surfaces that both look into their bodies face each other too: positions alone do not
 * tell.  fuge_bodies knows the bodies, and refuses them.
 * FUGE_ERR_SIZE, FUGE_ERR_MEMORY; the contents are checked by fuge_pairs_find. */
int fuge_pairs_set_contact(fuge_pairs *pairs, int dimensions, int nodes, const double *node,
                           int most, int faces, const int *face, const int *dof);
int fuge_pairs_set_opposite(fuge_pairs *pairs, int dimensions, int nodes, const double *node,
                            int most, int faces, const int *face, const int *dof);

/* How surfaces are understood from the next fuge_pairs_find on.
 *   crease      angle between the normals of neighbouring faces, in degrees from 0 to 90,
 *               beyond which a smooth body has an edge there, 25 at first: more than 360 over
 *               the number of elements round a full circle, less than the angle of any chamfer
 *   revolution  1: surfaces in the plane are those of bodies of revolution with the radius
 *               along x, areas are those of rings, and forces those of whole rings; 0, as at
 *               first
 * Both are checked by fuge_pairs_find. */
int fuge_pairs_set_geometry(fuge_pairs *pairs, double crease, int revolution);

/* Find the contact points of both surfaces and add them to those found before.
 *   normal  for FUGE_NORMALS_GIVEN: outwards from the contact surface at its nodes,
 *           dimensions x nodes, of any length; else NULL
 *   reach   how far apart, or one inside the other, opposite points may be, length; not
 *           above 0: as far as the surfaces extend
 *   play    between the lower and the upper stop, length: 0 for points that stay in contact
 *           but slide, INFINITY for one-sided contact
 *   tied    1: glue the surfaces where they are, along each axis; else 0
 *   smooth  1, as a rule: normals, gaps and areas of the smooth bodies that the meshes stand
 *           for, exact on circles, spheres and cylinders; faces that meet at more than 25
 *           degrees (or what fuge_pairs_set_geometry has set) keep their edge, flat faces stay
 *           flat.  0: those of the faces as they are, whose chords on a round body are wrong
 *           by L^2/(8 R)
 * FUGE_WARN_PAIRS: a node is a contact point of two pairs; where it moves alike in both, it is
 * listed once, with the area of both.  Errors, nothing is added: FUGE_ERR_SIZE,
 * FUGE_ERR_ELEMENT, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_DOF, FUGE_ERR_GAP,
 * FUGE_ERR_OPTION, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY; FUGE_ERR_MESH for a face that is
 * folded over, has no area or looks the wrong way, for a given normal that does, and for
 * surfaces that do not face each other. */
int fuge_pairs_find(fuge_pairs *pairs, int method, int normals, const double *normal, double reach,
                    double play, int tied, int smooth);

/* Contact points n, degrees of freedom of each (`width`), and nodes without an opposite.
 * Each pointer here and below may be NULL. */
int fuge_pairs_get_sizes(const fuge_pairs *pairs, int *n, int *width, int *unpaired);

/* What fuge_body_set_contact takes: both width x n, dof -1 where unused. */
int fuge_pairs_get_contact(const fuge_pairs *pairs, int *dof, double *normal);

/* Initial gaps, plays (both for fuge_set_gap) and areas, in the plane
 * lengths, n each. */
int fuge_pairs_get_gaps(const fuge_pairs *pairs, double *gap, double *gap_upper, double *area);

/* Where the contact points are: the pair and the node of its contact surface, the opposite
 * face (with FUGE_MORTAR that with the largest share), n each; the place in it,
 * (dimensions - 1) x n, and the direction of the gap, dimensions x n: the
 * force on the opposite body is force*direction, where direction is a unit vector, but between
 * smooth bodies the mean of those of the places that belong to the point.  Pairs, nodes and
 * faces count from 0. */
int fuge_pairs_get_points(const fuge_pairs *pairs, int *pair, int *node, int *face, double *place,
                          double *direction);

/* Pair and node of the nodes that have no opposite, and so are no contact points. */
int fuge_pairs_get_unpaired(const fuge_pairs *pairs, int *pair, int *node);

/* Message of the last call on pairs that set or found, or of the last error; as
 * fuge_body_message. */
int fuge_pairs_message(const fuge_pairs *pairs, char *message, size_t len);

/* ---- elastic bodies -----------------------------------------------------
 *
 * From the stiffness matrices and the surfaces of bodies whose meshes need not match to
 * contact forces, pressures and displacements.
 *
 *     for each body: fuge_body_columns, fuge_body_fix, fuge_body_set_load
 *     fuge_bodies_create -> fuge_bodies_add, for each body
 *     -> for each pair of surfaces: fuge_pairs_set_contact, fuge_pairs_set_opposite,
 *        fuge_bodies_add_pair
 *     -> fuge_bodies_solve or fuge_bodies_solve_sparse
 *     -> fuge_bodies_get_..., fuge_pairs_get_...
 *     -> fuge_bodies_free, then fuge_body_free and fuge_pairs_free
 *
 * Bodies, their degrees of freedom, pairs, nodes and faces count from 0, and each body has
 * its own degrees of freedom.  Bodies may float: rigid motions that the supports leave are
 * found, unless fuge_body_set_rigid_modes gives those of all bodies that float.  Contact points of
 * fuge_body_set_contact do not count here.  Sliding is small, without friction. */

typedef struct fuge_bodies fuge_bodies;

/* No bodies.  *bodies is set on success only.  FUGE_ERR_MEMORY. */
int fuge_bodies_create(fuge_bodies **bodies, char *message, size_t len);

/* Free and set *bodies to NULL; NULL and *bodies == NULL are fine. */
void fuge_bodies_free(fuge_bodies **bodies);

/* Add a body, of any kind of matrix.  It is not copied: keep it as long as the bodies are solved;
 * supports and loads are those that it has at the time of a solve, where its contents are checked.
 *   number  out  0 for the first one, and so on; may be NULL
 * FUGE_ERR_MEMORY. */
int fuge_bodies_add(fuge_bodies *bodies, const fuge_body *body, int *number);

/* Add a pair of the surfaces that fuge_pairs_set_contact and fuge_pairs_set_opposite have given to
 * `pairs`, each with degrees of freedom of its own body; they are copied, and so is what
 * fuge_pairs_set_geometry has set.
 *   contact_body, opposite_body  in  numbers of the bodies, which may be the same; -1, and
 *                                    dof = NULL: the surface is rigid and held in space
 * The other arguments are those of fuge_pairs_find.  Numbers and surfaces are checked by
 * fuge_bodies_join and fuge_bodies_solve.  FUGE_ERR_CALL_ORDER without both surfaces, FUGE_ERR_MEMORY. */
int fuge_bodies_add_pair(fuge_bodies *bodies, int contact_body, int opposite_body,
                         const fuge_pairs *pairs, int method, int normals, const double *normal,
                         double reach, double play, int tied, int smooth);

/* Solve.
 *   opt    in   may be NULL
 *   pairs  out  the contact points, in place of those that it has, for fuge_pairs_get_sizes,
 *               _get_gaps, _get_points and _get_unpaired; may be NULL
 * The matrix of all bodies is kept as a band, whose width depends on the numbering of degrees of
 * freedom; for all but small models use fuge_bodies_solve_sparse, in the library fuge_sparse,
 * which needs CHOLMOD.  Warnings: those of fuge_solve, else those
 * of fuge_body_condense and fuge_body_recover, or FUGE_WARN_PAIRS, or FUGE_WARN_NO_CONTACT:
 * loads and supports open every gap; they pull, or all surfaces look into their bodies.
 * Errors name the body or the pair, the results of the solve before stay: those of
 * fuge_pairs_find, fuge_body_condense and fuge_solve; FUGE_ERR_GAP also where supports hold two
 * surfaces inside each other; FUGE_ERR_MESH also for a surface that looks into its body, which
 * the matrix knows if `node` has the body's other nodes too, with their dof. */
int fuge_bodies_solve(fuge_bodies *bodies, const fuge_options *opt, fuge_pairs *pairs);
int fuge_bodies_solve_sparse(fuge_bodies *bodies, const fuge_options *opt, fuge_pairs *pairs);

/* Contact forces, one for each contact point; negative only at an upper stop and at tied points,
 * where they are the components along the axes of the force of the contact surface on the opposite
 * one.  Pressures, force over area, and gaps under load.  This and the next give
 * FUGE_ERR_CALL_ORDER before a solve, and each pointer may be NULL. */
int fuge_bodies_get_forces(const fuge_bodies *bodies, double *force, double *pressure, double *gap);

/* Displacements of all degrees of freedom of one body, length.  FUGE_ERR_SIZE if there is no such
 * body. */
int fuge_bodies_get_displacement(const fuge_bodies *bodies, int body, double *displacement);

/* Report of the last solve, failed or not. */
int fuge_bodies_get_info(const fuge_bodies *bodies, fuge_info *info);

/* Message of the last call on bodies that added, joined or solved, or of the last error; as
 * fuge_body_message. */
int fuge_bodies_message(const fuge_bodies *bodies, char *message, size_t len);

/* ---- bodies as one ------------------------------------------------------
 *
 * For further loads on the same factor, or for points that are excluded: join the bodies,
 * and go the way of fuge_body yourself: fuge_body_sparse with the matrix of all bodies,
 * fuge_body_fix and fuge_body_set_load (degree of freedom j of body k is first[k] + j),
 * fuge_body_find_rigid_modes, fuge_body_set_contact. */

/* Join.
 *   pairs             out  the contact points, as fuge_bodies_solve, with degrees of freedom of all
 *                          bodies: fuge_pairs_get_contact has what fuge_body_set_contact takes; may
 *                          be NULL
 *   degrees, entries  out  degrees of freedom and entries of the matrix of all bodies; may be NULL
 * FUGE_WARN_PAIRS and errors as fuge_bodies_solve. */
int fuge_bodies_join(fuge_bodies *bodies, fuge_pairs *pairs, int *degrees, int *entries);

/* Of the last join, the upper triangle in compressed columns, as fuge_body_sparse takes it: column
 * has degrees + 1 elements, row and value have `entries`; first: degrees of freedom before those
 * of each body, one more than bodies.  Each may be NULL.  FUGE_ERR_CALL_ORDER before a join. */
int fuge_bodies_get_matrix(const fuge_bodies *bodies, int *column, int *row, double *value,
                           int *first);

/* ---- links of structures ------------------------------------------------
 *
 * One-way links of a structure, a truss, a frame or any other body: supports that lift off,
 * gaps between nodes, cables and struts.  Link k is contact point k.
 *
 *     fuge_links_create -> fuge_links_add_... -> fuge_body_set_links -> fuge_body_condense
 *     -> fuge_body_get_influence, fuge_operator_dense, fuge_solver_new
 *     -> fuge_links_pose -> fuge_solve -> fuge_body_recover
 *     or -> fuge_body_get_cases, fuge_links_get_gaps, fuge_solve_cases, fuge_body_recover_cases
 *     -> fuge_links_free
 *
 * Names of links are for messages; NULL stands for "link 1", "link 2" and so on, in the order in
 * which they are added.  Of longer names 80 bytes are kept. */

typedef struct fuge_links fuge_links;

/* The law of a link; fuge_default_link_law, then change what differs. */
typedef struct fuge_link_law {
  double gap;                   /* without load, length; negative: an interference */
  double play;                  /* from the first stop to a second one, length; HUGE_VAL: none */
  double compliance;            /* of the link, length per force; 0: rigid */
  double limit;                 /* of the force at the first stop; HUGE_VAL: none */
  double limit_upper;           /* likewise at the second */
  double reserved[7];
} fuge_link_law;

/* Kinds of members. */
enum { FUGE_TENSION_ONLY = 1, FUGE_COMPRESSION_ONLY = -1 };

/* A straight member without bending, in tension or in compression only: `fuge_member member = {0};`,
 * then set at least the first three. */
typedef struct fuge_member {
  int kind;                     /* FUGE_TENSION_ONLY or FUGE_COMPRESSION_ONLY */
  double area, modulus;         /* of the section, and Young's; both > 0 */
  double slack;                 /* a cable is longer than the distance of its ends by so much, a
                                   strut shorter; length.  Negative: it is prestressed */
  double yield;                 /* force at which it yields; 0: never */
  double reserved[7];
} fuge_member;

/* Set *law to that of a hard link: no gap, no second stop, no compliance, no limits.  Zeros are
 * not the defaults. */
void fuge_default_link_law(fuge_link_law *law);

/* No links.  *links is set on success only.  FUGE_ERR_MEMORY. */
int fuge_links_create(fuge_links **links, char *message, size_t len);

/* Free and set *links to NULL; NULL and *links == NULL are fine. */
void fuge_links_free(fuge_links **links);

/* Add a support of a node: it pushes the node along `direction`, and its gap opens when the
 * node moves along it.
 *   count      degrees of freedom of the node, 1 .. 6
 *   dof        which they are, from 0; -1: does not move
 *   direction  a component for each, not all zero: the first three are translations, which are
 *              scaled to length 1 together, the others rotations, whose components are lever
 *              arms, length.  So the rotation of a plane frame is a fourth or a later one
 *   law        NULL: a hard link
 *   name       may be NULL
 * Errors of these three, nothing is added: FUGE_ERR_SIZE, FUGE_ERR_DOF where no degree of
 * freedom moves along the direction, FUGE_ERR_NOT_FINITE, FUGE_ERR_GAP, FUGE_ERR_LAW,
 * FUGE_ERR_OVERFLOW, FUGE_ERR_MEMORY. */
int fuge_links_add_support(fuge_links *links, int count, const int *dof, const double *direction,
                           const fuge_link_law *law, const char *name);

/* Add a gap between two nodes: it closes when node a approaches node b along `direction`, which
 * points from a to b, and its force pushes them apart. */
int fuge_links_add_gap(fuge_links *links, int count, const int *dof_a, const int *dof_b,
                       const double *direction, const fuge_link_law *law, const char *name);

/* Add a straight member between two nodes; its force is positive where it carries.  The dof are
 * displacements of the ends along the axes, the positions have as many components.  The stiffness
 * matrix must not have the member too: fuge_remove_member. */
int fuge_links_add_member(fuge_links *links, int dimensions, const int *dof_a, const int *dof_b,
                          const double *position_a, const double *position_b,
                          const fuge_member *member, const char *name);

/* Number of links, and their gaps without load, one for each; those of members are their slack. */
int fuge_links_get_count(const fuge_links *links, int *count);
int fuge_links_get_gaps(const fuge_links *links, double *gap);

/* The links become the contact points of the body, in place of those of fuge_body_set_contact;
 * their degrees of freedom are checked by fuge_body_condense.  Those that supports hold at both
 * ends move with these alone.  After further links call it again.  FUGE_ERR_CALL_ORDER
 * without links, FUGE_ERR_MEMORY. */
int fuge_body_set_links(fuge_body *body, const fuge_links *links);

/* Pose the problem of the links of a condensed body: the solver, whose operator is the
 * influence matrix of the body, gets gaps, plays, compliances, limits, rigid modes and their
 * resultants, in place of all that was set before.  After another load of the body pose it again.
 * With FUGE_DONE the message of the links names those that can never act, because supports of
 * the body hold their ends and stand still.
 * FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE, FUGE_ERR_MEMORY; the message is that of the links. */
int fuge_links_pose(fuge_links *links, const fuge_body *body, fuge_solver *s);

/* After FUGE_ERR_NO_EQUILIBRIUM of fuge_solve: how the structure moves, because no forces of its
 * links balance the load.  displacement: one for each degree of freedom, the largest of size 1;
 * no link closes along them unless its force is at the limit, and the load does work.  All zero
 * where there is equilibrium.
 * FUGE_ERR_CALL_ORDER, FUGE_ERR_SIZE for the solver of another body, FUGE_ERR_MODES,
 * FUGE_ERR_MEMORY; the message is that of the body. */
int fuge_body_find_mechanism(fuge_body *body, const fuge_solver *s, double *displacement);

/* The mechanism in words, which are the message: which links open or give way, and how the
 * structure moves.
 *   degrees, u         in  displacements of fuge_body_find_mechanism
 *   dimensions, nodes  in  2 or 3, and the number of nodes
 *   position, dof      in  dimensions x nodes: length, and degrees of freedom; -1: does not move
 * FUGE_ERR_SIZE. */
int fuge_links_describe(const fuge_links *links, int degrees, const double *u, int dimensions,
                        int nodes, const double *position, const int *dof, char *message,
                        size_t len);

/* Take a member, k h h^T, out of a stiffness matrix in compressed columns, as fuge_body_sparse
 * takes it, so that it does not count twice beside its link.
 *   value      in, out  the entries
 *   dof        in       `count` degrees of freedom of both ends, from 0; -1: does not move
 *   normal     in       how far the member gets longer by each: its direction from the first end
 *                       to the second at the second end, the negative at the first
 *   stiffness  in       k = E A/L > 0, force per length
 * Errors, value is unchanged: FUGE_ERR_SIZE, FUGE_ERR_DOF, FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_LAW, FUGE_ERR_NOT_DEFINITE where the matrix does not contain the member. */
int fuge_remove_member(int degrees, const int *column, const int *row, double *value, int count,
                       const int *dof, const double *normal, double stiffness, char *message,
                       size_t len);

/* Message of the last call on links that added or posed, or of the last error; as
 * fuge_body_message. */
int fuge_links_message(const fuge_links *links, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
