/* fuge - surfaces over MPI.  SPDX-License-Identifier: BSD-3-Clause
 *
 * The library fuge_mpi, beside fuge.  Every rank of a communicator has some rows of a grid, all
 * ranks make the same calls in the same order, with the same arguments but for arrays of points, whose n is the number
 * of points of the rank.  A solver of fuge.h solves on an operator of this header as on any other: fuge_solver_new,
 * fuge_set_gap, fuge_set_load or fuge_set_approach, fuge_solve, and the results, where fuge_get_resultant sums over the
 * ranks.  The solution is that of one process, also with modes, play, excluded points, prescribed motions, compliances,
 * limits of forces and motions on springs, and so are derivatives: arrays of points are those of the rank; loads,
 * motions and their stiffnesses are the same on all ranks.  Modes of several bodies, which move no common point, are
 * FUGE_ERR_UNSUPPORTED.
 *
 * An error on one rank ends fuge_solve on all of them with the same status, and the message names the rank.  A call
 * that concerns one rank only, such as fuge_set_gap, may fail on that rank alone: let the ranks agree (MPI_Allreduce of
 * the status) before they go on.  Arrays of a rank without points may be any pointer but NULL, which would mean that
 * it has no gaps, play, compliances or limits where others have them: FUGE_ERR_OPTION.  The library calls
 * neither MPI_Init nor MPI_Abort; free solvers and operators on all ranks before MPI_Finalize. */
#ifndef FUGE_MPI_H
#define FUGE_MPI_H

#include <fuge.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An elastic half-space of nx x ny equal rectangles, as fuge_operator_halfspace, whose rows the ranks of comm share.
 *   nx, ny     in   of the whole grid; spacings, e_star and element as in fuge_operator_halfspace
 *   boundary   in   FUGE_FREE or FUGE_PERIODIC
 *   comm       in   is duplicated
 *   op         out  set on success only, on all ranks; not NULL, on any of them
 * Errors are those of fuge_operator_halfspace, on all ranks; FUGE_ERR_OPTION if the arguments differ between the ranks,
 * FUGE_ERR_UNSUPPORTED for another boundary, FUGE_ERR_CALL_ORDER if MPI is not running. */
int fuge_operator_halfspace_mpi(int nx, int ny, double spacing_x, double spacing_y, double e_star, int element,
                                int boundary, MPI_Comm comm, fuge_operator **op, char *message, size_t len);

/* An elastic half-plane of n equal cells, as fuge_operator_halfplane, which the ranks of comm share.  The cells of a
 * periodic one are shared in lots of its largest divisor up to the square root of n, or of what that leaves: a prime
 * number of cells stays on one rank.
 *   n          in   of the whole line; spacing, e_star, element and boundary as in fuge_operator_halfplane
 *   comm       in   is duplicated
 *   op         out  set on success only, on all ranks; not NULL, on any of them
 * Errors are those of fuge_operator_halfplane, on all ranks; FUGE_ERR_OPTION if the arguments differ between the ranks,
 * FUGE_ERR_CALL_ORDER if MPI is not running. */
int fuge_operator_halfplane_mpi(int n, double spacing, double e_star, int element, int boundary, MPI_Comm comm,
                                fuge_operator **op, char *message, size_t len);

/* Layered bodies, as of fuge_operator_layered_halfspace and fuge_operator_layered_halfplane;
 * the arguments that follow the layers are those of fuge_operator_halfspace_mpi and fuge_operator_halfplane_mpi.
 * Errors are those of both, on all ranks, also where only one rank has wrong layers; FUGE_ERR_OPTION if the layers
 * differ between the ranks. */
int fuge_operator_layered_halfspace_mpi(int nx, int ny, double spacing_x, double spacing_y, int layers,
                                        const double *thickness, const double *young, const double *poisson,
                                        int bonded, double e_star_other, int element, int boundary, MPI_Comm comm,
                                        fuge_operator **op, char *message, size_t len);

int fuge_operator_layered_halfplane_mpi(int n, double spacing, int layers, const double *thickness,
                                        const double *young, const double *poisson, int bonded, double e_star_other,
                                        int element, int boundary, MPI_Comm comm, fuge_operator **op, char *message,
                                        size_t len);

/* The rows of this rank: first, from 0, and their number, 0 where there are fewer rows than ranks.  Its points are
 * nx*rows; point i + nx*j is the cell i of row first + j.  The rows of a half-plane are its cells, nx = 1.
 * FUGE_ERR_UNSUPPORTED for an operator of fuge.h. */
int fuge_operator_rows(const fuge_operator *op, int *first, int *rows, char *message, size_t len);

/* Read values (nx*rows of this rank) from a file of numpy, .npy, an array (ny, nx) of doubles, (n,) of a half-plane, or
 * write one: all ranks together, each its own rows; path and values are not NULL on any rank.  FUGE_ERR_FILE,
 * FUGE_ERR_SIZE for another shape, FUGE_ERR_UNSUPPORTED for an operator of fuge.h; on all ranks, values unchanged. */
int fuge_mpi_read_rows(const char *path, const fuge_operator *op, double *values, char *message, size_t len);
int fuge_mpi_write_rows(const char *path, const fuge_operator *op, const double *values, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
