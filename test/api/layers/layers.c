/* Section "layers" of fuge_layers.h. */
#include <limits.h>
#include "check.h"

enum { LAYERS = 2, N = 4, LDA = 5 };
static const double THICKNESS[LAYERS] = {0.2, 0.5}, YOUNG[LAYERS + 1] = {4.0, 1.0, 2.0};
static const double POISSON[LAYERS + 1] = {0.3, 0.4, 0.2};
/* Layers of one material, which are none, with its E/(1 - nu^2). */
static const double SAME_YOUNG[LAYERS + 1] = {2.0, 2.0, 2.0}, SAME_POISSON[LAYERS + 1] = {0.3, 0.3, 0.3};
static const double SAME_E_STAR = 2.0 / 0.91;
static const double X[N] = {-1.5, -0.5, 0.5, 1.5}, Y[N] = {0.0, 0.0, 0.0, 0.0}, ONES[N] = {1, 1, 1, 1};
static const double RADIUS[N + 1] = {0.0, 0.5, 1.0, 2.0, 2.5};

/* The body of an operator or a matrix: two layers, or none at all. */
typedef struct body {
  int layers;
  const double *thickness, *young, *poisson;
  int bonded;
  double e_star_other;
} body;

static const body LAYERED = {LAYERS, THICKNESS, YOUNG, POISSON, 1, HUGE_VAL};
static const body ALIKE = {LAYERS, THICKNESS, SAME_YOUNG, SAME_POISSON, 1, HUGE_VAL};

enum { HALFPLANE, HALFSPACE, RINGS, MATRICES };

/* An influence matrix of one of these kinds. */
static int matrix(int kind, const body *of, int n, double *alpha, int lda, char *message, size_t len) {
  if (kind == HALFPLANE)
    return fuge_layered_halfplane_matrix(of->layers, of->thickness, of->young, of->poisson, of->bonded,
                                         of->e_star_other, n, X, ONES, FUGE_MEAN, 0, alpha, lda, message, len);
  if (kind == HALFSPACE)
    return fuge_layered_halfspace_matrix(of->layers, of->thickness, of->young, of->poisson, of->bonded,
                                         of->e_star_other, n, X, Y, ONES, ONES, FUGE_MEAN, 0, 0, alpha, lda, message,
                                         len);
  return fuge_layered_ring_matrix(of->layers, of->thickness, of->young, of->poisson, of->bonded, of->e_star_other, n,
                                  RADIUS, alpha, lda, message, len);
}

/* Layers that are none: the matrices of the half-plane and the half-space; rows beyond n are padding. */
static void test_no_layers(void) {
  for (int kind = 0; kind < MATRICES; kind++) {
    double alpha[LDA * N], right[LDA * N];
    char message[FUGE_MESSAGE_LENGTH + 1] = "old";
    fill(alpha, LDA * N);
    CHECK_MESSAGE(matrix(kind, &ALIKE, N, alpha, LDA, message, sizeof message), FUGE_DONE, message, "");
    if (kind == HALFPLANE)
      CHECK_DONE(fuge_halfplane_matrix(N, X, ONES, SAME_E_STAR, FUGE_MEAN, 0, right, LDA, NULL, 0));
    else if (kind == HALFSPACE)
      CHECK_DONE(fuge_halfspace_matrix(N, X, Y, ONES, ONES, SAME_E_STAR, FUGE_MEAN, 0, 0, right, LDA, NULL, 0));
    else
      CHECK_DONE(fuge_ring_matrix(N, RADIUS, SAME_E_STAR, FUGE_MEAN, right, LDA, NULL, 0));
    for (int k = 0; k < N; k++) {
      for (int i = 0; i < N; i++) CHECK_NEAR(alpha[i + LDA * k], right[i + LDA * k], 1e-14);
      CHECK_UNTOUCHED(alpha + N + LDA * k, 1);
    }
  }
}

/* Half of a symmetric model: the sum over a cell and its image. */
static void test_folded(void) {
  double whole[N * N], half[4];
  CHECK_DONE(matrix(HALFPLANE, &LAYERED, N, whole, N, NULL, 0));
  CHECK_DONE(fuge_layered_halfplane_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, HUGE_VAL, 2, X + 2, ONES, FUGE_MEAN, 1,
                                           half, 2, NULL, 0));
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 2; i++)
      CHECK_NEAR(half[i + 2 * j], 0.5 * (whole[i + 2 + N * (j + 2)] + whole[i + 2 + N * (1 - j)]), 1e-13);
  CHECK_DONE(matrix(HALFSPACE, &LAYERED, N, whole, N, NULL, 0));
  CHECK_DONE(fuge_layered_halfspace_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, HUGE_VAL, 2, X + 2, Y + 2, ONES, ONES,
                                           FUGE_MEAN, 1, 0, half, 2, NULL, 0));
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 2; i++)
      CHECK_NEAR(half[i + 2 * j], 0.5 * (whole[i + 2 + N * (j + 2)] + whole[i + 2 + N * (1 - j)]), 1e-13);
}

enum { NX = 6, NY = 5, CELLS = NX * NY };

/* Products by FFT are those of the matrices, for bonded and for sliding layers, against a soft body too. */
static void test_products(void) {
  static double alpha[CELLS * CELLS];
  double x[CELLS], y[CELLS], width_x[CELLS], width_y[CELLS], f[CELLS], u[CELLS], right;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  for (int k = 0; k < CELLS; k++) {
    x[k] = 0.5 * (k % NX);
    y[k] = 0.25 * (k / NX);
    width_x[k] = 0.5;
    width_y[k] = 0.25;
    f[k] = cos(k);
  }
  for (int bonded = 0; bonded < 2; bonded++) {
    fuge_operator *op = NULL;
    CHECK_MESSAGE(fuge_operator_layered_halfplane(NX, 0.5, LAYERS, THICKNESS, YOUNG, POISSON, bonded, 3.0, FUGE_MEAN,
                                                  FUGE_FREE, &op, message, sizeof message), FUGE_DONE, message, "");
    CHECK_DONE(fuge_operator_apply(op, NX, f, u, message, sizeof message));
    CHECK_DONE(fuge_layered_halfplane_matrix(LAYERS, THICKNESS, YOUNG, POISSON, bonded, 3.0, NX, x, width_x, FUGE_MEAN,
                                             0,
                                             alpha, NX, NULL, 0));
    for (int i = 0; i < NX; i++) {
      right = 0.0;
      for (int k = 0; k < NX; k++) right += alpha[i + NX * k] * f[k];
      CHECK_NEAR(u[i], right, 1e-12);
    }
    fuge_operator_free(&op);
    CHECK_MESSAGE(fuge_operator_layered_halfspace(NX, NY, 0.5, 0.25, LAYERS, THICKNESS, YOUNG, POISSON, bonded, 3.0,
                                                  FUGE_MEAN, FUGE_FREE, &op, message, sizeof message), FUGE_DONE,
                                                  message,
                  "");
    CHECK_DONE(fuge_operator_apply(op, CELLS, f, u, message, sizeof message));
    CHECK_DONE(fuge_layered_halfspace_matrix(LAYERS, THICKNESS, YOUNG, POISSON, bonded, 3.0, CELLS, x, y, width_x,
                                             width_y,
                                             FUGE_MEAN, 0, 0, alpha, CELLS, NULL, 0));
    for (int i = 0; i < CELLS; i++) {
      right = 0.0;
      for (int k = 0; k < CELLS; k++) right += alpha[i + CELLS * k] * f[k];
      CHECK_NEAR(u[i], right, 1e-12);
    }
    fuge_operator_free(&op);
  }
}

/* A layer on a rigid base: equal forces on all of a periodic surface compress it. */
static void test_periodic(void) {
  const double young[2] = {2.0, HUGE_VAL}, poisson[2] = {0.25, 0.0}, h = 0.1, pressure = 0.01;
  const double oedometric = 2.0 * 0.75 / (1.25 * 0.5);
  double f[CELLS], u[CELLS];
  fuge_operator *op = NULL;
  for (int k = 0; k < CELLS; k++) f[k] = pressure * 0.125;
  CHECK_DONE(fuge_operator_layered_halfspace(NX, NY, 0.5, 0.25, 1, &h, young, poisson, 1, HUGE_VAL, FUGE_MEAN,
                                             FUGE_PERIODIC, &op, NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, CELLS, f, u, NULL, 0));
  for (int k = 0; k < CELLS; k++) CHECK_NEAR(u[k], pressure * h / oedometric, 1e-10 * pressure);
  fuge_operator_free(&op);
  for (int k = 0; k < NX; k++) f[k] = pressure * 0.5;
  CHECK_DONE(fuge_operator_layered_halfplane(NX, 0.5, 1, &h, young, poisson, 1, HUGE_VAL, FUGE_MEAN, FUGE_PERIODIC, &op,
                                             NULL, 0));
  CHECK_DONE(fuge_operator_apply(op, NX, f, u, NULL, 0));
  for (int k = 0; k < NX; k++) CHECK_NEAR(u[k], pressure * h / oedometric, 1e-10 * pressure);
  fuge_operator_free(&op);
}

/* From the top layer's half-space to the one below; a layer in closed form (Burmister, 1945). */
static void test_waves(void) {
  const double q[3] = {1e-9, 2.0, 1e9}, young[2] = {1.0, 5.0}, poisson[2] = {0.3, 0.25}, h = 0.5;
  double compliance[4];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(compliance, 4);
  CHECK_MESSAGE(fuge_layered_waves(1, &h, young, poisson, 1, HUGE_VAL, 3, q, compliance, message, sizeof message),
                FUGE_DONE, message, "");
  CHECK_NEAR(compliance[0] * q[0], 2.0 * (1.0 - 0.0625) / 5.0, 1e-8);
  CHECK_NEAR(compliance[1] * q[1], 2.0 * 0.91 * 0.544228816954707, 1e-14);
  CHECK_NEAR(compliance[2] * q[2], 2.0 * 0.91, 1e-14);
  CHECK_UNTOUCHED(compliance + 3, 1);
  /* No layers: thickness is not read. The other body adds its own. */
  CHECK_DONE(fuge_layered_waves(0, NULL, young, poisson, 1, 2.0, 1, q + 1, compliance, NULL, 0));
  CHECK_NEAR(compliance[0], (0.91 + 0.5), 1e-14);
  CHECK_DONE(fuge_layered_waves(1, &h, young, poisson, 0, HUGE_VAL, 0, q, compliance, NULL, 0));
}

typedef struct bad_body {
  body of;
  int status;
  const char *part;
} bad_body;

static const double NO_WIDTH[LAYERS] = {0.2, 0.0}, NOT_FINITE[LAYERS] = {NAN, 0.2}, THIN[LAYERS] = {1e-9, 1.0};
static const double THICK[LAYERS] = {1.0, 1e300};
static const double NO_YOUNG[LAYERS + 1] = {4.0, -1.0, 2.0}, RIGID_LAYER[LAYERS + 1] = {4.0, HUGE_VAL, 2.0};
static const double BAD_POISSON[LAYERS + 1] = {0.3, 0.4, 0.6};

static const bad_body BAD_BODIES[] = {
  {{-1, THICKNESS, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_SIZE, "layers = -1"},
  {{INT_MAX, THICKNESS, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_SIZE, "layers = 2147483647 is too large"},
  {{LAYERS, NULL, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_POINTER, "thickness is NULL"},
  {{LAYERS, THICKNESS, NULL, POISSON, 1, HUGE_VAL}, FUGE_ERR_POINTER, "young is NULL"},
  {{LAYERS, THICKNESS, YOUNG, NULL, 1, HUGE_VAL}, FUGE_ERR_POINTER, "poisson is NULL"},
  {{LAYERS, NO_WIDTH, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_WIDTH, "thickness 2 = 0."},
  {{LAYERS, NOT_FINITE, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_NOT_FINITE, "thickness 1 = NaN"},
  {{LAYERS, THIN, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_WIDTH, "ratio"},
  {{LAYERS, THICK, YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_OVERFLOW, "thickness 2 = "},
  {{LAYERS, THICKNESS, NO_YOUNG, POISSON, 1, HUGE_VAL}, FUGE_ERR_MODULUS, "young 2 = -1."},
  {{LAYERS, THICKNESS, RIGID_LAYER, POISSON, 1, HUGE_VAL}, FUGE_ERR_MODULUS, "rigid base"},
  {{LAYERS, THICKNESS, YOUNG, BAD_POISSON, 1, HUGE_VAL}, FUGE_ERR_MODULUS, "poisson 3 = "},
  {{LAYERS, THICKNESS, YOUNG, POISSON, 1, 0.0}, FUGE_ERR_MODULUS, "e_star_other = 0."},
  {{LAYERS, THICKNESS, YOUNG, POISSON, 1, NAN}, FUGE_ERR_MODULUS, "e_star_other = NaN"},
  {{LAYERS, THICKNESS, YOUNG, POISSON, 7, HUGE_VAL}, FUGE_ERR_OPTION, "bonded is 7"},
  {{LAYERS, THICKNESS, YOUNG, POISSON, -1, HUGE_VAL}, FUGE_ERR_OPTION, "take 1 for bonded interfaces"}
};

/* What makes no layers is refused by all functions, which leave their results alone. */
static void test_bad_bodies(void) {
  char place, message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *const before = (fuge_operator *)(void *)&place;
  const double q = 1.0;
  double values[N * N];
  fill(values, N * N);
  for (size_t k = 0; k < sizeof BAD_BODIES / sizeof BAD_BODIES[0]; k++) {
    const bad_body *bad = &BAD_BODIES[k];
    const body *of = &bad->of;
    fuge_operator *op = before;
    for (int kind = 0; kind < MATRICES; kind++)
      CHECK_SAYS(matrix(kind, of, N, values, N, message, sizeof message), bad->status, message, bad->part);
    CHECK_SAYS(fuge_layered_waves(of->layers, of->thickness, of->young, of->poisson, of->bonded, of->e_star_other, 1,
                                  &q,
                                  values, message, sizeof message), bad->status, message, bad->part);
    CHECK_SAYS(fuge_operator_layered_halfplane(N, 1.0, of->layers, of->thickness, of->young, of->poisson, of->bonded,
                                               of->e_star_other, FUGE_MEAN, FUGE_FREE, &op, message, sizeof message),
               bad->status, message, bad->part);
    CHECK_SAYS(fuge_operator_layered_halfspace(2, 2, 1.0, 1.0, of->layers, of->thickness, of->young, of->poisson,
                                               of->bonded, of->e_star_other, FUGE_MEAN, FUGE_FREE, &op, message,
                                               sizeof message), bad->status, message, bad->part);
    CHECK(op == before);
  }
  CHECK_UNTOUCHED(values, N * N);
}

/* The other arguments are refused as those of the half-plane and the half-space are. */
static void test_refusals(void) {
  const double overlapping[2] = {0.0, 0.5}, bad_q[2] = {1.0, -1.0}, not_finite[2] = {HUGE_VAL, 1.0};
  const double radius[3] = {0.0, 1.0, 0.5};
  double values[N * N];
  char place, message[FUGE_MESSAGE_LENGTH + 1];
  fuge_operator *const before = (fuge_operator *)(void *)&place, *op = before;
  fill(values, N * N);
  for (int kind = 0; kind < MATRICES; kind++) {
    CHECK_STATUS(matrix(kind, &LAYERED, 0, values, N, message, sizeof message), FUGE_ERR_SIZE);
    CHECK_STATUS(matrix(kind, &LAYERED, N, values, N - 1, message, sizeof message), FUGE_ERR_SIZE);
    CHECK_SAYS(matrix(kind, &LAYERED, N, NULL, N, message, sizeof message), FUGE_ERR_POINTER, message, "alpha is NULL");
  }
  CHECK_STATUS(fuge_layered_halfplane_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, overlapping, ONES, FUGE_MEAN,
                                             0, values, 2, message, sizeof message), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_layered_halfplane_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, N, X, ONES, 7, 0, values, N,
                                             message, sizeof message), FUGE_ERR_ELEMENT);
  CHECK_SAYS(fuge_layered_halfplane_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, N, NULL, ONES, FUGE_MEAN, 0,
                                           values,
                                           N, message, sizeof message), FUGE_ERR_POINTER, message, "x is NULL");
  CHECK_SAYS(fuge_layered_halfspace_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, overlapping, Y, ONES, ONES,
                                           FUGE_MEAN, 0, 0, values, 2, message, sizeof message), FUGE_ERR_WIDTH,
                                           message,
             "rectangles 0 and 1 overlap");
  CHECK_STATUS(fuge_layered_halfspace_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, N, X, Y, ONES, ONES, FUGE_HAT,
                                             0,
                                             0, values, N, message, sizeof message), FUGE_ERR_ELEMENT);
  CHECK_STATUS(fuge_layered_ring_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, radius, values, 2, message,
                                        sizeof message), FUGE_ERR_WIDTH);
  CHECK_SAYS(matrix(RINGS, &LAYERED, INT_MAX, values, INT_MAX, message, sizeof message), FUGE_ERR_SIZE, message,
             "n = 2147483647 is too large");
  CHECK_SAYS(fuge_layered_ring_matrix(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, NULL, values, 2, message,
                                      sizeof message), FUGE_ERR_POINTER, message, "radius is NULL");
  CHECK_SAYS(fuge_layered_waves(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, bad_q, values, message, sizeof message),
             FUGE_ERR_WIDTH, message, "q 2 = -1.");
  CHECK_STATUS(fuge_layered_waves(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 2, not_finite, values, message,
                                  sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_SAYS(fuge_layered_waves(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, -1, bad_q, values, message, sizeof message),
             FUGE_ERR_SIZE, message, "waves = -1");
  CHECK_SAYS(fuge_layered_waves(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 1, NULL, values, message, sizeof message),
             FUGE_ERR_POINTER, message, "q is NULL");
  CHECK_SAYS(fuge_layered_waves(LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, 1, bad_q, NULL, message, sizeof message),
             FUGE_ERR_POINTER, message, "compliance is NULL");
  CHECK_UNTOUCHED(values, N * N);
  CHECK_SAYS(fuge_operator_layered_halfplane(0, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN, FUGE_FREE,
                                             &op,
                                             message, sizeof message), FUGE_ERR_SIZE, message, "n = 0");
  CHECK_STATUS(fuge_operator_layered_halfplane(N, 0.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN, FUGE_FREE,
                                               &op, message, sizeof message), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_operator_layered_halfplane(N, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN,
                                               FUGE_PERIODIC_Y, &op, message, sizeof message), FUGE_ERR_OPTION);
  CHECK_SAYS(fuge_operator_layered_halfplane(N, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN, FUGE_FREE,
                                             NULL,
                                             message, sizeof message), FUGE_ERR_POINTER, message, "op is NULL");
  CHECK_SAYS(fuge_operator_layered_halfspace(2, 0, 1.0, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN,
                                             FUGE_FREE, &op, message, sizeof message), FUGE_ERR_SIZE, message,
                                             "ny = 0");
  CHECK_STATUS(fuge_operator_layered_halfspace(2, 2, 1.0, -1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN,
                                               FUGE_FREE, &op, message, sizeof message), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_operator_layered_halfspace(2, 2, 1.0, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_HAT,
                                               FUGE_FREE, &op, message, sizeof message), FUGE_ERR_ELEMENT);
  CHECK_STATUS(fuge_operator_layered_halfspace(2, 2, 1.0, 1.0, LAYERS, THICKNESS, YOUNG, POISSON, 1, 1.0, FUGE_MEAN,
                                               FUGE_FREE, NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK(op == before);
}

int main(void) {
  test_no_layers();
  test_folded();
  test_products();
  test_periodic();
  test_waves();
  test_bad_bodies();
  test_refusals();
  return check_summary();
}
