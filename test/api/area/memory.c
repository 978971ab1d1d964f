/* A solve with little memory, on Linux: an error instead of a crash, wherever the memory ends. */
#define _XOPEN_SOURCE 600
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "check.h"

enum { SIDE = 500, POINTS = SIDE * SIDE, MEGABYTE = 1 << 20 };

/* A ball under a load and moments, counted from a point outside. */
static fuge_solver *new_solver(const fuge_operator *op) {
  double *gap = malloc(sizeof *gap * POINTS), *modes = malloc(sizeof *modes * 3 * POINTS);
  const double resultant[3] = {0.1, 0.7, 0.3};
  fuge_solver *solver = NULL;
  for (int k = 0; k < POINTS; k++) {
    const double x = (k % SIDE + 0.5) / SIDE - 0.5, y = (k / SIDE + 0.5) / SIDE - 0.5;
    gap[k] = x * x + y * y;
    modes[k] = 1.0;
    modes[POINTS + k] = x + 7.0;
    modes[2 * POINTS + k] = y + 3.0;
  }
  CHECK_DONE(fuge_solver_new(op, NULL, &solver, NULL, 0));
  CHECK_DONE(fuge_set_gap(solver, gap, NULL));
  CHECK_DONE(fuge_set_modes(solver, 3, modes, resultant));
  free(gap);
  free(modes);
  return solver;
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
  fuge_operator *op = NULL;
  fuge_solver *solver;
  CHECK_DONE(fuge_operator_halfspace(SIDE, SIDE, 1.0 / SIDE, 1.0 / SIDE, 1.0, FUGE_MEAN, FUGE_FREE, &op, NULL, 0));
  solver = new_solver(op);
  for (long megabytes = 7; megabytes < 32; megabytes += 4) CHECK_INT(solve_within(solver, megabytes), FUGE_ERR_MEMORY);
  CHECK_INT(solve_within(solver, 1000), FUGE_DONE);
  fuge_solver_free(&solver);
  fuge_operator_free(&op);
  return check_summary();
}
