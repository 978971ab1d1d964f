/* The only file that calls CHOLMOD; it is in C because CHOLMOD's header declares the structs.
 * A factor has its own workspace, so that only one thread at a time may use it. */
#include <cholmod.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DONE = 0, NOT_DEFINITE = 1, NO_MEMORY = 2 };

/* A solve needs as many operations as four times the entries of the factor, and takes about this many times as long as
 * as many operations of a factorisation: it streams through memory. */
static const double SOLVE_WEIGHT = 8.0;
/* A factor for which CHOLMOD tries nested dissection: operations per entry, and entries per entry of the matrix. */
static const double MUCH_WORK = 500.0, MUCH_FILL = 5.0;

typedef struct factor {
  cholmod_common common;
  cholmod_factor *l;
} factor;

int fuge_cholmod_factorise(int n, const int *column, const int *row, const double *value, int last, int *order,
                           int columns, void **destination, double *pivots, int *failed);
void fuge_cholmod_copy_last(void *source, int last, double *root);
void fuge_cholmod_replace_last(void *source, int last, const double *root, int count, const int *isolated);
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

/* Analysis in a given order, or in its postorder, which changes nothing but the storage; NULL without memory. */
static cholmod_factor *analyse_order(cholmod_sparse *a, SuiteSparse_long *order, int postorder, cholmod_common *common)
{
  cholmod_factor *l;

  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_GIVEN;
  common->postorder = postorder;
  l = cholmod_l_analyze_p(a, order, NULL, 0, common);
  common->nmethods = 0;
  common->postorder = 1;
  return l;
}

/* Move the members of an order to its end; the order among them, and among the others, stays. */
static void move_to_end(SuiteSparse_long n, const SuiteSparse_long *from, const SuiteSparse_long *member,
                        SuiteSparse_long *order)
{
  SuiteSparse_long end = 0;

  for (SuiteSparse_long wanted = 0; wanted < 2; wanted++)
    for (SuiteSparse_long k = 0; k < n; k++)
      if (member[from[k]] == wanted)
        order[end++] = from[k];
}

/* As CHOLMOD does without constraints: nested dissection for a factor that fills much, as in three dimensions. */
static cholmod_factor *dissect(cholmod_sparse *a, const SuiteSparse_long *member, SuiteSparse_long *work,
                               cholmod_common *common)
{
  SuiteSparse_long n = (SuiteSparse_long)a->nrow;
  SuiteSparse_long *order = work + n;
  cholmod_factor *l;

  if (!cholmod_l_metis(a, NULL, 0, 1, work, common))
    return NULL;
  move_to_end(n, work, member, order);
  l = analyse_order(a, order, 1, common);
  if (!l)
    return NULL;
  /* The postorder keeps supernodes together; it may have moved the members. */
  move_to_end(n, l->Perm, member, order);
  cholmod_l_free_factor(&l, common);
  return analyse_order(a, order, 0, common);
}

/* Analysis in an order that fills little and has the rows `last`, counted from 1, at its end; NULL if there is none.
 * common->fl and lnz are those of the result. */
static cholmod_factor *analyse_with_last(cholmod_sparse *a, int last, const int *rows, cholmod_common *common)
{
  size_t n = a->nrow;
  SuiteSparse_long *member = calloc(n, sizeof *member);
  SuiteSparse_long *work = malloc(2 * n * sizeof *work);
  cholmod_factor *l = NULL, *dissected;
  double operations, entries;

  if (member && work) {
    for (int k = 0; k < last; k++)
      member[rows[k] - 1] = 1;
    if (cholmod_l_camd(a, NULL, 0, member, work, common))
      l = analyse_order(a, work, 0, common);
    operations = common->fl;
    entries = common->lnz;
    if (l && operations > MUCH_WORK * entries && entries > MUCH_FILL * common->anz) {
      dissected = dissect(a, member, work, common);
      if (dissected && common->fl < operations) {
        cholmod_l_free_factor(&l, common);
        l = dissected;
      } else {
        cholmod_l_free_factor(&dissected, common);
        common->fl = operations;
        common->lnz = entries;
      }
    }
  }
  free(member);
  free(work);
  return l;
}

/* Operations, in those of a factorisation, that alpha needs in addition if the rows are last, with p of them. */
static double operations_with_last(double p, double columns)
{
  return p * columns * (p + columns);
}

/* The cheaper analysis: the rows `order` last, or any order and `columns` solves. `order` becomes the order of
 * elimination, or zero. */
static cholmod_factor *analyse(cholmod_sparse *a, int last, int *order, int columns, cholmod_common *common)
{
  cholmod_factor *constrained = last > 0 ? analyse_with_last(a, last, order, common) : NULL;
  cholmod_factor *free_order;
  double p = last, cost = common->fl + operations_with_last(p, columns);

  /* Without doubt if most of the work is not in the last rows. */
  if (!constrained || p * p * p / 3 + operations_with_last(p, columns) > common->fl / 2) {
    free_order = cholmod_l_analyze(a, common);
    if (!constrained || (free_order && common->fl + SOLVE_WEIGHT * 4 * common->lnz * columns < cost)) {
      cholmod_l_free_factor(&constrained, common);
      memset(order, 0, (size_t)last * sizeof *order);
      return free_order;
    }
    cholmod_l_free_factor(&free_order, common);
  }
  for (int k = 0; k < last; k++)
    order[k] = (int)((const SuiteSparse_long *)constrained->Perm)[constrained->n - (size_t)(last - k)] + 1;
  return constrained;
}

int fuge_cholmod_factorise(int n, const int *column, const int *row, const double *value, int last, int *order,
                           int columns, void **destination, double *pivots, int *failed)
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
    f->l = analyse(a, last, order, columns, &f->common);
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

/* The part of supernode s in the last columns, `first` and following, to the square `root`. */
static void copy_supernode(const cholmod_factor *l, size_t s, SuiteSparse_long first, double *root)
{
  SuiteSparse_long begin = ((const SuiteSparse_long *)l->super)[s], end = ((const SuiteSparse_long *)l->super)[s + 1];
  const SuiteSparse_long *place = (const SuiteSparse_long *)l->pi + s;
  const SuiteSparse_long *rows = (const SuiteSparse_long *)l->s + place[0];
  const double *x = (const double *)l->x + ((const SuiteSparse_long *)l->px)[s];
  SuiteSparse_long height = place[1] - place[0], last = (SuiteSparse_long)l->n - first;

  for (SuiteSparse_long k = begin > first ? begin : first; k < end; k++)
    for (SuiteSparse_long r = k - begin; r < height; r++)
      root[rows[r] - first + last * (k - first)] = x[r + height * (k - begin)];
}

/* Column k of a simplicial factor, k >= first, to the square `root`. */
static void copy_column(const cholmod_factor *l, SuiteSparse_long k, SuiteSparse_long first, double *root)
{
  SuiteSparse_long begin = ((const SuiteSparse_long *)l->p)[k], entries = ((const SuiteSparse_long *)l->nz)[k];
  const SuiteSparse_long *rows = (const SuiteSparse_long *)l->i + begin;
  const double *x = (const double *)l->x + begin;
  double *column = root + ((SuiteSparse_long)l->n - first) * (k - first);
  double scale = l->is_ll ? 1.0 : sqrt(x[0]);

  for (SuiteSparse_long r = 0; r < entries; r++)
    column[rows[r] - first] = scale * x[r];
  if (!l->is_ll)
    column[k - first] = scale;
}

void fuge_cholmod_copy_last(void *source, int last, double *root)
{
  const cholmod_factor *l = ((factor *)source)->l;
  SuiteSparse_long n = (SuiteSparse_long)l->n, first = n - last;

  if (l->is_super) {
    for (size_t s = 0; s < l->nsuper; s++)
      if (((const SuiteSparse_long *)l->super)[s + 1] > first)
        copy_supernode(l, s, first, root);
  } else {
    for (SuiteSparse_long k = first; k < n; k++)
      copy_column(l, k, first, root);
  }
}

/* Is the row, counted from 0 among the last ones, isolated? The list counts from 1 and is short. */
static int is_isolated(SuiteSparse_long row, int count, const int *isolated)
{
  for (int k = 0; k < count; k++)
    if (isolated[k] - 1 == row)
      return 1;
  return 0;
}

/* New last columns, and zero in the isolated rows, of supernode s. */
static void replace_supernode(cholmod_factor *l, size_t s, SuiteSparse_long first, const double *root, int count,
                              const int *isolated)
{
  SuiteSparse_long begin = ((const SuiteSparse_long *)l->super)[s], end = ((const SuiteSparse_long *)l->super)[s + 1];
  const SuiteSparse_long *place = (const SuiteSparse_long *)l->pi + s;
  const SuiteSparse_long *rows = (const SuiteSparse_long *)l->s + place[0];
  double *x = (double *)l->x + ((const SuiteSparse_long *)l->px)[s];
  SuiteSparse_long height = place[1] - place[0], last = (SuiteSparse_long)l->n - first;
  SuiteSparse_long middle = end < first ? end : begin > first ? begin : first;

  for (SuiteSparse_long k = middle; k < end; k++)
    for (SuiteSparse_long r = k - begin; r < height; r++)
      x[r + height * (k - begin)] = root[rows[r] - first + last * (k - first)];
  for (SuiteSparse_long r = height; r-- > 0 && rows[r] >= first;)
    if (is_isolated(rows[r] - first, count, isolated))
      for (SuiteSparse_long k = begin; k < middle; k++)
        x[r + height * (k - begin)] = 0.0;
}

/* The same for column k of a simplicial factor. */
static void replace_column(cholmod_factor *l, SuiteSparse_long k, SuiteSparse_long first, const double *root, int count,
                           const int *isolated)
{
  SuiteSparse_long begin = ((const SuiteSparse_long *)l->p)[k], entries = ((const SuiteSparse_long *)l->nz)[k];
  const SuiteSparse_long *rows = (const SuiteSparse_long *)l->i + begin;
  double *x = (double *)l->x + begin;
  const double *column = root + ((SuiteSparse_long)l->n - first) * (k - first);

  for (SuiteSparse_long r = entries; r-- > 0 && rows[r] >= first;)
    if (k >= first)
      x[r] = l->is_ll ? column[rows[r] - first] : column[rows[r] - first] / column[k - first];
    else if (is_isolated(rows[r] - first, count, isolated))
      x[r] = 0.0;
  if (k >= first && !l->is_ll)
    x[0] = column[k - first] * column[k - first];
}

void fuge_cholmod_replace_last(void *source, int last, const double *root, int count, const int *isolated)
{
  cholmod_factor *l = ((factor *)source)->l;
  SuiteSparse_long n = (SuiteSparse_long)l->n, first = n - last;

  if (l->is_super) {
    for (size_t s = 0; s < l->nsuper; s++)
      replace_supernode(l, s, first, root, count, isolated);
  } else {
    for (SuiteSparse_long k = 0; k < n; k++)
      replace_column(l, k, first, root, count, isolated);
  }
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
