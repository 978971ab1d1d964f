/* fuge - what finite element programs need.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_FE_H
#define FUGE_FE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- condensation -------------------------------------------------------
 *
 * From the stiffness matrix K of a body to the influence matrix of its contact points (a
 * Schur complement), and back from contact forces to the displacements of the whole body.
 *
 *     fuge_body_dense, _band or _sparse -> fuge_body_fix, _set_load, _set_contact, ..
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
 * freedom of both surfaces, with opposite normals. */

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
 * triangles or one of them.  In the library fuge_sparse, which needs CHOLMOD. */
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
int fuge_body_recover(const fuge_body *body, const double *force, const double *motion, double *displacement);

/* Message of the last call on body; a getter that succeeds leaves that of the call before.
 * At most len bytes are written, always ended by NUL. */
int fuge_body_message(const fuge_body *body, char *message, size_t len);

/* ---- matrix files -------------------------------------------------------
 *
 * Matrices, and vectors as matrices of one column, in files of the Matrix Market format:
 * real or integer, array or coordinate, general or symmetric.  FUGE_ERR_FILE: the message
 * has the file, the line and the reason.  Rows and columns count from 0 in the arguments,
 * from 1 in the files and in messages about their contents. */

/* Read a dense matrix.
 *   path           in   name of the file
 *   lda, capacity  in   rows and columns that fit into matrix
 *   matrix         out  element (i,j) at i + j*lda, both triangles of a symmetric matrix;
 *                       may be NULL
 *   rows, columns  out  sizes in the file; only what fits is written to matrix
 * To get the sizes first, pass matrix = NULL and lda = capacity = 0. */
int fuge_read_matrix(const char *path, int lda, int capacity, double *matrix, int *rows, int *columns,
                     char *message, size_t len);

/* Read a matrix into compressed columns: column j holds row[p] and value[p] for
 * column[j] <= p < column[j+1], rows ascending; both triangles of a symmetric matrix;
 * repeated entries are added.
 *   column_capacity  in   columns that fit into column, which has one element more
 *   entry_capacity   in   length of row and value
 *   column, row, value      out  each may be NULL
 *   rows, columns, entries  out  sizes of the matrix; only what fits is written */
int fuge_read_sparse(const char *path, int column_capacity, int entry_capacity, int *column,
                     int *row, double *value, int *rows, int *columns, int *entries,
                     char *message, size_t len);

/* Write a dense matrix (lda >= rows) to a file in array format, with 17 digits; an existing
 * file is replaced.  symmetric: 1 for a square matrix of which only the lower triangle is
 * read, else 0.  FUGE_ERR_NOT_FINITE for NaN and infinity; FUGE_ERR_FILE if the disk is
 * full, the file is empty then. */
int fuge_write_matrix(const char *path, int rows, int columns, const double *matrix, int lda, int symmetric,
                      char *message, size_t len);

/* The same for compressed columns, in coordinate format; rows in any order. */
int fuge_write_sparse(const char *path, int rows, int columns, const int *column, const int *row,
                      const double *value, int symmetric, char *message, size_t len);

/* ---- stiffness files ----------------------------------------------------
 *
 * Stiffness matrices from files of finite element programs.  FUGE_ERR_FILE: the message has
 * the file, the line and the reason. */

/* Format of a file: recognised by its content; Matrix Market; CalculiX's job.sti; Abaqus's
 * *MATRIX OUTPUT, FORMAT=MATRIX INPUT or COORDINATE; Nastran's DMIG, and formatted OUTPUT4. */
enum {
  FUGE_STIFFNESS_ANY = 0,
  FUGE_STIFFNESS_MATRIX_MARKET = 1,
  FUGE_STIFFNESS_CALCULIX = 2,
  FUGE_STIFFNESS_ABAQUS = 3,
  FUGE_STIFFNESS_DMIG = 4,
  FUGE_STIFFNESS_OP4 = 5
};

/* Read a stiffness matrix into compressed columns, as fuge_body_sparse takes them: both
 * triangles, rows ascending, counted from 0.  Where entries name nodes, rows ascend by nodes
 * and directions.
 *   format           in   FUGE_STIFFNESS_..
 *   names_path       in   file with a line node.direction for each row of a matrix whose
 *                         entries have numbers only; NULL: job.dof for a path job.sti,
 *                         otherwise none
 *   name             in   which matrix of a file of Nastran, such as KAAX; NULL: the only one
 *   row_capacity     in   rows that fit into node, direction and column, which has one
 *                         element more
 *   entry_capacity   in   length of row and value
 *   column, row, value   out  each may be NULL
 *   node, direction  out  node of each row, and its direction, 1 to 3 along x, y, z, 4 to 6
 *                         about them; 0 where no name is known; each may be NULL
 *   rows, entries    out  sizes of the matrix; only what fits is written
 * FUGE_ERR_FILE, FUGE_ERR_OPTION for format, FUGE_ERR_MEMORY. */
int fuge_read_stiffness(const char *path, int format, const char *names_path, const char *name,
                        int row_capacity, int entry_capacity, int *column, int *row, double *value,
                        int *node, int *direction, int *rows, int *entries,
                        char *message, size_t len);

/* ---- mesh files ---------------------------------------------------------
 *
 * Nodes, elements, sets and surfaces from input files of Abaqus and CalculiX: *NODE,
 * *ELEMENT, *NSET (GENERATE, ELSET), *ELSET (GENERATE), *SURFACE (faces S1 to S6, SPOS, SNEG, or
 * nodes, which become a set), *INCLUDE; other keywords are skipped, *TRANSFORM too: the mesh
 * does not depend on it, but the rows of a stiffness matrix may have the turned directions.
 * Nodes and elements have the order of the file; places in it count from 0. */

typedef struct fuge_mesh fuge_mesh;

/* Read a file.  *mesh is set on success only.  FUGE_ERR_FILE: the message has the file, the
 * line and the reason; FUGE_ERR_MEMORY. */
int fuge_read_mesh(const char *path, fuge_mesh **mesh, char *message, size_t len);

/* Make a mesh of arrays, without sets and surfaces; nodes and elements get the numbers 1, 2 ..
 *   position  dimensions x nodes
 *   element   nodes of each element, from 0, in the order of Abaqus and CalculiX, most x
 *             elements; unused places, at the end, are -1
 *   type      such as "C3D8" or "CPE4", one for each element (types = elements) or one for
 *             all (types = 1)
 * *mesh is set on success only.  FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_ELEMENT for an
 * element that has not as many nodes as its type, FUGE_ERR_MEMORY. */
int fuge_mesh_create(int dimensions, int nodes, const double *position, int most, int elements,
                     const int *element, int types, const char *const *type, fuge_mesh **mesh,
                     char *message, size_t len);

/* Join `count` meshes, such as those of several bodies, to one, for fuge_write_mesh: nodes
 * and elements of all of them, one mesh after the other, without sets and surfaces.
 * *joined is set on success only.  FUGE_ERR_SIZE, FUGE_ERR_MEMORY. */
int fuge_mesh_join(int count, const fuge_mesh *const *mesh, fuge_mesh **joined,
                   char *message, size_t len);

/* Write a mesh and fields at its nodes or elements to a VTK file (.vtu), which ParaView
 * reads; an existing file is replaced.
 *   count       number of fields, 0 or more; then the rest may be NULL
 *   name        of each field, different, 1 to 80 characters
 *   components  of each field: 1, or 2 or 3 of a vector; a third one is added to two
 *   elements    1: field k belongs to the elements, 0: to the nodes; NULL: all to the nodes
 *   field       values of each field, components x nodes or elements, finite
 * FUGE_ERR_SIZE, FUGE_ERR_ELEMENT for a type of elements that is not known,
 * FUGE_ERR_NOT_FINITE, FUGE_ERR_OPTION for a name, FUGE_ERR_MEMORY; FUGE_ERR_FILE, if the
 * disk is full the file is empty then. */
int fuge_write_mesh(const char *path, const fuge_mesh *mesh, int count, const char *const *name,
                    const int *components, const int *elements, const double *const *field,
                    char *message, size_t len);

/* Free and set *mesh to NULL; NULL and *mesh == NULL are fine. */
void fuge_mesh_free(fuge_mesh **mesh);

/* Numbers of nodes, of elements, and of the nodes of all elements together. */
int fuge_mesh_get_sizes(const fuge_mesh *mesh, int *nodes, int *elements, int *connections);

/* Number of each node in the file, and its position (3 x nodes).  Either may be NULL. */
int fuge_mesh_get_nodes(const fuge_mesh *mesh, int *node, double *position);

/* Number of each element in the file; element k has the nodes connection[p], places, for
 * first[k] <= p < first[k+1].  Each may be NULL. */
int fuge_mesh_get_elements(const fuge_mesh *mesh, int *element, int *first, int *connection);

/* Type of element k in upper case, such as C3D8; at most 16 characters and NUL.
 * FUGE_ERR_SIZE if there is no such element. */
int fuge_mesh_get_type(const fuge_mesh *mesh, int k, char *type, size_t type_len);

/* Numbers of sets of nodes, of elements, and of surfaces.  Each may be NULL. */
int fuge_mesh_get_set_counts(const fuge_mesh *mesh, int *node_sets, int *element_sets, int *surfaces);

/* Name of set or surface k in upper case; at most 80 characters and NUL.  FUGE_ERR_SIZE if
 * there is none. */
int fuge_mesh_get_node_set_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);
int fuge_mesh_get_element_set_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);
int fuge_mesh_get_surface_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);

/* Places of the members of a set; `name` in upper or lower case.  Only the first `capacity` are
 * written to member, which may be NULL; *count is their number.  FUGE_ERR_OPTION if the
 * mesh has no such set; the message has the names of those it has. */
int fuge_mesh_get_node_set(const fuge_mesh *mesh, const char *name, int capacity, int *member, int *count,
                           char *message, size_t len);
int fuge_mesh_get_element_set(const fuge_mesh *mesh, const char *name, int capacity, int *member, int *count,
                              char *message, size_t len);

/* Nodes of the faces of a surface, places, 8 for each face: corners first, then those on the
 * edges, -1 beyond.  Corners of a solid's face follow each other counter-clockwise if it is seen
 * from outside; an edge of an element of a plane goes counter-clockwise round the element.
 * FUGE_ERR_OPTION if the mesh has no such surface, FUGE_ERR_ELEMENT for a type without such a
 * face, FUGE_ERR_MESH for a face that looks into its element, because that is numbered the wrong
 * way round. */
int fuge_mesh_get_faces(const fuge_mesh *mesh, const char *name, int capacity, int *faces, int *count,
                        char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
