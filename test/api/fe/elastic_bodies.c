/* Sections "elastic bodies" and "bodies as one" of fuge_fe.h. */
#include "check.h"

/* Two blocks one wide and one high, of unit squares cut into 2 and 3 elements side by side, in plane strain: Young's
 * modulus 2, Poisson's ratio 0.25.  The upper one, body 1, floats upon the lower one under a pressure. */
#define YOUNG 2.0
#define POISSON 0.25
#define PRESSURE 0.01
enum { MOST = 4, DEGREES = 4 * (MOST + 1) };

typedef struct block {
  int elements, nodes, degrees;
  double x[DEGREES];
  int dof[DEGREES], bottom[2 * MOST], top[2 * MOST];
  double matrix[DEGREES * DEGREES];
  int column[DEGREES + 1], row[DEGREES * DEGREES];
  double value[DEGREES * DEGREES];
} block;

/* Add the stiffness of an element h wide and 1 high, with nodes counter-clockwise, by 2 x 2 Gauss points. */
static void add_element(block *b, const int node[4], double h) {
  const double place = sqrt(1.0 / 3.0), shear = YOUNG / (2 * (1 + POISSON));
  const double lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON));
  const double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
  for (int g = 0; g < 4; g++)
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++) {
        double d[2][2];
        for (int s = 0; s < 2; s++) {
          const int k = s == 0 ? i : j;
          d[s][0] = sx[k] * (1 + sy[k] * sy[g] * place) / 4 * 2 / h;
          d[s][1] = sy[k] * (1 + sx[k] * sx[g] * place) / 4 * 2;
        }
        for (int a = 0; a < 2; a++)
          for (int c = 0; c < 2; c++) {
            double k = lame * d[0][a] * d[1][c] + shear * d[0][c] * d[1][a];
            if (a == c) k += shear * (d[0][0] * d[1][0] + d[0][1] * d[1][1]);
            b->matrix[2 * node[i] + a + b->degrees * (2 * node[j] + c)] += k * h / 4;
          }
      }
}

static block make_block(int elements, double y) {
  block b;
  memset(&b, 0, sizeof b);
  b.elements = elements;
  b.nodes = 2 * (elements + 1);
  b.degrees = 2 * b.nodes;
  for (int k = 0; k < b.nodes; k++) {
    b.x[2 * k] = (double)(k % (elements + 1)) / elements;
    b.x[2 * k + 1] = y + k / (elements + 1);
  }
  for (int k = 0; k < b.degrees; k++) b.dof[k] = k;
  for (int e = 0; e < elements; e++) {
    const int node[4] = {e, e + 1, e + elements + 2, e + elements + 1};
    add_element(&b, node, 1.0 / elements);
    b.bottom[2 * e] = e;
    b.bottom[2 * e + 1] = e + 1;
    b.top[2 * e] = e + elements + 2;
    b.top[2 * e + 1] = e + elements + 1;
  }
  int entries = 0;
  for (int j = 0; j < b.degrees; j++) {
    b.column[j] = entries;
    for (int i = 0; i < b.degrees; i++) {
      if (fabs(b.matrix[i + b.degrees * j]) < 1e-14) continue;
      b.row[entries] = i;
      b.value[entries++] = b.matrix[i + b.degrees * j];
    }
  }
  b.column[b.degrees] = entries;
  return b;
}

/* What the tests make, and free. */
typedef struct model {
  fuge_body *body[2];
  fuge_pairs *pairs;
  fuge_bodies *all;
} model;

static void add(model *m, int k, const block *b) {
  int number = -1;
  CHECK_DONE(fuge_body_columns(b->degrees, b->column, b->row, b->value, &m->body[k], NULL, 0));
  CHECK_DONE(fuge_bodies_add(m->all, m->body[k], &number));
  CHECK_INT(number, k);
}

static int add_pair(model *m, int contact_body, int opposite_body) {
  return fuge_bodies_add_pair(m->all, contact_body, opposite_body, m->pairs, FUGE_MORTAR, FUGE_NORMALS_AVERAGED, NULL,
                              0.0, INFINITY, 0, 1);
}

static model no_bodies(void) {
  model m = {{NULL, NULL}, NULL, NULL};
  CHECK_DONE(fuge_bodies_create(&m.all, NULL, 0));
  CHECK_DONE(fuge_pairs_create(&m.pairs, NULL, 0));
  return m;
}

static void free_model(model *m) {
  fuge_bodies_free(&m->all);
  CHECK(m->all == NULL);
  for (int k = 0; k < 2; k++) fuge_body_free(&m->body[k]);
  fuge_pairs_free(&m->pairs);
}

/* The faces of the upper block, body 1, against those of the lower one. */
static void set_surfaces(const model *m, const block *lower, const block *upper, const int *contact,
                         const int *opposite) {
  CHECK_DONE(fuge_pairs_set_contact(m->pairs, 2, upper->nodes, upper->x, 2, upper->elements, contact, upper->dof));
  CHECK_DONE(fuge_pairs_set_opposite(m->pairs, 2, lower->nodes, lower->x, 2, lower->elements, opposite, lower->dof));
}

static model two_blocks(const block *lower, const block *upper) {
  const int fixed[4] = {1, 3, 5, 0};
  double load[DEGREES] = {0};
  model m = no_bodies();

  for (int k = 0; k <= upper->elements; k++)
    load[2 * (k + upper->elements + 1) + 1] =
        -PRESSURE / upper->elements * (k == 0 || k == upper->elements ? 0.5 : 1.0);
  add(&m, 0, lower);
  add(&m, 1, upper);
  CHECK_DONE(fuge_body_fix(m.body[0], 4, fixed, NULL));
  CHECK_DONE(fuge_body_set_load(m.body[1], load));
  set_surfaces(&m, lower, upper, upper->bottom, lower->top);
  CHECK_DONE(add_pair(&m, 1, 0));
  return m;
}

static void check_solution(const model *m, const block *lower, const block *upper) {
  const double strain = -PRESSURE * (1 - POISSON * POISSON) / YOUNG;
  double force[MOST + 1], pressure[MOST + 1], gap[MOST + 1], area[MOST + 1], initial[MOST + 1], u[DEGREES],
      direction[2 * MOST + 2];
  int n = -1, unpaired = -1, pair[MOST + 1], node[MOST + 1];
  fuge_info info;

  CHECK_DONE(fuge_pairs_get_sizes(m->pairs, &n, NULL, &unpaired));
  CHECK_INT(n, 4);
  CHECK_INT(unpaired, 0);
  CHECK_DONE(fuge_bodies_get_forces(m->all, force, pressure, gap));
  CHECK_DONE(fuge_pairs_get_gaps(m->pairs, initial, NULL, area));
  CHECK_DONE(fuge_pairs_get_points(m->pairs, pair, node, NULL, NULL, direction));
  for (int i = 0; i < 4; i++) {
    CHECK_NEAR(pressure[i], PRESSURE, 1e-14);
    CHECK_NEAR(force[i], PRESSURE * area[i], 1e-15);
    CHECK_NEAR(area[i], i == 0 || i == 3 ? 1.0 / 6.0 : 1.0 / 3.0, 1e-15);
    CHECK_NEAR(gap[i], 0.0, 0.0);
    CHECK_NEAR(initial[i], 0.0, 1e-16);
    CHECK_NEAR(direction[2 * i + 1], -1.0, 1e-15);
    CHECK_INT(pair[i], 0);
    CHECK_INT(node[i], i);
  }
  CHECK_DONE(fuge_bodies_get_displacement(m->all, 0, u));
  for (int k = 0; k < lower->nodes; k++) CHECK_NEAR(u[2 * k + 1], strain * (k / 3), 1e-14);
  CHECK_DONE(fuge_bodies_get_displacement(m->all, 1, u));
  for (int k = 0; k < upper->nodes; k++) CHECK_NEAR(u[2 * k + 1], strain * (1 + k / 4), 1e-14);
  CHECK_DONE(fuge_bodies_get_info(m->all, &info));
  CHECK_INT(info.status, FUGE_DONE);
  CHECK_INT(info.contacts, 4);
  CHECK(info.residual < 1e-12);
}

static void test_solve(void) {
  const block lower = make_block(2, 0.0), upper = make_block(3, 1.0);
  model m = two_blocks(&lower, &upper);
  fuge_options options;

  CHECK_DONE(fuge_bodies_solve(m.all, NULL, m.pairs));
  check_solution(&m, &lower, &upper);
  fuge_default_options(&options);
  options.method = 7;
  CHECK_STATUS(fuge_bodies_solve(m.all, &options, m.pairs), FUGE_ERR_OPTION);
  options.method = FUGE_TABLEAU;
  CHECK_DONE(fuge_bodies_solve(m.all, &options, NULL));
  check_solution(&m, &lower, &upper);
#ifdef HAVE_SPARSE
  CHECK_DONE(fuge_bodies_solve_sparse(m.all, NULL, m.pairs));
  check_solution(&m, &lower, &upper);
#endif
  free_model(&m);
  fuge_bodies_free(&m.all);
  fuge_bodies_free(NULL);
}

/* Dense matrices and bands, of which one triangle is read, stand for the same bodies. */
static void test_other_matrices(void) {
  const block lower = make_block(2, 0.0), upper = make_block(3, 1.0);
  const int fixed[4] = {1, 3, 5, 0};
  for (int up = 0; up <= 1; up++) {
    model m = two_blocks(&lower, &upper), other = no_bodies();
    const int n = upper.degrees;
    double band[DEGREES * DEGREES] = {0}, load[DEGREES] = {0}, force[2][MOST];
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++)
        if (up ? i <= j : i >= j) band[(up ? n - 1 : 0) + i - j + j * n] = upper.matrix[i + n * j];
    load[9] = load[15] = -PRESSURE / 6.0;
    load[11] = load[13] = -PRESSURE / 3.0;
    CHECK_DONE(fuge_body_dense(lower.degrees, lower.matrix, lower.degrees, &other.body[0], NULL, 0));
    CHECK_DONE(fuge_body_band(n, n - 1, band, n, up, &other.body[1], NULL, 0));
    for (int k = 0; k < 2; k++) CHECK_DONE(fuge_bodies_add(other.all, other.body[k], NULL));
    CHECK_DONE(fuge_body_fix(other.body[0], 4, fixed, NULL));
    CHECK_DONE(fuge_body_set_load(other.body[1], load));
    set_surfaces(&other, &lower, &upper, upper.bottom, lower.top);
    CHECK_DONE(add_pair(&other, 1, 0));
    CHECK_DONE(fuge_bodies_solve(m.all, NULL, NULL));
    CHECK_DONE(fuge_bodies_solve(other.all, NULL, NULL));
    CHECK_DONE(fuge_bodies_get_forces(m.all, force[0], NULL, NULL));
    CHECK_DONE(fuge_bodies_get_forces(other.all, force[1], NULL, NULL));
    for (int i = 0; i < 4; i++) CHECK_NEAR(force[1][i], force[0][i], 1e-15);
    free_model(&m);
    free_model(&other);
  }
}

/* The lower block alone on rigid ground, with its rigid modes known. */
static void test_rigid_ground(void) {
  const block b = make_block(2, 0.0);
  const double ground[4] = {-1.0, 0.0, 2.0, 0.0};
  const int face[2] = {1, 0};
  double modes[3 * DEGREES], load[DEGREES] = {0}, pressure[MOST];
  model m = no_bodies();

  CHECK_DONE(fuge_rigid_modes(2, b.nodes, b.x, modes, NULL, 0));
  load[7] = load[11] = -0.25 * PRESSURE;
  load[9] = -0.5 * PRESSURE;
  add(&m, 0, &b);
  CHECK_DONE(fuge_body_set_load(m.body[0], load));
  CHECK_DONE(fuge_body_set_rigid_modes(m.body[0], 3, modes));
  CHECK_DONE(fuge_pairs_set_contact(m.pairs, 2, b.nodes, b.x, 2, 2, b.bottom, b.dof));
  CHECK_DONE(fuge_pairs_set_opposite(m.pairs, 2, 2, ground, 2, 1, face, NULL));
  CHECK_DONE(add_pair(&m, 0, -1));
  for (int known = 1; known >= 0; known--) {
    if (!known) CHECK_DONE(fuge_body_set_rigid_modes(m.body[0], 0, NULL));
    CHECK_DONE(fuge_bodies_solve(m.all, NULL, NULL));
    CHECK_DONE(fuge_bodies_get_forces(m.all, NULL, pressure, NULL));
    for (int i = 0; i < 3; i++) CHECK_NEAR(pressure[i], PRESSURE, 1e-14);
  }
  free_model(&m);
}

/* By hand, from the joined bodies, in the order of the header. */
static void test_bodies_as_one(void) {
  const block lower = make_block(2, 0.0), upper = make_block(3, 1.0);
  model m = two_blocks(&lower, &upper);
  int degrees = -1, entries = -1, n = -1, width = -1, first[3], dof[64], column[2 * DEGREES + 1],
      row[2 * DEGREES * DEGREES];
  double value[2 * DEGREES * DEGREES], normal[64], gap[8], play[8], area[8];

  CHECK_STATUS(fuge_bodies_get_matrix(m.all, column, NULL, NULL, NULL), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_bodies_join(m.all, m.pairs, &degrees, &entries));
  CHECK_DONE(fuge_pairs_get_sizes(m.pairs, &n, &width, NULL));
  CHECK_INT(degrees, lower.degrees + upper.degrees);
  CHECK_INT(n, 4);
  CHECK(width >= 3 && width <= 16);
  CHECK(entries > degrees && entries < lower.column[lower.degrees] + upper.column[upper.degrees]);
  CHECK_DONE(fuge_bodies_get_matrix(m.all, column, row, value, first));
  CHECK_INT(first[0], 0);
  CHECK_INT(first[1], lower.degrees);
  CHECK_INT(first[2], degrees);
  CHECK_INT(column[degrees], entries);
  for (int j = 0; j < degrees; j++)
    for (int p = column[j]; p < column[j + 1]; p++) {
      const int k = j < first[1] ? 0 : 1;
      const block *b = k == 0 ? &lower : &upper;
      CHECK(row[p] <= j && row[p] >= first[k]);
      CHECK_NEAR(value[p], b->matrix[row[p] - first[k] + b->degrees * (j - first[k])], 1e-15);
    }
  CHECK_DONE(fuge_pairs_get_contact(m.pairs, dof, normal));
  CHECK_DONE(fuge_pairs_get_gaps(m.pairs, gap, play, area));
  for (int i = 0; i < n; i++) {
    double sum = 0.0;
    for (int k = 0; k < width; k++)
      if (dof[k + i * width] >= 0) sum += normal[k + i * width];
    CHECK_NEAR(sum, 0.0, 1e-14);
    CHECK(isinf(play[i]));
    CHECK_NEAR(gap[i], 0.0, 1e-16);
  }
  /* A join that fails leaves none. */
  set_surfaces(&m, &lower, &upper, upper.bottom, lower.bottom);
  CHECK_DONE(add_pair(&m, 1, 0));
  CHECK_STATUS(fuge_bodies_join(m.all, NULL, NULL, NULL), FUGE_ERR_MESH);
  CHECK_STATUS(fuge_bodies_get_matrix(m.all, column, NULL, NULL, NULL), FUGE_ERR_CALL_ORDER);
  free_model(&m);
}

static void test_refusals(void) {
  const block lower = make_block(2, 0.0), upper = make_block(3, 1.0);
  const int broken[2] = {0, 20};
  const double displacement[2] = {0.0, 0.0};
  double u[DEGREES] = {SENTINEL};
  char message[FUGE_MESSAGE_LENGTH + 1];
  fuge_body *body = NULL;
  fuge_info info;

  CHECK_STATUS(fuge_bodies_create(NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_bodies_solve(NULL, NULL, NULL), FUGE_ERR_POINTER);
  model m = no_bodies();
  CHECK_STATUS(fuge_bodies_get_info(m.all, &info), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_bodies_solve(m.all, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_columns(0, lower.column, lower.row, lower.value, &body, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_body_columns(lower.degrees, NULL, lower.row, lower.value, &body, NULL, 0), FUGE_ERR_POINTER);
  CHECK(body == NULL);
  CHECK_STATUS(fuge_bodies_add(m.all, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(add_pair(&m, 0, -1), FUGE_ERR_CALL_ORDER);
  set_surfaces(&m, &lower, &upper, upper.bottom, lower.top);
  CHECK_STATUS(fuge_bodies_add_pair(m.all, 1, 0, NULL, FUGE_MORTAR, FUGE_NORMALS_AVERAGED, NULL, 0.0, INFINITY, 0, 1),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_bodies_add_pair(m.all, 1, 0, m.pairs, FUGE_MORTAR, FUGE_NORMALS_GIVEN, NULL, 0.0, INFINITY, 0, 1),
               FUGE_ERR_POINTER);
  add(&m, 0, &lower);
  CHECK_DONE(add_pair(&m, 1, 0));
  CHECK_STATUS(fuge_bodies_solve(m.all, NULL, NULL), FUGE_ERR_SIZE);
  CHECK_DONE(fuge_bodies_message(m.all, message, sizeof message));
  CHECK_CONTAINS(message, "contact_body = 1 is not one of the 1 bodies");
  free_model(&m);

  /* Bodies and degrees of freedom from 0 in messages. */
  m = two_blocks(&lower, &upper);
  CHECK_DONE(fuge_body_fix(m.body[1], 2, broken, displacement));
  CHECK_STATUS(fuge_bodies_get_forces(m.all, u, NULL, NULL), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_bodies_solve(m.all, NULL, m.pairs), FUGE_ERR_DOF);
  CHECK_STATUS(fuge_pairs_get_sizes(m.pairs, NULL, NULL, NULL), FUGE_ERR_CALL_ORDER);
  CHECK_DONE(fuge_bodies_message(m.all, message, sizeof message));
  CHECK_CONTAINS(message, "body 1: fixed(1) = 20 is not one of the 16 degrees of freedom");
  CHECK_DONE(fuge_bodies_get_info(m.all, &info));
  CHECK_INT(info.status, FUGE_ERR_DOF);
  CHECK_STATUS(fuge_bodies_get_displacement(m.all, 0, u), FUGE_ERR_CALL_ORDER);
  CHECK_UNTOUCHED(u, 1);
  CHECK_DONE(fuge_body_fix(m.body[1], 0, NULL, NULL));
  CHECK_DONE(fuge_bodies_solve(m.all, NULL, NULL));
  CHECK_STATUS(fuge_bodies_get_displacement(m.all, 2, u), FUGE_ERR_SIZE);
  CHECK_UNTOUCHED(u, 1);
  /* The surfaces look the same way. */
  set_surfaces(&m, &lower, &upper, upper.bottom, lower.bottom);
  CHECK_DONE(add_pair(&m, 1, 0));
  CHECK_STATUS(fuge_bodies_join(m.all, NULL, NULL, NULL), FUGE_ERR_MESH);
  CHECK_DONE(fuge_bodies_message(m.all, message, sizeof message));
  CHECK_CONTAINS(message, "pair 1, contact body 1, opposite body 0: ");
  /* Both look into their bodies. */
  model inwards = two_blocks(&lower, &upper);
  int turned[6], below[4];
  for (int k = 0; k < 6; k++) turned[k] = upper.bottom[k % 2 == 0 ? k + 1 : k - 1];
  for (int k = 0; k < 4; k++) below[k] = lower.top[k % 2 == 0 ? k + 1 : k - 1];
  set_surfaces(&inwards, &lower, &upper, turned, below);
  CHECK_DONE(add_pair(&inwards, 1, 0));
  CHECK_STATUS(fuge_bodies_join(inwards.all, NULL, NULL, NULL), FUGE_ERR_MESH);
  CHECK_DONE(fuge_bodies_message(inwards.all, message, sizeof message));
  CHECK_CONTAINS(message, "pair 1: contact surface of body 1: face 0 looks into the body");
  free_model(&inwards);
  /* The last solution stays. */
  CHECK_STATUS(fuge_bodies_solve(m.all, NULL, NULL), FUGE_ERR_MESH);
  CHECK_DONE(fuge_bodies_get_displacement(m.all, 0, u));
  free_model(&m);
}

int main(void) {
  test_solve();
  test_other_matrices();
  test_rigid_ground();
  test_bodies_as_one();
  test_refusals();
  return check_summary();
}
