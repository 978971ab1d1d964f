/* The only file that calls CHOLMOD; it is in C because CHOLMOD's header declares the structs.
 * A factor has its own workspace, so that only one thread at a time may use it. */
#include <cholmod.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { DONE = 0, NOT_DEFINITE = 1, NO_MEMORY = 2 };

/* A solve needs as many operations as four times the entries of the factor, and takes about this many times as long as
 * as many operations of a factorisation: it streams through memory. */
static const double SOLVE_WEIGHT = 8.0;
/* A factor for which CHOLMOD tries nested dissection: operations per entry, and entries per entry of the matrix. */
static const double MUCH_WORK = 500.0, MUCH_FILL = 5.0;
/* Half the neighbours of a node above which the mesh is surely in space, and nested dissection fills less than minimum
 * degree: they are 4 of squares, 7 of tetrahedra, 13 of cubes. */
static const double MANY_NEIGHBOURS = 10.0;

typedef struct factor {
  cholmod_common common;
  cholmod_factor *l;
  /* The row at each place of the factor, if the order is not CHOLMOD's own; else NULL. */
  SuiteSparse_long *order;
} factor;

/* A matrix in the order `order` and the analysis of its factor, or in CHOLMOD's order if that is NULL. */
typedef struct analysis {
  cholmod_sparse *a;
  cholmod_factor *l;
  SuiteSparse_long *order;
  double operations, entries;
} analysis;

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
static void copy_pivots(const factor *f, double *pivots)
{
  const cholmod_factor *l = f->l;
  const SuiteSparse_long *place = f->order ? f->order : (const SuiteSparse_long *)l->Perm;

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

/* The lower triangle of a matrix in another order, its rows not sorted; NULL without memory. CHOLMOD would permute the
 * matrix for the analysis and again for the factorisation. */
static cholmod_sparse *permute(const cholmod_sparse *a, const SuiteSparse_long *order, cholmod_common *common)
{
  SuiteSparse_long n = (SuiteSparse_long)a->nrow, *column, i, j;
  const SuiteSparse_long *begin = (const SuiteSparse_long *)a->p, *row = (const SuiteSparse_long *)a->i;
  SuiteSparse_long *place = malloc(a->nrow * sizeof *place);
  cholmod_sparse *b = place ? cholmod_l_allocate_sparse(a->nrow, a->nrow, a->nzmax, 0, 1, -1, CHOLMOD_REAL, common)
                            : NULL;

  if (b) {
    for (SuiteSparse_long k = 0; k < n; k++)
      place[order[k]] = k;
    column = (SuiteSparse_long *)b->p;
    memset(column, 0, ((size_t)n + 1) * sizeof *column);
    for (SuiteSparse_long c = 0; c < n; c++)
      for (SuiteSparse_long p = begin[c]; p < begin[c + 1]; p++)
        column[place[row[p]] < place[c] ? place[row[p]] : place[c]]++;
    /* The end of each column, then, backwards, its beginning. */
    for (SuiteSparse_long c = 1; c <= n; c++)
      column[c] += column[c - 1];
    for (SuiteSparse_long c = n; c-- > 0;)
      for (SuiteSparse_long p = begin[c + 1]; p-- > begin[c];) {
        i = place[row[p]];
        j = place[c];
        column[i < j ? i : j]--;
        ((SuiteSparse_long *)b->i)[column[i < j ? i : j]] = i < j ? j : i;
        ((double *)b->x)[column[i < j ? i : j]] = ((const double *)a->x)[p];
      }
  }
  free(place);
  return b;
}

static void free_analysis(analysis *s, cholmod_common *common)
{
  cholmod_l_free_sparse(&s->a, common);
  cholmod_l_free_factor(&s->l, common);
  free(s->order);
  s->order = NULL;
}

/* Analysis in the given order, which it takes over; without memory the factor is NULL. */
static analysis analyse_order(const cholmod_sparse *a, SuiteSparse_long *order, cholmod_common *common)
{
  analysis s = { permute(a, order, common), NULL, order, 0.0, 0.0 };

  if (s.a) {
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_NATURAL;
    common->postorder = 0;
    s.l = cholmod_l_analyze(s.a, common);
    s.operations = common->fl;
    s.entries = common->lnz;
    common->nmethods = 0;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = 1;
  }
  return s;
}

/* A number that stands for row j in sums. */
static uint64_t mixed(SuiteSparse_long j)
{
  uint64_t x = ((uint64_t)j + 1) * UINT64_C(0x9E3779B97F4A7C15);

  x = (x ^ (x >> 31)) * UINT64_C(0xBF58476D1CE4E5B9);
  return x ^ (x >> 29);
}

/* Groups of neighbouring rows with the same columns, as those of a node, not divided by `member`: begin (groups + 1).
 * Equal sums of mixed columns count as the same columns; a mistake would cost fill only. Result: the number of groups,
 * 0 without memory. */
static SuiteSparse_long find_groups(const cholmod_sparse *a, const SuiteSparse_long *member, SuiteSparse_long *begin)
{
  SuiteSparse_long n = (SuiteSparse_long)a->nrow, groups = 0;
  const SuiteSparse_long *column = (const SuiteSparse_long *)a->p, *row = (const SuiteSparse_long *)a->i;
  uint64_t *sum = calloc((size_t)n, sizeof *sum);

  if (!sum)
    return 0;
  for (SuiteSparse_long j = 0; j < n; j++)
    for (SuiteSparse_long p = column[j]; p < column[j + 1]; p++) {
      sum[row[p]] += mixed(j);
      if (row[p] != j)
        sum[j] += mixed(row[p]);
    }
  for (SuiteSparse_long j = 0; j < n; j++)
    if (j == 0 || sum[j] != sum[j - 1] || member[j] != member[j - 1])
      begin[groups++] = j;
  begin[groups] = n;
  free(sum);
  return groups;
}

/* The graph of the groups, and which of them are members; NULL without memory. */
static cholmod_sparse *quotient_graph(const cholmod_sparse *a, const SuiteSparse_long *member, SuiteSparse_long groups,
                                      const SuiteSparse_long *begin, SuiteSparse_long *group_member,
                                      cholmod_common *common)
{
  const SuiteSparse_long *column = (const SuiteSparse_long *)a->p, *row = (const SuiteSparse_long *)a->i;
  SuiteSparse_long *group = malloc(a->nrow * sizeof *group), *p, *i, end = 0;
  cholmod_sparse *q = group ? cholmod_l_allocate_sparse((size_t)groups, (size_t)groups, a->nzmax, 1, 1, 1,
                                                        CHOLMOD_PATTERN, common) : NULL;

  if (q) {
    p = (SuiteSparse_long *)q->p;
    i = (SuiteSparse_long *)q->i;
    for (SuiteSparse_long g = 0; g < groups; g++)
      for (SuiteSparse_long j = begin[g]; j < begin[g + 1]; j++)
        group[j] = j == begin[g] ? g : -1;
    for (SuiteSparse_long g = 0; g < groups; g++) {
      p[g] = end;
      for (SuiteSparse_long k = column[begin[g]]; k < column[begin[g] + 1]; k++)
        if (group[row[k]] >= 0)
          i[end++] = group[row[k]];
      group_member[g] = member[begin[g]];
    }
    p[groups] = end;
  }
  free(group);
  return q;
}

/* The order of rows that an order of their groups means, the members at its end; NULL without memory. */
static SuiteSparse_long *expand(SuiteSparse_long n, SuiteSparse_long groups, const SuiteSparse_long *begin,
                                const SuiteSparse_long *group_member, const SuiteSparse_long *group_order)
{
  SuiteSparse_long *order = malloc((size_t)n * sizeof *order), end = 0;

  for (SuiteSparse_long wanted = 0; order && wanted < 2; wanted++)
    for (SuiteSparse_long k = 0; k < groups; k++)
      if (group_member[group_order[k]] == wanted)
        for (SuiteSparse_long j = begin[group_order[k]]; j < begin[group_order[k] + 1]; j++)
          order[end++] = j;
  return order;
}

/* Analysis in an order that fills little and has the members at its end, found on the graph of the groups by nested
 * dissection or by minimum degree; no factor if there is none. */
static analysis analyse_groups(const cholmod_sparse *a, cholmod_sparse *graph, const SuiteSparse_long *begin,
                               SuiteSparse_long *group_member, int dissect, cholmod_common *common)
{
  SuiteSparse_long groups = (SuiteSparse_long)graph->nrow, *order = NULL;
  SuiteSparse_long *group_order = calloc(graph->nrow, sizeof *group_order);
  analysis s = { NULL, NULL, NULL, 0.0, 0.0 };

  /* CAMD 2.4.6 reads memory that is not its own if the only group is a member. */
  if (group_order && (groups == 1 || (dissect ? cholmod_l_metis(graph, NULL, 0, 1, group_order, common)
                                              : cholmod_l_camd(graph, NULL, 0, group_member, group_order, common))))
    order = expand((SuiteSparse_long)a->nrow, groups, begin, group_member, group_order);
  if (order)
    s = analyse_order(a, order, common);
  free(group_order);
  return s;
}

/* The better of both, the second only tried where CHOLMOD would try it too, or where it is known to be better. */
static analysis analyse_graph(const cholmod_sparse *a, cholmod_sparse *graph, const SuiteSparse_long *begin,
                              SuiteSparse_long *group_member, cholmod_common *common)
{
  double neighbours = (double)((const SuiteSparse_long *)graph->p)[graph->nrow] / (double)graph->nrow - 1.0;
  analysis s = analyse_groups(a, graph, begin, group_member, neighbours > MANY_NEIGHBOURS, common), other;

  if (s.l && (neighbours > MANY_NEIGHBOURS || s.operations < MUCH_WORK * s.entries ||
              s.entries < MUCH_FILL * (double)a->nzmax))
    return s;
  other = analyse_groups(a, graph, begin, group_member, neighbours <= MANY_NEIGHBOURS, common);
  if (!s.l || (other.l && other.operations < s.operations)) {
    free_analysis(&s, common);
    return other;
  }
  free_analysis(&other, common);
  return s;
}

/* The same for the `rows`, counted from 1. */
static analysis analyse_with_last(const cholmod_sparse *a, int last, const int *rows, cholmod_common *common)
{
  size_t n = a->nrow;
  SuiteSparse_long *member = calloc(2 * n, sizeof *member), *begin = malloc((n + 1) * sizeof *begin), groups = 0;
  cholmod_sparse *graph = NULL;
  analysis s = { NULL, NULL, NULL, 0.0, 0.0 };

  if (member && begin) {
    for (int k = 0; k < last; k++)
      member[rows[k] - 1] = 1;
    groups = find_groups(a, member, begin);
  }
  if (groups > 0)
    graph = quotient_graph(a, member, groups, begin, member + n, common);
  if (graph)
    s = analyse_graph(a, graph, begin, member + n, common);
  cholmod_l_free_sparse(&graph, common);
  free(member);
  free(begin);
  return s;
}

/* Operations, in those of a factorisation, that alpha needs in addition if the rows are last, with p of them. */
static double operations_with_last(double p, double columns)
{
  return p * columns * (p + columns);
}

/* The cheaper analysis: the rows `order` last, or any order and `columns` solves. The matrix is taken over; without
 * memory there is no factor. `order` becomes the order of elimination, or zero. */
static analysis analyse(cholmod_sparse *a, int last, int *order, int columns, cholmod_common *common)
{
  analysis any = { a, NULL, NULL, 0.0, 0.0 }, s = { NULL, NULL, NULL, 0.0, 0.0 };
  double p = last, added = operations_with_last(p, columns);

  if (last > 0)
    s = analyse_with_last(a, last, order, common);
  /* Without doubt if most of the work is not in the last rows. */
  if (!s.l || p * p * p / 3 + added > s.operations / 2) {
    any.l = cholmod_l_analyze(a, common);
    if (!s.l || (any.l && common->fl + SOLVE_WEIGHT * 4 * common->lnz * columns < s.operations + added)) {
      free_analysis(&s, common);
      memset(order, 0, (size_t)last * sizeof *order);
      return any;
    }
  }
  free_analysis(&any, common);
  for (int k = 0; k < last; k++)
    order[k] = (int)s.order[s.l->n - (size_t)(last - k)] + 1;
  return s;
}

int fuge_cholmod_factorise(int n, const int *column, const int *row, const double *value, int last, int *order,
                           int columns, void **destination, double *pivots, int *failed)
{
  factor *f = calloc(1, sizeof *f);
  cholmod_sparse *a;
  analysis s;
  int status = NO_MEMORY;

  *destination = NULL;
  *failed = 0;
  if (!f)
    return NO_MEMORY;
  cholmod_l_start(&f->common);
  f->common.print = 0;
  a = copy_matrix(n, column, row, value, &f->common);
  if (a) {
    s = analyse(a, last, order, columns, &f->common);
    f->l = s.l;
    f->order = s.order;
    if (f->l && cholmod_l_factorize(s.a, f->l, &f->common))
      status = DONE;
    cholmod_l_free_sparse(&s.a, &f->common);
  }
  if (status == DONE && f->l->minor < f->l->n) {
    *failed = (int)(f->order ? f->order : (const SuiteSparse_long *)f->l->Perm)[f->l->minor] + 1;
    status = NOT_DEFINITE;
  }
  if (status == DONE) {
    copy_pivots(f, pivots);
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

/* Copy the rows of a block between the order of the matrix and that of the factor. */
static void reorder(const factor *f, int n, int columns, int to_factor, const double *from, double *to)
{
  for (size_t c = 0; c < (size_t)columns * (size_t)n; c += (size_t)n)
    for (size_t k = 0; k < (size_t)n; k++)
      if (to_factor)
        to[c + k] = from[c + (size_t)f->order[k]];
      else
        to[c + (size_t)f->order[k]] = from[c + k];
}

int fuge_cholmod_solve(void *source, int n, int columns, double *block)
{
  factor *f = source;
  size_t size = (size_t)n * (size_t)columns;
  double *ordered = f->order ? malloc(size * sizeof *ordered) : block;
  cholmod_dense right = { (size_t)n, (size_t)columns, size, (size_t)n, ordered, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE };
  cholmod_dense *x = NULL;

  if (!ordered)
    return NO_MEMORY;
  if (f->order)
    reorder(f, n, columns, 1, block, ordered);
  x = cholmod_l_solve(CHOLMOD_A, f->l, &right, &f->common);
  if (f->order)
    free(ordered);
  if (!x)
    return NO_MEMORY;
  if (f->order)
    reorder(f, n, columns, 0, x->x, block);
  else
    memcpy(block, x->x, size * sizeof *block);
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
  free(f->order);
  free(f);
}
