/* Section "effective modulus" of fuge_layers.h. */
#include "check.h"

static const double THICKNESS = 0.5, YOUNG[2] = {10.0, 1.0}, POISSON[2] = {0.3, 0.2};

/* From the half-space below to the top layer, with a rigid body and with another one. */
static void test_modulus(void) {
  const double radius[4] = {1e-11, 0.1, 1.0, 1e11};
  double modulus[5];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  fill(modulus, 5);
  CHECK_MESSAGE(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, HUGE_VAL, 4, radius, modulus, message,
                                     sizeof message), FUGE_DONE, message, "");
  CHECK_NEAR(modulus[0], 10.0 / 0.91, 1e-7);
  CHECK_NEAR(modulus[3], 1.0 / 0.96, 1e-7);
  CHECK(modulus[0] > modulus[1] && modulus[1] > modulus[2] && modulus[2] > modulus[3]);
  CHECK_UNTOUCHED(modulus + 4, 1);
  CHECK_DONE(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 4.0, 1, radius, modulus, NULL, 0));
  CHECK_NEAR(modulus[0], 1.0 / (0.091 + 0.25), 1e-8);
  CHECK_DONE(fuge_layered_modulus(0, NULL, YOUNG, POISSON, 1, HUGE_VAL, 1, radius + 2, modulus, NULL, 0));
  CHECK_NEAR(modulus[0], 10.0 / 0.91, 1e-13);
  CHECK_DONE(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, HUGE_VAL, 0, radius, modulus, NULL, 0));
}

/* At both limits the effective modulus differs by the share. */
static void test_limits(void) {
  const double alike[2] = {1.0, 1.0}, same[2] = {0.3, 0.3}, rigid[2] = {1.0, HUGE_VAL}, radius = 2.0, share = 0.01;
  double thin, thick, modulus;
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  CHECK_MESSAGE(fuge_coating_limits(YOUNG, POISSON, radius, share, &thin, &thick, message, sizeof message), FUGE_DONE,
                message, "");
  CHECK(thin > 0.0 && thin < thick);
  CHECK_DONE(fuge_layered_modulus(1, &thin, YOUNG, POISSON, 1, HUGE_VAL, 1, &radius, &modulus, NULL, 0));
  CHECK_NEAR(modulus * 0.96, 1.0 + share, 1e-6 * share);
  CHECK_DONE(fuge_layered_modulus(1, &thick, YOUNG, POISSON, 1, HUGE_VAL, 1, &radius, &modulus, NULL, 0));
  CHECK_NEAR(modulus * 0.091, 1.0 - share, 1e-6 * share);
  CHECK_DONE(fuge_coating_limits(YOUNG, POISSON, radius, share, &modulus, NULL, NULL, 0));
  CHECK_NEAR(modulus, thin, 0.0);
  CHECK_DONE(fuge_coating_limits(YOUNG, POISSON, radius, share, NULL, &modulus, NULL, 0));
  CHECK_NEAR(modulus, thick, 0.0);
  CHECK_DONE(fuge_coating_limits(alike, same, radius, share, &thin, &thick, NULL, 0));
  CHECK(thin == HUGE_VAL && thick == 0.0);
  CHECK_DONE(fuge_coating_limits(rigid, same, radius, share, &thin, &thick, NULL, 0));
  CHECK(thin == 0.0 && thick > radius);
}

static void check_limits_refused(int status, const char *part, const double *young, const double *poisson,
                                 double radius,
                                 double share) {
  double limits[2];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fill(limits, 2);
  CHECK_SAYS(fuge_coating_limits(young, poisson, radius, share, limits, limits + 1, message, sizeof message), status,
             message, part);
  CHECK_UNTOUCHED(limits, 2);
}

static void test_refusals(void) {
  const double radius[2] = {1.0, -1.0}, not_finite[2] = {NAN, 1.0}, rigid[2] = {HUGE_VAL, 1.0};
  double modulus[2];
  char message[FUGE_MESSAGE_LENGTH + 1];
  fill(modulus, 2);
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 1.0, 2, radius, modulus, message, sizeof message),
             FUGE_ERR_WIDTH, message, "radius(1) = -1.");
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 1.0, 2, not_finite, modulus, message,
                                  sizeof message),
             FUGE_ERR_NOT_FINITE, message, "radius(0) = NaN");
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 1.0, -1, radius, modulus, message, sizeof message),
             FUGE_ERR_SIZE, message, "radii = -1");
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 1.0, 1, NULL, modulus, message, sizeof message),
             FUGE_ERR_POINTER, message, "radius is NULL");
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 1.0, 1, radius, NULL, message, sizeof message),
             FUGE_ERR_POINTER, message, "modulus is NULL");
  CHECK_SAYS(fuge_layered_modulus(1, NULL, YOUNG, POISSON, 1, 1.0, 1, radius, modulus, message, sizeof message),
             FUGE_ERR_POINTER, message, "thickness is NULL");
  CHECK_SAYS(fuge_layered_modulus(1, &THICKNESS, YOUNG, POISSON, 1, 0.0, 1, radius, modulus, message, sizeof message),
             FUGE_ERR_MODULUS, message, "e_star_other");
  CHECK_UNTOUCHED(modulus, 2);
  check_limits_refused(FUGE_ERR_POINTER, "young is NULL", NULL, POISSON, 1.0, 0.1);
  check_limits_refused(FUGE_ERR_POINTER, "poisson is NULL", YOUNG, NULL, 1.0, 0.1);
  check_limits_refused(FUGE_ERR_MODULUS, "young 1", rigid, POISSON, 1.0, 0.1);
  check_limits_refused(FUGE_ERR_WIDTH, "radius = 0.", YOUNG, POISSON, 0.0, 0.1);
  check_limits_refused(FUGE_ERR_NOT_FINITE, "radius = Inf", YOUNG, POISSON, HUGE_VAL, 0.1);
  check_limits_refused(FUGE_ERR_OPTION, "share = 0.", YOUNG, POISSON, 1.0, 0.0);
  check_limits_refused(FUGE_ERR_NOT_FINITE, "share", YOUNG, POISSON, 1.0, NAN);
}

int main(void) {
  test_modulus();
  test_limits();
  test_refusals();
  return check_summary();
}
