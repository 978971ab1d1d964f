/* A half-plane over MPI from C: gaps to a file of numpy and back, a solution, and what is refused. */
#include <fuge_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 40000 };

static int failures, rank;

static void expect(int true, const char *what, const char *message) {
  if (true) return;
  failures++;
  printf("rank %d, not as expected: %s: %s\n", rank, what, message);
}

/* Products of the cells of a rank are those of one process, `alone`; an error on one rank is one on all of them. */
static void expect_products(const fuge_operator *op, const fuge_operator *alone, int first, int rows) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  double *force = malloc(sizeof *force * N), *whole = malloc(sizeof *whole * N), *own = malloc(sizeof *own * N);
  double difference = 0, largest = 0;
  int i, status;
  for (i = 0; i < N; i++) force[i] = 1 + i % 7;
  status = fuge_operator_apply(alone, N, force, whole, message, sizeof message);
  expect(status == FUGE_DONE, "a product of one process", message);
  status = fuge_operator_apply(op, rows, force + (rows > 0 ? first : 0), own, message, sizeof message);
  expect(status == FUGE_DONE, "a product", message);
  for (i = 0; i < rows; i++) {
    largest = fmax(largest, fabs(whole[first + i]));
    difference = fmax(difference, fabs(own[i] - whole[first + i]));
  }
  expect(difference <= 1e-11 * largest, "displacements of a product", "");
  if (rank == 0) force[first] = NAN;
  status = fuge_operator_apply(op, rows, force + (rows > 0 ? first : 0), own, message, sizeof message);
  expect(status == FUGE_ERR_NOT_FINITE, "a force that is not finite, on rank 0", message);
  free(force);
  free(whole);
  free(own);
}

/* A layered half-plane, and layers that are wrong on one rank, or differ between the ranks. */
static void expect_layers(void) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  const double young[3] = {1.0, 5.0, 20.0}, poisson[3] = {0.3, 0.2, 0.4};
  double thickness[2] = {0.01, 0.05};
  int first = -1, ranks, rows = -1, status;
  fuge_operator *op = NULL, *alone = NULL;

  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == ranks - 1) thickness[1] = -1.0;
  status = fuge_operator_layered_halfplane_mpi(N, 1.0 / N, 2, thickness, young, poisson, 1, HUGE_VAL, FUGE_MEAN,
                                               FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == FUGE_ERR_WIDTH && !op && strstr(message, "thickness 2"), "a thickness on one rank", message);
  thickness[1] = rank == ranks - 1 ? 0.04 : 0.05;
  status = fuge_operator_layered_halfplane_mpi(N, 1.0 / N, 2, thickness, young, poisson, 1, HUGE_VAL, FUGE_MEAN,
                                               FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == (ranks > 1 ? FUGE_ERR_OPTION : FUGE_DONE), "another thickness on one rank", message);
  fuge_operator_free(&op);
  thickness[1] = 0.05;
  status = fuge_operator_layered_halfplane_mpi(N, 1.0 / N, 2, thickness, young, poisson, 1, HUGE_VAL, FUGE_MEAN,
                                               FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_operator_rows(op, &first, &rows, message, sizeof message);
  expect(status == FUGE_DONE && op, "a layered half-plane", message);
  status = fuge_operator_layered_halfplane(N, 1.0 / N, 2, thickness, young, poisson, 1, HUGE_VAL, FUGE_MEAN, FUGE_FREE,
                                           &alone, message, sizeof message);
  expect(status == FUGE_DONE && alone, "a layered half-plane of one process", message);
  if (op && alone) expect_products(op, alone, first, rows);
  fuge_operator_free(&op);
  fuge_operator_free(&alone);
}

int main(int argc, char **argv) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "", header[129] = "";
  const char *path = "line_gaps.npy";
  double *gap, *read, load = 0, motion = 0, half_width;
  int all, first = -1, i, rows = -1, status;
  fuge_info info;
  fuge_options options;
  fuge_operator *op = NULL, *alone = NULL;
  fuge_solver *solver = NULL;
  FILE *file;

  status = fuge_operator_halfplane_mpi(N, 1.0 / N, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                                       sizeof message);
  expect(status == FUGE_ERR_CALL_ORDER && !op, "before MPI runs", message);
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  status = fuge_operator_halfplane_mpi(N, 0.0, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == FUGE_ERR_WIDTH && !op, "a width", message);
  status = fuge_operator_halfplane_mpi(N, 1.0 / N, 1.0, FUGE_MEAN, 9, MPI_COMM_WORLD, &op, message, sizeof message);
  expect(status == FUGE_ERR_OPTION && !op, "a boundary", message);
  status = fuge_operator_halfplane_mpi(N, 1.0 / N, 1.0, FUGE_MEAN, FUGE_FREE, MPI_COMM_WORLD, &op, message,
                                       sizeof message);
  expect(status == FUGE_DONE && op, "the operator", message);
  status = fuge_operator_rows(op, &first, &rows, message, sizeof message);
  expect(status == FUGE_DONE && first >= 0 && rows >= 0, "cells", message);
  MPI_Allreduce(&rows, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  expect(all == N, "all cells", message);
  gap = malloc(sizeof *gap * (size_t)(rows + 1));
  read = malloc(sizeof *read * (size_t)(rows + 1));
  for (i = 0; i < rows; i++) gap[i] = 0.5 * pow((first + i + 0.5) / N - 0.5, 2);

  status = fuge_mpi_write_rows(path, op, gap, message, sizeof message);
  expect(status == FUGE_DONE, "write", message);
  if (rank == 0) {
    file = fopen(path, "rb");
    expect(file && fread(header, 1, 128, file) == 128, "the header", path);
    expect(strstr(header + 10, "'shape': (40000,), }") != NULL, "shape", header + 10);
    if (file) fclose(file);
  }
  status = fuge_mpi_read_rows(path, op, read, message, sizeof message);
  expect(status == FUGE_DONE && memcmp(read, gap, sizeof *gap * (size_t)rows) == 0, "read", message);

  status = fuge_operator_halfplane(N, 1.0 / N, 1.0, FUGE_MEAN, FUGE_FREE, &alone, message, sizeof message);
  expect(status == FUGE_DONE && alone, "a half-plane of one process", message);
  if (alone) expect_products(op, alone, first, rows);
  fuge_operator_free(&alone);
  expect_layers();

  /* Each rank may have threads of its own number. */
  fuge_default_options(&options);
  options.threads = 1 + rank;
  status = fuge_solver_new(op, &options, &solver, message, sizeof message);
  if (status == FUGE_DONE) status = fuge_set_gap(solver, read, NULL);
  if (status == FUGE_DONE) status = fuge_set_load(solver, 0.01);
  if (status == FUGE_DONE) status = fuge_solve(solver);
  fuge_solver_message(solver, message, sizeof message);
  expect(status == FUGE_DONE, "solve", message);
  fuge_get_motion(solver, &motion);
  fuge_get_resultant(solver, &load);
  fuge_get_info(solver, &info);
  /* Hertz: the half-width of the contact of a cylinder of radius 1. */
  half_width = sqrt(4 * 0.01 / acos(-1.0));
  expect(fabs(load - 0.01) < 1e-14, "the load", message);
  expect(fabs(info.contacts - 2 * half_width * N) < 3, "the width of the contact", message);
  if (rank == 0) printf("contacts %d products %d approach %.12g\n", info.contacts, info.products, motion);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);

  free(gap);
  free(read);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) remove(path);
  MPI_Allreduce(MPI_IN_PLACE, &failures, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  return failures > 0;
}
