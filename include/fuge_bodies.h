/* fuge - elastic bodies with their own meshes in contact.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_BODIES_H
#define FUGE_BODIES_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- elastic bodies -----------------------------------------------------
 *
 * From the stiffness matrices and the surfaces of bodies whose meshes need not match to
 * contact forces, pressures and displacements.
 *
 *     fuge_bodies_create -> fuge_bodies_add, for each body -> fuge_bodies_fix, _set_load
 *     -> for each pair of surfaces: fuge_bodies_set_contact, _set_opposite, _add_pair
 *     -> fuge_bodies_solve or fuge_bodies_solve_sparse -> fuge_bodies_get_...
 *     -> fuge_bodies_free
 *
 * Bodies, their degrees of freedom, pairs, nodes and faces count from 0, and each body has
 * its own degrees of freedom.  Bodies may float: rigid motions that the supports leave are
 * found.  Sliding is small, without friction. */

typedef struct fuge_bodies fuge_bodies;

/* No bodies.  *bodies is set on success only.  FUGE_ERR_MEMORY. */
int fuge_bodies_create(fuge_bodies **bodies, char *message, size_t len);

/* Free and set *bodies to NULL; NULL and *bodies == NULL are fine. */
void fuge_bodies_free(fuge_bodies **bodies);

/* Add a body by its stiffness matrix in compressed columns, as fuge_read_stiffness gives
 * them: column j holds row[p] and value[p] for column[j] <= p < column[j+1], rows in any
 * order, repeated entries are added; both triangles or one of them.  The arrays are copied;
 * their contents are checked by fuge_bodies_join and fuge_bodies_solve.
 *   body  out  number of the body: 0 for the first one, and so on; may be NULL
 * FUGE_ERR_SIZE, FUGE_ERR_MEMORY. */
int fuge_bodies_add(fuge_bodies *bodies, int degrees, const int *column, const int *row, const double *value,
                    int *body);

/* Supports and load of a body, as fuge_body_fix and fuge_body_set_load.  Each call replaces
 * the one before.  FUGE_ERR_SIZE if there is no such body. */
int fuge_bodies_fix(fuge_bodies *bodies, int body, int count, const int *dof, const double *displacement);
int fuge_bodies_set_load(fuge_bodies *bodies, int body, const double *load);

/* Rigid modes that the supports of a body leave (degrees x m), for all bodies that float or
 * for none: then they are found. */
int fuge_bodies_set_rigid_modes(fuge_bodies *bodies, int body, int m, const double *rigid_modes);

/* The surfaces of the next pair, as fuge_pairs_set_contact and fuge_pairs_set_opposite, with
 * degrees of freedom of the body; both may be of one body.  body = -1, dof = NULL: the
 * surface is rigid and held in space. */
int fuge_bodies_set_contact(fuge_bodies *bodies, int body, int dimensions, int nodes, const double *node, int most,
                            int faces, const int *face, const int *dof);
int fuge_bodies_set_opposite(fuge_bodies *bodies, int body, int dimensions, int nodes, const double *node, int most,
                             int faces, const int *face, const int *dof);

/* As fuge_pairs_set_geometry, for the pairs that are added from now on. */
int fuge_bodies_set_geometry(fuge_bodies *bodies, double crease, int revolution);

/* Add a pair of these surfaces; arguments as fuge_pairs_find, which are checked, with the
 * surfaces, by fuge_bodies_join and fuge_bodies_solve.  FUGE_ERR_CALL_ORDER without both
 * surfaces, FUGE_ERR_MEMORY. */
int fuge_bodies_add_pair(fuge_bodies *bodies, int method, int normals, const double *normal, double reach,
                         double play, int tied, int smooth);

/* Solve; opt may be NULL.  The matrix of all bodies is kept as a band, whose width depends on
 * the numbering of degrees of freedom; for all but small models use fuge_bodies_solve_sparse,
 * in the library fuge_sparse, which needs CHOLMOD.  Warnings: those of fuge_solve, else those
 * of fuge_body_condense and fuge_body_recover, or FUGE_WARN_PAIRS, or FUGE_WARN_NO_CONTACT:
 * loads and supports open every gap; they pull, or all surfaces look into their bodies.
 * Errors name the body or the pair, the results of the solve before stay: those of
 * fuge_pairs_find, fuge_body_condense and fuge_solve; FUGE_ERR_GAP also where supports hold two
 * surfaces inside each other; FUGE_ERR_MESH also for a surface that looks into its body, which
 * the matrix knows if `node` has the body's other nodes too, with their dof. */
int fuge_bodies_solve(fuge_bodies *bodies, const fuge_options *opt);
int fuge_bodies_solve_sparse(fuge_bodies *bodies, const fuge_options *opt);

/* Contact points n, nodes without an opposite, and bodies.  The getters below give
 * FUGE_ERR_CALL_ORDER before a solve, and each pointer may be NULL. */
int fuge_bodies_get_sizes(const fuge_bodies *bodies, int *n, int *unpaired, int *bodies_number);

/* Contact forces, n; negative only at an upper stop and at tied points, where they are the
 * components along the axes of the force of the contact surface on the opposite one.
 * Pressures, force over area, and gaps under load. */
int fuge_bodies_get_forces(const fuge_bodies *bodies, double *force, double *pressure, double *gap);

/* Where the contact points are, as fuge_pairs_get_points; their areas and initial gaps, n. */
int fuge_bodies_get_points(const fuge_bodies *bodies, int *pair, int *node, int *face, double *place,
                           double *direction);
int fuge_bodies_get_areas(const fuge_bodies *bodies, double *area, double *initial_gap);

/* Pair and node of the nodes that have no opposite, and so are no contact points. */
int fuge_bodies_get_unpaired(const fuge_bodies *bodies, int *pair, int *node);

/* Displacements of all degrees of freedom of one body, length. */
int fuge_bodies_get_displacement(const fuge_bodies *bodies, int body, double *displacement);

/* Report of the last solve, failed or not. */
int fuge_bodies_get_info(const fuge_bodies *bodies, fuge_info *info);

/* Message of the last call on bodies that set or solved, or of the last error; as
 * fuge_body_message. */
int fuge_bodies_message(const fuge_bodies *bodies, char *message, size_t len);

/* ---- bodies as one ------------------------------------------------------
 *
 * For further loads on the same factor, or for points that are excluded: join the bodies,
 * and go the way of fuge_body yourself: fuge_body_sparse with the matrix of all bodies,
 * fuge_body_fix and fuge_body_set_load (degree of freedom j of body k is first[k] + j),
 * fuge_body_find_rigid_modes, fuge_body_set_contact. */

/* Join; FUGE_WARN_PAIRS and errors as fuge_bodies_solve.  The getters below give
 * FUGE_ERR_CALL_ORDER before it, and after a call that sets or adds something. */
int fuge_bodies_join(fuge_bodies *bodies);

/* Degrees of freedom and entries of the matrix of all bodies, contact points n and degrees
 * of freedom of each, `width`. */
int fuge_bodies_get_joined_sizes(const fuge_bodies *bodies, int *degrees, int *entries, int *n, int *width);

/* The upper triangle in compressed columns, as fuge_body_sparse takes it: column has
 * degrees + 1 elements, row and value have `entries`; first: degrees of freedom before those
 * of each body, one more than bodies. */
int fuge_bodies_get_matrix(const fuge_bodies *bodies, int *column, int *row, double *value, int *first);

/* What fuge_body_set_contact takes, width x n, and initial gaps, plays and areas, n. */
int fuge_bodies_get_contact(const fuge_bodies *bodies, int *dof, double *normal, double *gap, double *gap_upper,
                            double *area);

/* ---- meshes with their matrices -----------------------------------------
 *
 * Degrees of freedom of the nodes of a mesh in a stiffness matrix whose rows have names:
 * node and direction (`rows` each) as fuge_read_stiffness gives them.  Programs leave out
 * those of supports.  FUGE_ERR_DOF for rows without names, a row named twice, or a matrix of
 * another mesh; FUGE_ERR_OPTION if the mesh has no such surface or set; FUGE_ERR_MEMORY. */

/* Of a surface, for fuge_bodies_set_contact: dof has dimensions x nodes of the mesh, -1 where
 * the matrix has none.  Nodes are those of fuge_mesh_get_nodes, of whose three coordinates
 * the first two count if dimensions is 2; faces those of fuge_mesh_get_faces.
 * FUGE_ERR_ELEMENT for faces of elements of other dimensions. */
int fuge_mesh_get_surface_dof(const fuge_mesh *mesh, const char *name, int dimensions, int rows, const int *node,
                              const int *direction, int *dof, char *message, size_t len);

/* Of a set of nodes along one direction, 1 to 3 for x, y, z and 4 to 6 for rotations, for
 * fuge_bodies_fix or loads: without nodes that have none.  Only the first `capacity` are
 * written to dof, which may be NULL; *count is their number. */
int fuge_mesh_get_set_dof(const fuge_mesh *mesh, const char *name, int along, int rows, const int *node,
                          const int *direction, int capacity, int *dof, int *count, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
