/* A solve with little memory, on Linux: an error instead of a crash, wherever the memory ends. */
#define _XOPEN_SOURCE 600
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "check.h"

enum { FEW = 40, MANY = 500, MEGABYTE = 1 << 20 };

/* A ball under a load and moments, counted from a point outside, on side x side cells. */
static void new_solver(int side, fuge_operator **op, fuge_solver **solver) {
  const int points = side * side;
  double *gap = malloc(sizeof *gap * points), *modes = malloc(sizeof *modes * 3 * points);
  const double resultant[3] = {0.1, 0.7, 0.3};
  for (int k = 0; k < points; k++) {
    const double x = (k % side + 0.5) / side - 0.5, y = (k / side + 0.5) / side - 0.5;
    gap[k] = x * x + y * y;
    modes[k] = 1.0;
    modes[points + k] = x + 7.0;
    modes[2 * points + k] = y + 3.0;
  }
  CHECK_DONE(fuge_operator_halfspace(side, side, 1.0 / side, 1.0 / side, 1.0, FUGE_MEAN, FUGE_FREE, op, NULL, 0));
  CHECK_DONE(fuge_solver_new(*op, NULL, solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(*solver, gap, NULL));
  CHECK_DONE(fuge_set_modes(*solver, 3, modes, resultant));
  free(gap);
  free(modes);
}

/* The status of a solve, in a process of its own, that may allocate so many megabytes more; 1000 after a crash. */
static int solve_within(fuge_solver *solver, long megabytes) {
  int status = 0;
  long pages = 0;
  const pid_t child = fork();
  if (child == 0) {
    FILE *file = fopen("/proc/self/statm", "r");
    struct rlimit limit;
    if (file == NULL || fscanf(file, "%ld", &pages) != 1) _exit(99);
    fclose(file);
    limit.rlim_cur = limit.rlim_max = (rlim_t)(pages * sysconf(_SC_PAGESIZE) + megabytes * MEGABYTE);
    setrlimit(RLIMIT_AS, &limit);
    _exit(-fuge_solve(solver));
  }
  if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return 1000;
  return -WEXITSTATUS(status);
}

int main(void) {
  fuge_operator *op = NULL, *small = NULL;
  fuge_solver *solver = NULL, *first = NULL;
  /* OpenBLAS waits for ever for memory of its own: now it has it. */
  new_solver(FEW, &small, &first);
  CHECK_DONE(fuge_solve(first));
  new_solver(MANY, &op, &solver);
  for (long megabytes = 7; megabytes < 32; megabytes += 4) CHECK_INT(solve_within(solver, megabytes), FUGE_ERR_MEMORY);
  CHECK_INT(solve_within(solver, 1000), FUGE_DONE);
  fuge_solver_free(&first);
  fuge_operator_free(&small);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  return check_summary();
}
