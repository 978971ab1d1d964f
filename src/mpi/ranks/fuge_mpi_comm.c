/* Communicators of C as Fortran knows them. */
#include "fuge_mpi.h"

/* 0 while MPI is not running, which the procedures below find out before they use the communicator. */
static int fortran_handle(MPI_Comm comm) {
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  return begun && !ended ? (int)MPI_Comm_c2f(comm) : 0;
}

int fuge_operator_halfspace_comm(int nx, int ny, double spacing_x, double spacing_y, double e_star, int element,
                                 int boundary, int comm, fuge_operator **op, char *message, size_t len);

/* Visible in a shared library, unlike what else is written in C. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
int fuge_operator_halfspace_mpi(int nx, int ny, double spacing_x, double spacing_y, double e_star, int element,
                                int boundary, MPI_Comm comm, fuge_operator **op, char *message, size_t len) {
  return fuge_operator_halfspace_comm(nx, ny, spacing_x, spacing_y, e_star, element, boundary, fortran_handle(comm),
                                      op, message, len);
}

int fuge_operator_halfplane_comm(int n, double spacing, double e_star, int element, int boundary, int comm,
                                 fuge_operator **op, char *message, size_t len);

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
int fuge_operator_halfplane_mpi(int n, double spacing, double e_star, int element, int boundary, MPI_Comm comm,
                                fuge_operator **op, char *message, size_t len) {
  return fuge_operator_halfplane_comm(n, spacing, e_star, element, boundary, fortran_handle(comm), op, message, len);
}

int fuge_operator_layered_halfspace_comm(int nx, int ny, double spacing_x, double spacing_y, int layers,
                                         const double *thickness, const double *young, const double *poisson,
                                         int bonded, double e_star_other, int element, int boundary, int comm,
                                         fuge_operator **op, char *message, size_t len);

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
int fuge_operator_layered_halfspace_mpi(int nx, int ny, double spacing_x, double spacing_y, int layers,
                                        const double *thickness, const double *young, const double *poisson,
                                        int bonded, double e_star_other, int element, int boundary, MPI_Comm comm,
                                        fuge_operator **op, char *message, size_t len) {
  return fuge_operator_layered_halfspace_comm(nx, ny, spacing_x, spacing_y, layers, thickness, young, poisson, bonded,
                                              e_star_other, element, boundary, fortran_handle(comm), op, message, len);
}

int fuge_operator_layered_halfplane_comm(int n, double spacing, int layers, const double *thickness,
                                         const double *young, const double *poisson, int bonded, double e_star_other,
                                         int element, int boundary, int comm, fuge_operator **op, char *message,
                                         size_t len);

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
int fuge_operator_layered_halfplane_mpi(int n, double spacing, int layers, const double *thickness,
                                        const double *young, const double *poisson, int bonded, double e_star_other,
                                        int element, int boundary, MPI_Comm comm, fuge_operator **op, char *message,
                                        size_t len) {
  return fuge_operator_layered_halfplane_comm(n, spacing, layers, thickness, young, poisson, bonded, e_star_other,
                                              element, boundary, fortran_handle(comm), op, message, len);
}
