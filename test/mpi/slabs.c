/* A surface over MPI from C: heights from a file of numpy, pressures to another one, and what is refused. */
#include <fuge_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NX = 150, NY = 131 };

static int failures, rank;

static void expect(int true, const char *what, const char *message) {
  if (true) return;
  failures++;
  printf("rank %d, not as expected: %s: %s\n", rank, what, message);
}

/* The motions of a tilted ball on nx x ny cells, of which `op` has these rows on this rank of comm. */
static void press_tilted(fuge_operator *op, MPI_Comm comm, int nx, int ny, int first, int rows, double *motion,
                         const char *what) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  const double w[3] = {0.01, 0.0002, -0.0001};
  double load[3] = {0, 0, 0};
  int all = 0, k, n = nx * rows, status;
  double *gap = malloc(sizeof *gap * (size_t)(n + 1)), *modes = malloc(sizeof *modes * (size_t)(3 * n + 1));
  fuge_solver *solver = NULL;

  for (k = 0; k < n; k++) {
    modes[k] = 1.0;
    modes[n + k] = (k % nx + 0.5) / nx - 0.5;
    modes[2 * n + k] = (first + k / nx + 0.5) / ny - 0.5;
    gap[k] = 0.5 * (pow(modes[n + k], 2) + pow(modes[2 * n + k], 2));
  }
  status = fuge_solver_new(op, NULL, &solver, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_set_gap(solver, gap, NULL);
  if (status == FUGE_DONE) status = fuge_set_modes(solver, 3, modes, w);
  fuge_solver_message(solver, message, sizeof message);
  expect(status == FUGE_DONE, what, message);
  MPI_Allreduce(&status, &all, 1, MPI_INT, MPI_MIN, comm);
  if (all == FUGE_DONE) {
    status = fuge_solve(solver);
    fuge_solver_message(solver, message, sizeof message);
    expect(status == FUGE_DONE, what, message);
    fuge_get_motion(solver, motion);
    fuge_get_resultant(solver, load);
    for (k = 0; k < 3; k++) expect(fabs(load[k] - w[k]) < 1e-12, what, "resultant");
  }
  status = fuge_set_modes(solver, nx * ny + 1, modes, w);
  expect(status == FUGE_ERR_MODES, what, "more modes than points");
  fuge_solver_free(&solver);
  free(gap);
  free(modes);
}

/* The tilts of a layered half-space are those that one process finds; layers that are wrong on one rank. */
static void tilt_layered(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  const double young[2] = {1.0, HUGE_VAL}, poisson[2] = {0.3, 0.3};
  double thickness = 0.1, motion[3] = {0, 0, 0}, expected[3] = {0, 0, 0};
  int first = 0, k, ranks, rows = 0, status;
  fuge_operator *op = NULL, *whole = NULL;

  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == ranks - 1) thickness = 0.0;
  status = fuge_operator_layered_halfspace_mpi(NX, NY, 1.0 / NX, 1.0 / NX, 1, &thickness, young, poisson, 1, HUGE_VAL,
                                               FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == FUGE_ERR_WIDTH && !op && strstr(message, "thickness 1"), "a thickness on one rank", message);
  thickness = 0.1;
  status = fuge_operator_layered_halfspace_mpi(NX, NY, 1.0 / NX, 1.0 / NX, 1, &thickness, young, poisson, 1, HUGE_VAL,
                                               FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == FUGE_DONE && op, "layers", message);
  fuge_operator_rows(op, &first, &rows, message, sizeof message);
  press_tilted(op, MPI_COMM_WORLD, NX, NY, first, rows, motion, "layers");
  if (rank == 0) {
    fuge_operator_layered_halfspace(NX, NY, 1.0 / NX, 1.0 / NX, 1, &thickness, young, poisson, 1, HUGE_VAL, FUGE_MEAN,
                                    FUGE_FREE, &whole, message, sizeof message);
    press_tilted(whole, MPI_COMM_SELF, NX, NY, 0, NY, expected, "layers on one process");
  }
  MPI_Bcast(expected, 3, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  for (k = 0; k < 3; k++) expect(fabs(motion[k] - expected[k]) < 1e-8 * fabs(expected[0]), "layers", "motion");
  fuge_operator_free(&op);
  fuge_operator_free(&whole);
}

/* Tilts of grids of which ranks have fewer points than there are modes, or none. */
static void tilt(int nx, int ny, const char *what) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  double motion[3] = {0, 0, 0}, expected[3] = {0, 0, 0};
  int first = 0, k, rows = 0;
  fuge_operator *op = NULL, *whole = NULL;

  fuge_operator_halfspace_mpi(nx, ny, 1.0 / nx, 1.0 / nx, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                              sizeof message);
  fuge_operator_rows(op, &first, &rows, message, sizeof message);
  press_tilted(op, MPI_COMM_WORLD, nx, ny, first, rows, motion, what);
  if (rank == 0) {
    fuge_operator_halfspace(nx, ny, 1.0 / nx, 1.0 / nx, 1.0, FUGE_MEAN, FUGE_FREE, &whole, message, sizeof message);
    press_tilted(whole, MPI_COMM_SELF, nx, ny, 0, ny, expected, what);
  }
  MPI_Bcast(expected, 3, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  for (k = 0; k < 3; k++) expect(fabs(motion[k] - expected[k]) < 1e-10 * fabs(expected[0]), what, "motion");
  fuge_operator_free(&op);
  fuge_operator_free(&whole);
}

/* A bed, and limits that are half the largest of the forces of hard contact. */
static void follow_laws(fuge_solver *solver, double *force, int n) {
  char message[FUGE_MESSAGE_LENGTH];
  double largest = 0.0, load = 0.0, *law = malloc(sizeof *law * (size_t)(n + 1));
  int k, limited = 0, status, *state = malloc(sizeof *state * (size_t)(n + 1));

  for (k = 0; k < n; k++) largest = fmax(largest, force[k]);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  for (k = 0; k < n; k++) law[k] = 0.5 * largest;
  status = fuge_set_limits(solver, law, NULL);
  for (k = 0; k < n; k++) law[k] = 0.1;
  if (status == FUGE_DONE) status = fuge_set_compliance(solver, law);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  fuge_solver_message(solver, message, sizeof message);
  expect(status == FUGE_DONE, "laws", message);
  fuge_get_resultant(solver, &load);
  expect(fabs(load - 2.0) < 1e-12, "the load of limits", message);
  fuge_get_force(solver, force);
  fuge_get_states(solver, state);
  for (k = 0; k < n; k++) {
    expect(force[k] <= 0.5 * largest, "a limit", message);
    if (state[k] == FUGE_LIMITED_LOWER) limited++;
  }
  MPI_Allreduce(MPI_IN_PLACE, &limited, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  expect(limited > 0, "points at their limits", message);
  free(law);
  free(state);
}

int main(int argc, char **argv) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "", first_bytes[200];
  const char *path = "slabs_heights.npy", *forces = "slabs_forces.npy";
  double *gap, *read, *force, load = 0, motion;
  int all, first = -1, i, j, rows = -1, status;
  fuge_info info;
  fuge_operator *op = NULL, *dense = NULL;
  fuge_solver *solver = NULL;
  FILE *file;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  status = fuge_operator_halfspace_mpi(NX, NY, 1.0, 1.0, -1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                                       sizeof message);
  expect(status == FUGE_ERR_MODULUS && !op, "a modulus", message);
  status = fuge_operator_halfspace_mpi(NX, NY, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                                       sizeof message);
  expect(status == FUGE_DONE && op, "the operator", message);
  status = fuge_operator_rows(op, &first, &rows, message, sizeof message);
  expect(status == FUGE_DONE && first >= 0 && rows >= 0, "rows", message);
  MPI_Allreduce(&rows, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  expect(all == NY, "all rows", message);
  gap = malloc(sizeof *gap * (size_t)(NX * rows + 1));
  read = malloc(sizeof *read * (size_t)(NX * rows + 1));
  force = malloc(sizeof *force * (size_t)(NX * rows + 1));
  for (j = 0; j < rows; j++)
    for (i = 0; i < NX; i++)
      gap[i + NX * j] = 1e-4 * (pow(2 * i + 1 - NX, 2) + pow(2 * (first + j) + 1 - NY, 2));

  status = fuge_mpi_write_rows(path, op, gap, message, sizeof message);
  expect(status == FUGE_DONE, "write", message);
  if (rank == 0) {
    file = fopen(path, "rb");
    memset(first_bytes, 0, sizeof first_bytes);
    expect(file && fread(first_bytes, 1, 128, file) == 128, "the header", path);
    expect(memcmp(first_bytes, "\223NUMPY\1\0\166\0", 10) == 0 && first_bytes[127] == '\n', "magic", first_bytes + 1);
    expect(strstr(first_bytes + 10, "'fortran_order': False, 'shape': (131, 150), }") != NULL, "shape",
           first_bytes + 10);
    if (file) {
      fseek(file, 0, SEEK_END);
      expect(ftell(file) == 128 + 8L * NX * NY, "the length", path);
      fclose(file);
    }
  }
  status = fuge_mpi_read_rows(path, op, read, message, sizeof message);
  expect(status == FUGE_DONE && memcmp(read, gap, sizeof *gap * (size_t)(NX * rows)) == 0, "read", message);
  status = fuge_mpi_read_rows("no/such/file.npy", op, read, message, sizeof message);
  expect(status == FUGE_ERR_FILE, "no file", message);

  status = fuge_solver_new(op, NULL, &solver, message, sizeof message);
  expect(status == FUGE_DONE, "the solver", message);
  status = fuge_solve(solver);
  expect(status == FUGE_ERR_CALL_ORDER, "no gaps", "");
  if (rank != 1) fuge_set_gap(solver, read, NULL);
  fuge_set_load(solver, 2.0);
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  if (all > 1) {
    status = fuge_solve(solver);
    fuge_solver_message(solver, message, sizeof message);
    expect(status == FUGE_ERR_CALL_ORDER && strncmp(message, "rank 1: ", 8) == 0, "no gaps on one rank", message);
  }
  status = fuge_set_gap(solver, read, NULL);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  fuge_solver_message(solver, message, sizeof message);
  expect(status == FUGE_DONE, "solve", message);
  fuge_get_force(solver, force);
  fuge_get_motion(solver, &motion);
  fuge_get_resultant(solver, &load);
  fuge_get_info(solver, &info);
  expect(fabs(load - 2.0) < 1e-12 && info.contacts > 0 && motion > 0, "the load", message);
  status = fuge_mpi_write_rows(forces, op, force, message, sizeof message);
  expect(status == FUGE_DONE, "write forces", message);
  if (rank == 0) printf("contacts %d products %d approach %.12g\n", info.contacts, info.products, motion);
  follow_laws(solver, force, NX * rows);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);

  status = fuge_operator_halfspace(2, 2, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, &dense, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_operator_rows(dense, &first, &rows, message, sizeof message);
  expect(status == FUGE_ERR_UNSUPPORTED, "another operator", message);
  fuge_operator_free(&dense);

  /* Another shape than that of the file. */
  fuge_operator_halfspace_mpi(NY, NX, 1.0, 1.0, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                              sizeof message);
  fuge_operator_rows(op, &first, &rows, message, sizeof message);
  read = realloc(read, sizeof *read * (size_t)(NY * rows + 1));
  status = fuge_mpi_read_rows(path, op, read, message, sizeof message);
  expect(status == FUGE_ERR_SIZE && strstr(message, "(131, 150)") != NULL, "another shape", message);
  fuge_operator_free(&op);

  tilt_layered();
  tilt(25, 5, "a tilt, all points on one rank");
  tilt(2, 8193, "a tilt, two points on the last rank with any");

  free(gap);
  free(read);
  free(force);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) {
    remove(path);
    remove(forces);
  }
  MPI_Allreduce(MPI_IN_PLACE, &failures, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  return failures > 0;
}
