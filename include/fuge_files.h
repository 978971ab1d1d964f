/* fuge - results on grids and meshes for ParaView.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_FILES_H
#define FUGE_FILES_H

#include <stddef.h>
#include "fuge_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- grids --------------------------------------------------------------- */

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
 * fuge_field_grid_stress: a VTR file.
 *   depth    in  depths, ascending; length       results in  count arrays of nx*ny*depths
 *                                                            values, the first depth first
 * ny = 1 for a half-plane.  FUGE_ERR_GRID for depths that do not ascend. */
int fuge_write_volume(const char *path, int nx, int ny, const double *spacing, const double *origin,
                      int depths, const double *depth, int count, const char *const *names,
                      const double *const *results, char *message, size_t len);

/* ---- meshes -------------------------------------------------------------- */

typedef struct fuge_mesh fuge_mesh;

/* Make a mesh of arrays, nodes and elements get the numbers 1, 2 ..
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
 * and elements of all of them, one mesh after the other.
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

#ifdef __cplusplus
}
#endif

#endif
