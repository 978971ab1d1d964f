/* Section "graded bodies" of fuge_layers.h. */
#include "check.h"

enum { POINTS = 2, MOST = 300 };
static const double DEPTH[POINTS] = {0.0, 2.0}, YOUNG[POINTS] = {1.0, 8.0}, POISSON[POINTS] = {0.3, 0.2};

typedef struct result {
  int layers;
  double thickness[MOST], young[MOST + 1], poisson[MOST + 1], error;
} result;

static void clear(result *found) {
  found->layers = -77;
  fill(found->thickness, MOST);
  fill(found->young, MOST + 1);
  fill(found->poisson, MOST + 1);
  fill(&found->error, 1);
}

static int divide(int points, const double *depth, const double *young, const double *poisson, double tolerance,
                  int most,
                  result *found, char *message, size_t len) {
  return fuge_graded_layers(points, depth, young, poisson, tolerance, most, &found->layers, found->thickness,
                            found->young,
                            found->poisson, &found->error, message, len);
}

/* Layers that get thicker downwards, each with the moduli of its middle. */
static void test_layers(void) {
  static result found;
  double depth = 0.0;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  clear(&found);
  CHECK_MESSAGE(divide(POINTS, DEPTH, YOUNG, POISSON, 1e-3, MOST, &found, message, sizeof message), FUGE_DONE, message,
                "");
  CHECK(found.layers > 10 && found.layers < 150);
  CHECK(found.error > 0.0 && found.error <= 1e-3);
  for (int k = 0; k < found.layers; k++) {
    const double middle = (depth + 0.5 * found.thickness[k]) / 2.0;
    depth += found.thickness[k];
    CHECK_NEAR(found.young[k], 1.0 + 7.0 * middle, 1e-13);
    CHECK_NEAR(found.poisson[k], 0.3 - 0.1 * middle, 1e-13);
    CHECK(k == 0 || found.thickness[k] > found.thickness[k - 1]);
  }
  CHECK_NEAR(depth, 2.0, 1e-14);
  CHECK_NEAR(found.young[found.layers], 8.0, 0.0);
  CHECK_NEAR(found.poisson[found.layers], 0.2, 0.0);
  CHECK_UNTOUCHED(found.thickness + found.layers, MOST - found.layers);
  CHECK_UNTOUCHED(found.young + found.layers + 1, MOST - found.layers);
  CHECK_UNTOUCHED(found.poisson + found.layers + 1, MOST - found.layers);
}

/* Waves on few and on many layers differ by the errors of both. */
static void test_error(void) {
  static result few, many;
  const double q[4] = {0.03, 0.5, 8.0, 1e3};
  double coarse[4], fine[4];
  CHECK_DONE(divide(POINTS, DEPTH, YOUNG, POISSON, 1e-2, MOST, &few, NULL, 0));
  CHECK_DONE(divide(POINTS, DEPTH, YOUNG, POISSON, 1e-4, MOST, &many, NULL, 0));
  CHECK(many.layers > 5 * few.layers);
  CHECK_DONE(fuge_layered_waves(few.layers, few.thickness, few.young, few.poisson, 1, HUGE_VAL, 4, q, coarse, NULL, 0));
  CHECK_DONE(fuge_layered_waves(many.layers, many.thickness, many.young, many.poisson, 1, HUGE_VAL, 4, q, fine, NULL,
                                0));
  for (int k = 0; k < 4; k++) CHECK_NEAR(coarse[k] / fine[k], 1.0, 1.2 * few.error + many.error);
}

/* What is constant is one layer; jumps, a rigid base, and a half-space without layers. */
static void test_constant(void) {
  static result found;
  const double depth[4] = {0.0, 0.5, 0.5, 2.0}, young[4] = {3.0, 3.0, 1.0, 1.0}, poisson[4] = {0.3, 0.3, 0.3, 0.3};
  const double on_rigid[3] = {0.0, 1.0, 1.0}, rigid[3] = {2.0, 2.0, HUGE_VAL};
  CHECK_DONE(divide(4, depth, young, poisson, 1e-4, 2, &found, NULL, 0));
  CHECK_INT(found.layers, 2);
  CHECK_VALUES(found.thickness, 1e-15, 0.5, 1.5);
  CHECK_VALUES(found.young, 0.0, 3.0, 1.0, 1.0);
  CHECK_NEAR(found.error, 0.0, 0.0);
  CHECK_DONE(divide(3, on_rigid, rigid, poisson, 1e-4, 1, &found, NULL, 0));
  CHECK_INT(found.layers, 1);
  CHECK(found.young[0] == 2.0 && found.young[1] == HUGE_VAL);
  CHECK_DONE(fuge_graded_layers(1, depth, young, poisson, 1e-4, 0, &found.layers, NULL, found.young, found.poisson,
                                NULL,
                                NULL, 0));
  CHECK_INT(found.layers, 0);
}

static void check_refused(int status, const char *part, int points, const double *depth, const double *young,
                          const double *poisson, double tolerance, int most) {
  static result found;
  char message[FUGE_MESSAGE_LENGTH + 1];
  clear(&found);
  CHECK_SAYS(divide(points, depth, young, poisson, tolerance, most, &found, message, sizeof message), status, message,
             part);
  CHECK_INT(found.layers, -77);
  CHECK_UNTOUCHED(found.thickness, MOST);
  CHECK_UNTOUCHED(found.young, MOST + 1);
  CHECK_UNTOUCHED(found.poisson, MOST + 1);
  CHECK_UNTOUCHED(&found.error, 1);
}

/* Indices in messages count from 0. */
static void test_refusals(void) {
  static result found;
  const double above[POINTS] = {0.0, -1.0}, below[POINTS] = {0.5, 1.0}, nan[POINTS] = {0.0, NAN};
  const double soft[POINTS] = {1.0, 0.0}, rigid[POINTS] = {1.0, HUGE_VAL}, swelling[POINTS] = {0.3, 0.7};
  char message[FUGE_MESSAGE_LENGTH + 1];
  check_refused(FUGE_ERR_SIZE, "points = 0", 0, DEPTH, YOUNG, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_SIZE, "max_layers = -1", POINTS, DEPTH, YOUNG, POISSON, 1e-3, -1);
  check_refused(FUGE_ERR_POINTER, "depth is NULL", POINTS, NULL, YOUNG, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_POINTER, "young is NULL", POINTS, DEPTH, NULL, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_POINTER, "poisson is NULL", POINTS, DEPTH, YOUNG, NULL, 1e-3, MOST);
  check_refused(FUGE_ERR_NOT_FINITE, "depth(1) = NaN", POINTS, nan, YOUNG, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_WIDTH, "depth(0) = 0.5", POINTS, below, YOUNG, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_WIDTH, "depth(1) = -1.", POINTS, above, YOUNG, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_MODULUS, "young(1) = 0.", POINTS, DEPTH, soft, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_MODULUS, "rigid base", POINTS, DEPTH, rigid, POISSON, 1e-3, MOST);
  check_refused(FUGE_ERR_MODULUS, "poisson(1) = 0.7", POINTS, DEPTH, YOUNG, swelling, 1e-3, MOST);
  check_refused(FUGE_ERR_OPTION, "tolerance = 0.", POINTS, DEPTH, YOUNG, POISSON, 0.0, MOST);
  check_refused(FUGE_ERR_NOT_FINITE, "tolerance", POINTS, DEPTH, YOUNG, POISSON, NAN, MOST);
  check_refused(FUGE_ERR_ITERATION_LIMIT, "max_layers = 10", POINTS, DEPTH, YOUNG, POISSON, 1e-3, 10);
  CHECK_SAYS(fuge_graded_layers(POINTS, DEPTH, YOUNG, POISSON, 1e-3, MOST, NULL, found.thickness, found.young,
                                found.poisson, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
                                "layers is NULL");
  CHECK_SAYS(fuge_graded_layers(POINTS, DEPTH, YOUNG, POISSON, 1e-3, MOST, &found.layers, NULL, found.young,
                                found.poisson, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
             "thickness is NULL");
  CHECK_SAYS(fuge_graded_layers(POINTS, DEPTH, YOUNG, POISSON, 1e-3, MOST, &found.layers, found.thickness, NULL,
                                found.poisson, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
             "layer_young is NULL");
  CHECK_SAYS(fuge_graded_layers(POINTS, DEPTH, YOUNG, POISSON, 1e-3, MOST, &found.layers, found.thickness, found.young,
                                NULL, NULL, message, sizeof message), FUGE_ERR_POINTER, message,
                                "layer_poisson is NULL");
}

int main(void) {
  test_layers();
  test_error();
  test_constant();
  test_refusals();
  return check_summary();
}
