/* Section "stresses of round bodies" of fuge_stress.h. */
#include "check.h"

enum { N = 2, POINTS = 3 };
static const double PI = 3.14159265358979324, YOUNG = 3.0, POISSON = 0.25;
static const double RADIUS[N + 1] = {0.0, 1.0, 2.0}, FORCE[N] = {1.0, 3.0};

/* Both rings together are a disc of radius 2 under the pressure 1/pi (Johnson, equation 3.33). */
static void test_disc(void) {
  const double r[POINTS] = {0.0, 0.5, 4.0}, z[POINTS] = {1.5, 0.0, 0.0};
  double stress[4 * POINTS + 1];
  fill(stress, 4 * POINTS + 1);
  CHECK_DONE(fuge_ring_stress(N, RADIUS, FORCE, POISSON, POINTS, r, z, stress, NULL, 0));
  CHECK_VALUES(stress, 1e-15, -(0.75 - 1.25 * 0.6 + 0.5 * 0.216) / PI, stress[0], -(1.0 - 0.216) / PI);
  CHECK_NEAR(stress[3], 0.0, 0.0);
  CHECK_NEAR(stress[4], -0.75 / PI, 1e-15);
  CHECK_NEAR(stress[6], -1.0 / PI, 1e-15);
  CHECK_NEAR(stress[8], 0.5 * 4.0 / (2.0 * PI * 16.0), 1e-16);
  CHECK_NEAR(stress[9], -stress[8], 1e-16);
  CHECK_NEAR(stress[10], 0.0, 0.0);
  CHECK_UNTOUCHED(stress + 4 * POINTS, 1);
}

static void test_disc_displacement(void) {
  const double r[POINTS] = {0.0, 0.7, 4.0}, z[POINTS] = {0.0, 0.0, 0.0};
  double u[2 * POINTS + 1], surface[POINTS];
  fill(u, 2 * POINTS + 1);
  CHECK_DONE(fuge_ring_interior_displacement(N, RADIUS, FORCE, YOUNG, POISSON, POINTS, r, z, u, NULL, 0));
  CHECK_DONE(fuge_ring_displacement(N, RADIUS, FORCE, YOUNG / (1.0 - POISSON * POISSON), POINTS, r, surface, NULL, 0));
  for (int k = 0; k < POINTS; k++) CHECK_NEAR(u[2 * k + 1], surface[k], 2e-15);
  CHECK_NEAR(u[0], 0.0, 0.0);
  CHECK_NEAR(u[4], -0.5 * 1.25 / (2.0 * PI * YOUNG) * 4.0 / 4.0, 1e-16);
  CHECK_UNTOUCHED(u + 2 * POINTS, 1);
}

/* r^2/2, pressed to a contact of radius 1, or r, a cone. */
static fuge_round *solved(double power, double radius) {
  const double coefficient = 1.0 / power;
  fuge_round *contact = NULL;
  CHECK_DONE(fuge_solve_round_powers(1, &coefficient, &power, NULL, 5.0, 1.0, NULL, NULL, &radius, &contact, NULL, 0));
  return contact;
}

/* On the axis zz = -p0/(1 + z^2); at the surface -p and, beside the contact, the approach less the height. */
static void test_sphere(void) {
  fuge_round *contact = solved(2.0, 1.0);
  const double r[POINTS] = {0.0, 0.6, 0.0}, z[POINTS] = {0.5, 0.0, 0.0}, p0 = 2.0 / PI;
  double stress[4 * POINTS + 1], u[2 * POINTS + 1];
  fill(stress, 4 * POINTS + 1);
  fill(u, 2 * POINTS + 1);
  CHECK_DONE(fuge_round_stress(contact, POISSON, POINTS, r, z, stress, NULL, 0));
  CHECK_NEAR(stress[2], -p0 / 1.25, 5e-15);
  CHECK_NEAR(stress[0], -p0 * (1.25 * (1.0 - 0.5 * atan(2.0)) - 0.5 / 1.25), 5e-15);
  CHECK_NEAR(stress[1], stress[0], 1e-15);
  CHECK_NEAR(stress[6], -0.8 * p0, 5e-15);
  CHECK_NEAR(stress[8], -0.75 * p0, 5e-15);
  CHECK_UNTOUCHED(stress + 4 * POINTS, 1);
  CHECK_DONE(fuge_round_displacement(contact, 1.0 - POISSON * POISSON, POISSON, POINTS, r, z, u, NULL, 0));
  CHECK_NEAR(u[3], 1.0 - 0.18, 5e-15);
  CHECK_NEAR(u[5], 1.0, 5e-15);
  CHECK_UNTOUCHED(u + 2 * POINTS, 1);
  fuge_round_free(&contact);
}

static void test_cone_and_no_load(void) {
  fuge_round *contact = solved(1.0, 1.0);
  const double zero = 0.0;
  double stress[4];
  CHECK_DONE(fuge_round_stress(contact, 0.5, 1, &zero, &zero, stress, NULL, 0));
  CHECK(stress[0] < -1e308 && stress[1] < -1e308 && stress[2] < -1e308 && stress[3] == 0.0);
  fuge_round_free(&contact);
  contact = solved(2.0, 0.0);
  CHECK_DONE(fuge_round_stress(contact, POISSON, 1, &zero, &zero, stress, NULL, 0));
  for (int k = 0; k < 4; k++) CHECK_NEAR(stress[k], 0.0, 0.0);
  CHECK_DONE(fuge_round_stress(contact, POISSON, 0, &zero, &zero, stress, NULL, 0));
  fuge_round_free(&contact);
}

static void check_ring_refusal(int n, const double *radius, const double *force, int points, const double *r,
                               const double *z, int status, const char *part) {
  double result[4];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  fill(result, 4);
  CHECK_STATUS(fuge_ring_stress(n, radius, force, POISSON, points, r, z, result, message, sizeof message), status);
  CHECK_CONTAINS(message, part);
  CHECK_SAYS(fuge_ring_interior_displacement(n, radius, force, YOUNG, POISSON, points, r, z, result, message,
                                             sizeof message), status, message, part);
  CHECK_UNTOUCHED(result, 4);
}

static void check_round_refusal(const fuge_round *contact, int points, const double *r, const double *z, int status,
                                const char *part) {
  double result[4];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  fill(result, 4);
  CHECK_SAYS(fuge_round_stress(contact, POISSON, points, r, z, result, message, sizeof message), status, message, part);
  CHECK_STATUS(fuge_round_displacement(contact, YOUNG, POISSON, points, r, z, result, message, sizeof message), status);
  CHECK_CONTAINS(message, part);
  CHECK_UNTOUCHED(result, 4);
}

static void test_refusals(void) {
  fuge_round *contact = solved(2.0, 1.0);
  const double x = 0.5, below = -0.5;
  double result[4];
  check_ring_refusal(0, RADIUS, FORCE, 1, &x, &x, FUGE_ERR_SIZE, "n = 0");
  check_ring_refusal(N, NULL, FORCE, 1, &x, &x, FUGE_ERR_POINTER, "radius is NULL");
  check_ring_refusal(N, RADIUS, NULL, 1, &x, &x, FUGE_ERR_POINTER, "force is NULL");
  check_ring_refusal(N, RADIUS, FORCE, -1, &x, &x, FUGE_ERR_SIZE, "points = -1");
  check_ring_refusal(N, RADIUS, FORCE, 1, NULL, &x, FUGE_ERR_POINTER, "pr is NULL");
  check_ring_refusal(N, RADIUS, FORCE, 1, &x, NULL, FUGE_ERR_POINTER, "pz is NULL");
  check_ring_refusal(N, RADIUS, FORCE, 1, &x, &below, FUGE_ERR_GRID, "pz(0) = -0.5");
  check_ring_refusal(N, RADIUS, FORCE, 1, &below, &x, FUGE_ERR_WIDTH, "pr(0) = -0.5");
  check_round_refusal(NULL, 1, &x, &x, FUGE_ERR_POINTER, "contact is NULL");
  check_round_refusal(contact, 1, NULL, &x, FUGE_ERR_POINTER, "pr is NULL");
  check_round_refusal(contact, 1, &x, &below, FUGE_ERR_GRID, "pz(0) = -0.5");
  fill(result, 4);
  CHECK_STATUS(fuge_ring_stress(N, RADIUS, FORCE, POISSON, 1, &x, &x, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_ring_stress(N, RADIUS, FORCE, -1.0, 1, &x, &x, result, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_round_stress(contact, 0.6, 1, &x, &x, result, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_round_displacement(contact, -YOUNG, POISSON, 1, &x, &x, result, NULL, 0), FUGE_ERR_MODULUS);
  CHECK_STATUS(fuge_round_displacement(contact, YOUNG, POISSON, 1, &x, &x, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(result, 4);
  fuge_round_free(&contact);
}

int main(void) {
  test_disc();
  test_disc_displacement();
  test_sphere();
  test_cone_and_no_load();
  test_refusals();
  return check_summary();
}
