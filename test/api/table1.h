/* The paper's example with two nodes (Table 1), and a solver that holds it. */
#ifndef TABLE1_H
#define TABLE1_H

#include <stdlib.h>
#include "check.h"

enum { TABLE1_STEPS = 4 };
static const double TABLE1_ALPHA[4] = {0.2, 0.1, 0.1, 0.2};
static const double TABLE1_GAP[2] = {0.0, 1.0};
static const double TABLE1_LOAD = 2.0;
static const double TABLE1_FORCE[2] = {2.0, 0.0};
static const double TABLE1_GAP_OUT[2] = {0.0, 0.8};
static const double TABLE1_APPROACH = 0.4;
/* Basis after each pivot and sum of the artificials. */
static const int TABLE1_BASIS[TABLE1_STEPS * 3] = {6, 7, 8, 6, 7, 1, 6, 4, 1, 5, 4, 1};
static const double TABLE1_Z[TABLE1_STEPS] = {3.0, 1.6, 0.4, 0.0};

static const double EXACT = 1e-14;

static inline void check_table1(const double *force, const double *gap, double approach) {
  for (int k = 0; k < 2; k++) {
    CHECK_NEAR(force[k], TABLE1_FORCE[k], EXACT);
    CHECK_NEAR(gap[k], TABLE1_GAP_OUT[k], EXACT);
  }
  CHECK_NEAR(approach, TABLE1_APPROACH, EXACT);
}

/* An operator and a solver of it; without them no test makes sense. */
static inline fuge_solver *new_solver(const double *alpha, int n, const fuge_options *options, fuge_operator **op) {
  fuge_solver *solver = NULL;
  if (fuge_operator_dense(n, alpha, n, op, NULL, 0) != FUGE_DONE ||
      fuge_solver_new(*op, options, &solver, NULL, 0) != FUGE_DONE) {
    printf("no solver\n");
    exit(EXIT_FAILURE);
  }
  return solver;
}

/* The same with Table 1 in it: `options` may be NULL. */
static inline fuge_solver *table1_solver(const fuge_options *options, fuge_operator **op) {
  fuge_solver *solver = new_solver(TABLE1_ALPHA, 2, options, op);
  CHECK_STATUS(fuge_set_gap(solver, TABLE1_GAP, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_set_load(solver, TABLE1_LOAD), FUGE_DONE);
  return solver;
}

static inline void free_both(fuge_solver **solver, fuge_operator **op) {
  fuge_solver_free(solver);
  fuge_operator_free(op);
}

#endif
