/* Section "stress measures" of fuge_elastic.h. */
#include "check.h"

enum { POINTS = 2 };

/* Tension along z, and shear in the xz-plane. */
static const double TENSOR[6 * POINTS] = {0, 0, 3, 0, 0, 0, -1, -1, -1, 0, 2, 0};

static void test_scalars(void) {
  double value[POINTS + 1];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(value, POINTS + 1);
  CHECK_MESSAGE(fuge_von_mises(POINTS, TENSOR, value, message, sizeof message), FUGE_DONE, message, "");
  CHECK_VALUES(value, 1e-15, 3.0, 2.0 * sqrt(3.0));
  CHECK_DONE(fuge_tresca(POINTS, TENSOR, value, NULL, 0));
  CHECK_VALUES(value, 1e-15, 3.0, 4.0);
  CHECK_DONE(fuge_mean_stress(POINTS, TENSOR, value, NULL, 0));
  CHECK_VALUES(value, 1e-15, 1.0, -1.0);
  CHECK_UNTOUCHED(value + POINTS, 1);
}

static void test_principal_stresses(void) {
  double principal[3 * POINTS + 1];
  fill(principal, 3 * POINTS + 1);
  CHECK_DONE(fuge_principal_stresses(POINTS, TENSOR, principal, NULL, 0));
  CHECK_NEAR(principal[0], 3.0, 0.0);
  CHECK_NEAR(principal[2], 0.0, 0.0);
  CHECK_NEAR(principal[3], 1.0, 1e-15);
  CHECK_NEAR(principal[4], -1.0, 1e-15);
  CHECK_NEAR(principal[5], -3.0, 1e-15);
  CHECK_UNTOUCHED(principal + 3 * POINTS, 1);
}

static void test_refusals(void) {
  double value[6];
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fill(value, 6);
  CHECK_STATUS(fuge_von_mises(-1, TENSOR, value, NULL, 0), FUGE_ERR_SIZE);
  CHECK_SAYS(fuge_tresca(1, NULL, value, message, sizeof message), FUGE_ERR_POINTER, message, "tensor is NULL");
  CHECK_STATUS(fuge_mean_stress(1, TENSOR, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_principal_stresses(1, TENSOR, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(value, 6);
  CHECK_DONE(fuge_von_mises(0, TENSOR, value, NULL, 0));
  CHECK_UNTOUCHED(value, 6);
}

int main(void) {
  test_scalars();
  test_principal_stresses();
  test_refusals();
  return check_summary();
}
