/* fuge - profiles, surfaces, matrices and meshes in files.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_FILES_H
#define FUGE_FILES_H

#include <stddef.h>
#include "fuge_fe.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- profiles ----------------------------------------------------------- */

/* Read a profile from a text file: on each line x and z, separated by blanks, tabs, a
 * comma or a semicolon; x strictly increasing, 2 points or more.  Blank lines, comments
 * after # or ! and one line of words before the numbers are skipped.  Heights z are
 * positive upwards: the initial gap of two profiles is upper - lower.
 *   path      in   name of the file
 *   capacity  in   length of x and z
 *   x, z      out  in the unit of the file; each may be NULL
 *   count     out  points in the file, of which the first capacity are written
 * FUGE_ERR_FILE: the message has the file, the line and the reason. */
int fuge_read_profile(const char *path, int capacity, double *x, double *z, int *count,
                      char *message, size_t len);

/* Heights of the profile x, z (n >= 2, x strictly increasing) by linear interpolation.
 *   centre  in   length `points`, in any order, within x[0] .. x[n-1]; length
 *   height  out  length `points`; it may not overlap another array
 * FUGE_ERR_WIDTH: a centre is outside, or x does not increase. */
int fuge_sample_profile(int n, const double *x, const double *z, int points, const double *centre,
                        double *height, char *message, size_t len);

enum {                          /* form */
  FUGE_LEVEL_MEAN = 0,          /* the mean height */
  FUGE_LEVEL_LINE = 1           /* the least-squares line */
};

/* Subtract the mean or the line from z (n >= 2), in place.  Each point is weighted by the
 * length it stands for. */
int fuge_level_profile(int n, const double *x, double *z, int form, char *message, size_t len);

/* ---- surfaces ----------------------------------------------------------- */

enum {                          /* format of a file of heights */
  FUGE_FILE_ANY = 0,            /* recognised: SDF by its first line, points by three columns */
  FUGE_FILE_GRID = 1,           /* a line for each row of points, with their heights */
  FUGE_FILE_POINTS = 2,         /* x, y and height of a point on each line, in any order */
  FUGE_FILE_SDF = 3             /* ISO 25178-71, text or binary, in metres */
};

/* Read a surface, heights on a regular grid, positive upwards: the initial gap of a surface
 * below a plane is the greatest height minus the height.
 *   path       in   name of the file
 *   format     in   FUGE_FILE_...
 *   fill       in   0: points that were not measured are refused; 1: they get the mean height of
 *                   their neighbours, from the rim of a hole inwards
 *   capacity   in   length of height
 *   height     out  height of point i + nx*j, of which the first capacity are written; NULL if
 *                   not needed; in the unit of the file
 *   nx, ny     out  numbers of points along x and along y
 *   spacing    out  2, along x and along y; 0 if the file does not say; NULL if not needed
 *   origin     out  2, position of point 0; NULL if not needed
 *   filled     out  number of points that were filled; NULL if not needed
 * The formats are described in doc/files.md.  FUGE_ERR_FILE: the message has the file, the line
 * and the reason.  FUGE_ERR_OPTION, FUGE_ERR_MEMORY. */
int fuge_read_surface(const char *path, int format, int fill, int capacity, double *height,
                      int *nx, int *ny, double *spacing, double *origin, int *filled,
                      char *message, size_t len);

/* Write a surface as a plain grid of 17 digits, which fuge_read_surface reads back to the last
 * bit; spacing (2, NULL or 0: unknown) goes to comments.  An existing file is replaced.
 * FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_WIDTH, FUGE_ERR_FILE. */
int fuge_write_surface(const char *path, int nx, int ny, const double *spacing,
                       const double *height, char *message, size_t len);

/* Fill the points of a surface that were not measured, as fuge_read_surface does.
 *   height  in/out  nx*ny, point i + nx*j; each NaN becomes the mean height of its neighbours, from
 *                   the rim of a hole inwards
 *   filled  out     number of points that were filled; NULL if not needed
 * FUGE_ERR_SIZE, FUGE_ERR_NOT_FINITE for infinity and if all heights are NaN, FUGE_ERR_OVERFLOW,
 * FUGE_ERR_MEMORY. */
int fuge_fill_surface(int nx, int ny, double *height, int *filled, char *message, size_t len);

enum { FUGE_LEVEL_PLANE = 2 };  /* form, besides FUGE_LEVEL_MEAN: the least-squares plane */

/* Subtract the mean or the plane from height (nx*ny, point i + nx*j), in place. */
int fuge_level_surface(int nx, int ny, double *height, int form, char *message, size_t len);

/* Write results, one value for each cell of a grid, for ParaView: a VTI file, doubles as they are.
 *   spacing  in  2, sizes of a cell; length      origin  in  2, centre of cell 0; NULL: 0, 0
 *   count    in  number of results
 *   names    in  count; all different            results in  count arrays of nx*ny values
 * An existing file is replaced.  FUGE_ERR_SIZE, FUGE_ERR_WIDTH, FUGE_ERR_NOT_FINITE,
 * FUGE_ERR_OPTION for a name, FUGE_ERR_MEMORY, FUGE_ERR_FILE. */
int fuge_write_results(const char *path, int nx, int ny, const double *spacing, const double *origin,
                       int count, const char *const *names, const double *const *results,
                       char *message, size_t len);

/* The same at the centres of the cells and at several depths, such as the stresses of
 * fuge_halfspace_stress_grid: a VTR file.
 *   depth    in  depths, ascending; length       results in  count arrays of nx*ny*depths
 *                                                            values, the first depth first
 * ny = 1 for a half-plane.  FUGE_ERR_GRID for depths that do not ascend. */
int fuge_write_volume(const char *path, int nx, int ny, const double *spacing, const double *origin,
                      int depths, const double *depth, int count, const char *const *names,
                      const double *const *results, char *message, size_t len);

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
int fuge_read_matrix(const char *path, int lda, int capacity, double *matrix, int *rows,
                     int *columns, char *message, size_t len);

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
int fuge_write_matrix(const char *path, int rows, int columns, const double *matrix, int lda,
                      int symmetric, char *message, size_t len);

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
 * Nodes and elements have the order of the file; their indices in it count from 0. */

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

/* Number of each element in the file; element k has the nodes connection[p], indices, for
 * first[k] <= p < first[k+1].  Each may be NULL. */
int fuge_mesh_get_elements(const fuge_mesh *mesh, int *element, int *first, int *connection);

/* Type of element k in upper case, such as C3D8; at most 16 characters and NUL.
 * FUGE_ERR_SIZE if there is no such element. */
int fuge_mesh_get_type(const fuge_mesh *mesh, int k, char *type, size_t type_len);

/* Numbers of sets of nodes, of elements, and of surfaces.  Each may be NULL. */
int fuge_mesh_get_set_counts(const fuge_mesh *mesh, int *node_sets, int *element_sets,
                             int *surfaces);

/* Name of set or surface k in upper case; at most 80 characters and NUL.  FUGE_ERR_SIZE if
 * there is none. */
int fuge_mesh_get_node_set_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);
int fuge_mesh_get_element_set_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);
int fuge_mesh_get_surface_name(const fuge_mesh *mesh, int k, char *name, size_t name_len);

/* Indices of the members of a set; `name` in upper or lower case.  Only the first `capacity` are
 * written to member, which may be NULL; *count is their number.  FUGE_ERR_OPTION if the
 * mesh has no such set; the message has the names of those it has. */
int fuge_mesh_get_node_set(const fuge_mesh *mesh, const char *name, int capacity, int *member,
                           int *count, char *message, size_t len);
int fuge_mesh_get_element_set(const fuge_mesh *mesh, const char *name, int capacity, int *member,
                              int *count, char *message, size_t len);

/* Nodes of the faces of a surface, indices, 8 for each face: corners first, then those on the
 * edges, -1 beyond.  Corners of a solid's face follow each other counter-clockwise if it is seen
 * from outside; an edge of an element of a plane goes counter-clockwise round the element.
 * FUGE_ERR_OPTION if the mesh has no such surface, FUGE_ERR_ELEMENT for a type without such a
 * face, FUGE_ERR_MESH for a face that looks into its element, because that is numbered the wrong
 * way round. */
int fuge_mesh_get_faces(const fuge_mesh *mesh, const char *name, int capacity, int *faces,
                        int *count, char *message, size_t len);

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
int fuge_mesh_get_surface_dof(const fuge_mesh *mesh, const char *name, int dimensions, int rows,
                              const int *node, const int *direction, int *dof, char *message,
                              size_t len);

/* Of a set of nodes along one direction, 1 to 3 for x, y, z and 4 to 6 for rotations, for
 * fuge_bodies_fix or loads: without nodes that have none.  Only the first `capacity` are
 * written to dof, which may be NULL; *count is their number. */
int fuge_mesh_get_set_dof(const fuge_mesh *mesh, const char *name, int along, int rows,
                          const int *node, const int *direction, int capacity, int *dof, int *count,
                          char *message, size_t len);

/* ---- decks --------------------------------------------------------------
 *
 * What the deck of a finite element program says beside the mesh and the stiffness matrix:
 * one-way links between nodes, and load cases with their supports.  Nastran: CGAP with PGAP,
 * CBUSH1D with PBUSH1D and TABLED1, FORCE, MOMENT, LOAD, SPC, SPC1, SPCADD, SPCD, and SUBCASE,
 * LOAD =, SPC = of the case control; Abaqus and CalculiX: GAPUNI, GAPCYL, GAPSPHER with *GAP,
 * *BOUNDARY, *CLOAD, and each static *STEP as a load case.  Contact, springs and loads that are
 * not read are refused.  The stiffness matrix must not have the links.
 *
 * A link opens by direction . (u_b - u_a), where the ground, node 0, does not move: its gap is
 * gap plus that, and its force f >= 0 acts on node b along the direction, on node a against it. */

typedef struct fuge_deck fuge_deck;

/* Read a deck, whose format is known by its content.  *deck is set on success only.
 * FUGE_ERR_FILE: the message has the file, the line, the card and the reason; FUGE_ERR_MEMORY. */
int fuge_read_deck(const char *path, fuge_deck **deck, char *message, size_t len);

/* A deck without links and load cases, for tables.  FUGE_ERR_MEMORY. */
int fuge_deck_create(fuge_deck **deck);

/* Free and set *deck to NULL; NULL and *deck == NULL are fine. */
void fuge_deck_free(fuge_deck **deck);

/* Add what a table has; columns between commas, semicolons or blanks, comments from # on:
 *   links     node_a, node_b, x, y, z, gap, play, stiffness, limit, name; from gap on columns
 *             may be blank: 0, one-sided, rigid, no limit
 *   supports  node, directions such as xyz or 123, displacement; of all cases and of the model
 *   cases     node.direction, such as 17.3, and a force for each case; the first line may name
 *             them.  They have the supports of the model
 * FUGE_ERR_FILE with file, line and reason, *deck unchanged; FUGE_ERR_MEMORY. */
int fuge_deck_read_links(fuge_deck *deck, const char *path, char *message, size_t len);
int fuge_deck_read_supports(fuge_deck *deck, const char *path, char *message, size_t len);
int fuge_deck_read_cases(fuge_deck *deck, const char *path, char *message, size_t len);

/* Numbers of links and of load cases.  Either may be NULL. */
int fuge_deck_get_counts(const fuge_deck *deck, int *links, int *cases);

/* The links: numbers of the nodes in the file, 0 for the ground, unit vectors (3 x links), gap
 * (length), play (distance of the second stop), compliance (length per force) and limit (force);
 * INFINITY where there is no second stop or no limit.  Each may be NULL. */
int fuge_deck_get_links(const fuge_deck *deck, int *node_a, int *node_b, double *direction,
                        double *gap, double *play, double *compliance, double *limit);

/* Name of link k, card and number such as CGAP 12, and of load case k, such as SUBCASE 3; at
 * most 80 characters and NUL.  FUGE_ERR_SIZE if there is none. */
int fuge_deck_get_link_name(const fuge_deck *deck, int k, char *name, size_t name_len);
int fuge_deck_get_case_name(const fuge_deck *deck, int k, char *name, size_t name_len);

/* The links for fuge_body_set_links, with names and laws; free them by fuge_links_free.  *links is
 * set on success only.  node and direction name the `rows` rows of the matrix, as
 * fuge_read_stiffness gives them, here and below.  A row that the matrix does not have must be
 * held in every load case.  FUGE_ERR_SIZE without links; FUGE_ERR_DOF for rows without names, a
 * row named twice, a link that no row moves, or one at a degree of freedom that has no row
 * although it is not held; FUGE_ERR_MEMORY. */
int fuge_deck_make_links(const fuge_deck *deck, int rows, const int *node, const int *direction,
                         fuge_links **links, char *message, size_t len);

/* External forces of all load cases (rows x cases).  FUGE_ERR_DOF also for a force without a row
 * where the case does not hold the node; FUGE_ERR_MEMORY. */
int fuge_deck_get_loads(const fuge_deck *deck, int rows, const int *node, const int *direction,
                        double *loads, char *message, size_t len);

/* Degrees of freedom that load case k holds, and their displacements.  Only the first `capacity`
 * are written to dof and displacement, which may be NULL; *count is their number.
 * FUGE_ERR_SIZE if there is no such case; FUGE_ERR_DOF also for a displacement without a row. */
int fuge_deck_get_supports(const fuge_deck *deck, int k, int rows, const int *node,
                           const int *direction, int capacity, int *dof, double *displacement,
                           int *count, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
