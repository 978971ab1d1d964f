/* The only file that calls CHOLMOD; it is in C because CHOLMOD's header declares the structs.
 * A factor has its own workspace, so that only one thread at a time may use it. */
#include <cholmod.h>
#include <stdlib.h>
#include <string.h>

enum { DONE = 0, NOT_DEFINITE = 1, NO_MEMORY = 2 };

typedef struct factor {
  cholmod_common common;
  cholmod_factor *l;
} factor;

int fuge_cholmod_factorise(int n, const int *column, const int *row, const double *value, void **destination,
                           double *pivots, int *failed);
int fuge_cholmod_solve(void *source, int n, int columns, double *block);
void fuge_cholmod_free(void *source);

/* Pivot of column k of L: D of L D L', the square of the diagonal of L L'. */
static double simplicial_pivot(const cholmod_factor *l, SuiteSparse_long k)
{
  double entry = ((const double *)l->x)[((const SuiteSparse_long *)l->p)[k]];

  return l->is_ll ? entry * entry : entry;
}

/* The pivots in the order of the matrix. */
static void copy_pivots(const cholmod_factor *l, double *pivots)
{
  const SuiteSparse_long *place = l->Perm;

  if (l->is_super) {
    const SuiteSparse_long *first = l->super, *rows = l->pi, *values = l->px;

    for (size_t s = 0; s < l->nsuper; s++) {
      SuiteSparse_long height = rows[s + 1] - rows[s];
      const double *x = (const double *)l->x + values[s];

      for (SuiteSparse_long k = first[s]; k < first[s + 1]; k++) {
        double root = x[(k - first[s]) * (height + 1)];

        pivots[place[k]] = root * root;
      }
    }
  } else {
    for (SuiteSparse_long k = 0; k < (SuiteSparse_long)l->n; k++)
      pivots[place[k]] = simplicial_pivot(l, k);
  }
}

/* A copy for CHOLMOD, counted from 0, of an upper triangle counted from 1; NULL without memory. */
static cholmod_sparse *copy_matrix(int n, const int *column, const int *row, const double *value,
                                   cholmod_common *common)
{
  SuiteSparse_long entries = column[n] - 1;
  cholmod_sparse *a = cholmod_l_allocate_sparse((size_t)n, (size_t)n, (size_t)entries, 1, 1, 1, CHOLMOD_REAL, common);

  if (!a)
    return NULL;
  for (int j = 0; j <= n; j++)
    ((SuiteSparse_long *)a->p)[j] = column[j] - 1;
  for (SuiteSparse_long p = 0; p < entries; p++)
    ((SuiteSparse_long *)a->i)[p] = row[p] - 1;
  memcpy(a->x, value, (size_t)entries * sizeof *value);
  return a;
}

int fuge_cholmod_factorise(int n, const int *column, const int *row, const double *value, void **destination,
                           double *pivots, int *failed)
{
  factor *f = calloc(1, sizeof *f);
  cholmod_sparse *a;
  int status = NO_MEMORY;

  *destination = NULL;
  *failed = 0;
  if (!f)
    return NO_MEMORY;
  cholmod_l_start(&f->common);
  f->common.print = 0;
  a = copy_matrix(n, column, row, value, &f->common);
  if (a) {
    f->l = cholmod_l_analyze(a, &f->common);
    if (f->l && cholmod_l_factorize(a, f->l, &f->common))
      status = DONE;
    cholmod_l_free_sparse(&a, &f->common);
  }
  if (status == DONE && f->l->minor < f->l->n) {
    *failed = (int)((const SuiteSparse_long *)f->l->Perm)[f->l->minor] + 1;
    status = NOT_DEFINITE;
  }
  if (status == DONE) {
    copy_pivots(f->l, pivots);
    *destination = f;
  } else {
    fuge_cholmod_free(f);
  }
  return status;
}

int fuge_cholmod_solve(void *source, int n, int columns, double *block)
{
  factor *f = source;
  cholmod_dense right = { (size_t)n, (size_t)columns, (size_t)n * (size_t)columns, (size_t)n, block, NULL,
                          CHOLMOD_REAL, CHOLMOD_DOUBLE };
  cholmod_dense *x = cholmod_l_solve(CHOLMOD_A, f->l, &right, &f->common);

  if (!x)
    return NO_MEMORY;
  memcpy(block, x->x, (size_t)n * (size_t)columns * sizeof *block);
  cholmod_l_free_dense(&x, &f->common);
  return DONE;
}

void fuge_cholmod_free(void *source)
{
  factor *f = source;

  if (!f)
    return;
  cholmod_l_free_factor(&f->l, &f->common);
  cholmod_l_finish(&f->common);
  free(f);
}
