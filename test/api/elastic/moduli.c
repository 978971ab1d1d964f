/* Section "two bodies" of fuge_elastic.h. */
#include "check.h"

static void test_moduli(void) {
  double strain = 0.0, stress = 0.0, e_star = 0.0, share1 = 0.0, share2 = 0.0;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_DONE(fuge_plane_modulus(210.0, 0.25, FUGE_PLANE_STRAIN, &strain, message, sizeof message));
  CHECK_STRING(message, "");
  CHECK_NEAR(strain, 224.0, 1e-13);
  CHECK_DONE(fuge_plane_modulus(210.0, 0.25, FUGE_PLANE_STRESS, &stress, NULL, 0));
  CHECK_NEAR(stress, 210.0, 0.0);
  CHECK_DONE(fuge_combined_modulus(3.0, 6.0, &e_star, NULL, 0));
  CHECK_NEAR(e_star, 2.0, 1e-15);
  CHECK_DONE(fuge_displacement_shares(3.0, 6.0, &share1, &share2, NULL, 0));
  CHECK_NEAR(share1, 2.0 / 3.0, 1e-15);
  CHECK_NEAR(share2, 1.0 / 3.0, 1e-15);
}

static void test_rigid_body(void) {
  double e_star = 0.0, share1 = -1.0, share2 = -1.0;
  CHECK_DONE(fuge_combined_modulus(INFINITY, 5.0, &e_star, NULL, 0));
  CHECK_NEAR(e_star, 5.0, 0.0);
  CHECK_DONE(fuge_displacement_shares(INFINITY, 5.0, &share1, &share2, NULL, 0));
  CHECK_NEAR(share1, 0.0, 0.0);
  CHECK_NEAR(share2, 1.0, 0.0);
}

static void test_refusals(void) {
  double out[2];
  char message[FUGE_MESSAGE_LENGTH + 1] = "", small[8];
  fill(out, 2);
  CHECK_STATUS(fuge_plane_modulus(0.0, 0.3, FUGE_PLANE_STRAIN, out, message, sizeof message), FUGE_ERR_MODULUS);
  CHECK_CONTAINS(message, "young = 0.0");
  CHECK_STATUS(fuge_plane_modulus(1.0, 0.6, FUGE_PLANE_STRAIN, out, message, sizeof message), FUGE_ERR_MODULUS);
  CHECK_CONTAINS(message, "poisson = 0.6");
  CHECK_CONTAINS(message, "Poisson's ratio, is above 0.5");
  CHECK_STATUS(fuge_plane_modulus(1.0, NAN, FUGE_PLANE_STRAIN, out, NULL, 0), FUGE_ERR_NOT_FINITE);
  CHECK_MESSAGE(fuge_plane_modulus(1.0, 0.3, 7, out, small, sizeof small), FUGE_ERR_OPTION, small, "plane_s");
  CHECK_SAYS(fuge_combined_modulus(1.0, -1.0, out, message, sizeof message), FUGE_ERR_MODULUS, message, "e2 = -1.0");
  CHECK_STATUS(fuge_combined_modulus(INFINITY, INFINITY, out, message, sizeof message), FUGE_ERR_MODULUS);
  CHECK_CONTAINS(message, "both");
  CHECK_STATUS(fuge_displacement_shares(NAN, 1.0, out, out + 1, NULL, 0), FUGE_ERR_NOT_FINITE);
  CHECK_STATUS(fuge_plane_modulus(1.0, 0.3, FUGE_PLANE_STRAIN, NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_CONTAINS(message, "modulus is NULL");
  CHECK_STATUS(fuge_combined_modulus(1.0, 1.0, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_displacement_shares(1.0, 1.0, NULL, out, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_displacement_shares(1.0, 1.0, out, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(out, 2);
}

int main(void) {
  test_moduli();
  test_rigid_body();
  test_refusals();
  return check_summary();
}
