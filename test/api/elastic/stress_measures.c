/* Section "stress measures" of fuge_elastic.h. */
#include "check.h"

enum { POINTS = 2 };

/* Tension along z, and shear in the xz-plane. */
static const double TENSOR[6 * POINTS] = {0, 0, 3, 0, 0, 0, -1, -1, -1, 0, 2, 0};

static void test_all_measures(void) {
  double principal[3 * POINTS + 1], mises[POINTS + 1], tresca[POINTS + 1], mean[POINTS + 1];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(principal, 3 * POINTS + 1);
  fill(mises, POINTS + 1);
  fill(tresca, POINTS + 1);
  fill(mean, POINTS + 1);
  CHECK_MESSAGE(fuge_measure_stresses(POINTS, TENSOR, principal, mises, tresca, mean, message, sizeof message),
                FUGE_DONE, message, "");
  CHECK_VALUES(mises, 1e-15, 3.0, 2.0 * sqrt(3.0));
  CHECK_VALUES(tresca, 1e-15, 3.0, 4.0);
  CHECK_VALUES(mean, 1e-15, 1.0, -1.0);
  CHECK_NEAR(principal[0], 3.0, 0.0);
  CHECK_NEAR(principal[2], 0.0, 0.0);
  CHECK_NEAR(principal[3], 1.0, 1e-15);
  CHECK_NEAR(principal[4], -1.0, 1e-15);
  CHECK_NEAR(principal[5], -3.0, 1e-15);
  CHECK_UNTOUCHED(principal + 3 * POINTS, 1);
  CHECK_UNTOUCHED(mises + POINTS, 1);
  CHECK_UNTOUCHED(tresca + POINTS, 1);
  CHECK_UNTOUCHED(mean + POINTS, 1);
}

/* Each alone. */
static void test_one_measure(void) {
  double value[3 * POINTS];
  CHECK_DONE(fuge_measure_stresses(POINTS, TENSOR, NULL, value, NULL, NULL, NULL, 0));
  CHECK_VALUES(value, 1e-15, 3.0, 2.0 * sqrt(3.0));
  CHECK_DONE(fuge_measure_stresses(POINTS, TENSOR, NULL, NULL, value, NULL, NULL, 0));
  CHECK_VALUES(value, 1e-15, 3.0, 4.0);
  CHECK_DONE(fuge_measure_stresses(POINTS, TENSOR, NULL, NULL, NULL, value, NULL, 0));
  CHECK_VALUES(value, 1e-15, 1.0, -1.0);
  CHECK_DONE(fuge_measure_stresses(POINTS, TENSOR, value, NULL, NULL, NULL, NULL, 0));
  CHECK_NEAR(value[0], 3.0, 0.0);
  CHECK_DONE(fuge_measure_stresses(POINTS, TENSOR, NULL, NULL, NULL, NULL, NULL, 0));
}

static void test_refusals(void) {
  double value[6];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fill(value, 6);
  CHECK_STATUS(fuge_measure_stresses(-1, TENSOR, NULL, value, NULL, NULL, NULL, 0), FUGE_ERR_SIZE);
  CHECK_SAYS(fuge_measure_stresses(1, NULL, NULL, NULL, value, NULL, message, sizeof message), FUGE_ERR_POINTER,
             message, "tensor is NULL");
  CHECK_UNTOUCHED(value, 6);
  CHECK_DONE(fuge_measure_stresses(0, TENSOR, value, value, value, value, NULL, 0));
  CHECK_UNTOUCHED(value, 6);
}

int main(void) {
  test_all_measures();
  test_one_measure();
  test_refusals();
  return check_summary();
}
