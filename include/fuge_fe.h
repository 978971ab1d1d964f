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
 * From the stiffness matrix K of a body to the influence matrix of its contact points,
 * and back from contact forces to the displacements of the whole body.
 *
 *     fuge_body_dense, _band or _sparse -> fuge_body_fix, _set_load, _set_contact, ..
 *     -> fuge_body_condense -> fuge_body_get_...
 *     -> fuge_operator_dense(alpha), gaps + displacement, solve -> fuge_body_recover
 *     -> fuge_body_free
 *
 * Degrees of freedom count from 0 here, -1 is none; messages count from 1.  K is
 * symmetric, force per displacement, and positive definite once the fixed degrees of
 * freedom are out, or, of a body that floats, semidefinite.
 *
 * Contact point i moves by u_i = sum over k < width of normal[k + i*width] *
 * u[dof[k + i*width]]: `normal` is the direction in which the contact force acts on the
 * body, into the body; the gap opens by u_i.  Two bodies in one K: the degrees of freedom
 * of both sides, with opposite normals. */

typedef struct fuge_body fuge_body;

/* A body by its stiffness.  k: degrees x degrees, both triangles, ldk >= degrees.
 * ab: LAPACK's symmetric band storage with kd diagonals beside the main one, ldab > kd;
 * upper nonzero: K(i,j) = ab[kd + i - j + j*ldab], i <= j, else K(i,j) = ab[i - j + j*ldab],
 * i >= j.  The arrays are not copied: keep them as long as the body.  K is looked at by
 * fuge_body_condense. */
int fuge_body_dense(int degrees, const double *k, int ldk, fuge_body **body);
int fuge_body_band(int degrees, int kd, const double *ab, int ldab, int upper, fuge_body **body);

/* The same for compressed columns: column j holds row[p] and value[p] for
 * column[j] <= p < column[j+1], rows in any order, those named twice are added; both
 * triangles or one of them.  In the library fuge_sparse, which needs CHOLMOD. */
int fuge_body_sparse(int degrees, const int *column, const int *row, const double *value, fuge_body **body);

/* NULL-safe; sets NULL. */
void fuge_body_free(fuge_body **body);

/* Hold `count` degrees of freedom, at the given displacements or (NULL) at zero.  Each
 * call replaces the one before. */
int fuge_body_fix(fuge_body *body, int count, const int *dof, const double *displacement);

/* External load, one force for each degree of freedom.  After fuge_body_condense this costs one
 * solve, and only fuge_body_get_displacement and _get_modes change. */
int fuge_body_set_load(fuge_body *body, const double *load);

/* The body floats: its rigid motions on the supports are given (degrees x m), or looked
 * for.  m = 0: it does not float. */
int fuge_body_set_rigid_modes(fuge_body *body, int m, const double *modes);
int fuge_body_find_rigid_modes(fuge_body *body);

/* Rigid motions of nodes in the plane or in space, from their places: position is
 * dimensions x nodes, modes (dimensions*nodes) x 3 or x 6: translations, then rotations
 * about the centre of the nodes.  FUGE_ERR_SIZE unless dimensions is 2 or 3, nodes > 0. */
int fuge_rigid_modes(int dimensions, int nodes, const double *position, double *modes);

/* n contact points of `width` degrees of freedom each; see above. */
int fuge_body_set_contact(fuge_body *body, int n, int width, const int *dof, const double *normal);

/* Condense: one Cholesky factorisation and n + 4 solves.  FUGE_ERR_DOF, FUGE_ERR_NOT_SYMMETRIC,
 * FUGE_ERR_NOT_DEFINITE (the message names the degree of freedom), FUGE_ERR_MODES,
 * FUGE_ERR_NO_EQUILIBRIUM (a load that no contact can hold); FUGE_WARN_RESIDUAL if K is so
 * near to singular that few digits of alpha may be left. */
int fuge_body_condense(fuge_body *body);

/* Influence matrix, n x n, lda >= n: for fuge_operator_dense. */
int fuge_body_get_influence(const fuge_body *body, double *alpha, int lda);

/* b, n: displacements of the contact points by load and supports; add it to the gaps. */
int fuge_body_get_displacement(const fuge_body *body, double *displacement);

/* Number of rigid motions that the contact has to hold, 0 if the body does not float.
 * Those that move no contact point are left out. */
int fuge_body_get_mode_count(const fuge_body *body, int *m);

/* R, n x m, and w, m, for fuge_set_modes.  Either may be NULL. */
int fuge_body_get_modes(const fuge_body *body, double *modes, double *resultant);

/* Displacements of all degrees of freedom under contact forces (n) and rigid motions (m;
 * NULL if m = 0).  FUGE_WARN_RESIDUAL if K u leaves more than 1e-10 of the forces. */
int fuge_body_recover(const fuge_body *body, const double *force, const double *motion, double *displacement);

/* Message of the last call, cut to len - 1 characters and ended by NUL. */
int fuge_body_message(const fuge_body *body, char *buf, size_t len);

/* ---- matrix files -------------------------------------------------------
 *
 * Matrices, and vectors as matrices of one column, in files of the Matrix Market format:
 * real or integer, array or coordinate, general or symmetric.  FUGE_ERR_FILE: the message
 * (at most len bytes, ended by NUL; may be NULL) has the file, the line and the reason.
 * Unlike in the files, rows and columns count from 0 here. */

/* Read a dense matrix.
 *   path           in   name of the file
 *   lda, capacity  in   matrix has room for lda rows and capacity columns
 *   matrix         out  element (i,j) at i + j*lda; a symmetric one whole; may be NULL
 *   rows, columns  out  of the file; only what fits is written to matrix
 * To ask for the sizes first, give no matrix, lda = capacity = 0. */
int fuge_read_matrix(const char *path, int lda, int capacity, double *matrix, int *rows, int *columns,
                     char *message, size_t len);

/* Read a matrix into compressed columns: column j holds row[p] and value[p] for
 * column[j] <= p < column[j+1], rows ascending; a symmetric one whole, entries of the same
 * place added.
 *   columns_room   in   column has room for columns_room + 1 elements
 *   entries_room   in   row and value have room for so many
 *   column, row, value      out  each may be NULL
 *   rows, columns, entries  out  of the matrix; only what fits is written to the arrays */
int fuge_read_sparse(const char *path, int columns_room, int entries_room, int *column, int *row, double *value,
                     int *rows, int *columns, int *entries, char *message, size_t len);

/* Write a dense matrix (lda >= rows) to a file in array format, with 17 digits; a file that
 * is there is replaced.  symmetric: 1 for a square matrix of which only the lower triangle
 * counts.  FUGE_ERR_NOT_FINITE for NaN and infinity. */
int fuge_write_matrix(const char *path, int rows, int columns, const double *matrix, int lda, int symmetric,
                      char *message, size_t len);

/* The same for compressed columns, in coordinate format; rows in any order. */
int fuge_write_sparse(const char *path, int rows, int columns, const int *column, const int *row,
                      const double *value, int symmetric, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
