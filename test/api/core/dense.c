/* Section "one call" of fuge_core.h: fuge_solve_dense. */
#include "table1.h"

enum { MOST = 3 };

static void test_table1(void) {
  double force[2], gap[2], approach;
  char message[16] = "not yet written";
  CHECK_MESSAGE(fuge_solve_dense(2, TABLE1_ALPHA, 2, TABLE1_GAP, TABLE1_LOAD, force, gap, &approach, message,
                                 sizeof message), FUGE_DONE, message, "");
  check_table1(force, gap, approach);
}

/* Rows beyond n are never read. */
static void test_padding(void) {
  const double alpha[8] = {0.2, 0.1, NAN, NAN, 0.1, 0.2, NAN, NAN};
  double force[2], gap[2], approach;
  CHECK_DONE(fuge_solve_dense(2, alpha, 4, TABLE1_GAP, TABLE1_LOAD, force, gap, &approach, NULL, 0));
  check_table1(force, gap, approach);
}

static void test_in_place(void) {
  double force[2], gap[2] = {0.0, 1.0}, approach;
  CHECK_DONE(fuge_solve_dense(2, TABLE1_ALPHA, 2, gap, TABLE1_LOAD, force, gap, &approach, NULL, 0));
  check_table1(force, gap, approach);

  double shared[2] = {0.0, 1.0};
  CHECK_DONE(fuge_solve_dense(2, TABLE1_ALPHA, 2, shared, TABLE1_LOAD, shared, gap, &approach, NULL, 0));
  check_table1(shared, gap, approach);
}

/* Data that are refused: what by, and what the message has to name. */
typedef struct bad_data {
  int n, lda;
  double alpha[MOST * MOST], gap[MOST], load;
  int status;
  const char *part;
} bad_data;

static const bad_data BAD_DATA[] = {
  {0, 2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, 2, FUGE_ERR_SIZE, "n = 0"},
  {-7, 2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, 2, FUGE_ERR_SIZE, "n = -7"},
  {2, 1, {0.2, 0.1, 0.1, 0.2}, {0, 1}, 2, FUGE_ERR_SIZE, "lda = 1"},
  {2, -2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, 2, FUGE_ERR_SIZE, "lda = -2"},
  {2, 2, {0.2, NAN, 0.1, 0.2}, {0, 1}, 2, FUGE_ERR_NOT_FINITE, "alpha(1,0)"},
  {2, 2, {0.2, 0.1, 0.1, INFINITY}, {0, 1}, 2, FUGE_ERR_NOT_FINITE, "alpha(1,1)"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {0, NAN}, 2, FUGE_ERR_NOT_FINITE, "gap(1)"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {-INFINITY, 1}, 2, FUGE_ERR_NOT_FINITE, "gap(0)"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, NAN, FUGE_ERR_NOT_FINITE, "load"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, INFINITY, FUGE_ERR_NOT_FINITE, "load"},
  {3, 3, {1, 0, 0, 0, 1, 0.25, 0, 0.5, 1}, {0, 0, 0}, 2, FUGE_ERR_NOT_SYMMETRIC, "alpha(2,1)"},
  {3, 3, {1, 0, 0, 0, 1, 0.25, 0, 0.5, 1}, {0, 0, 0}, 2, FUGE_ERR_NOT_SYMMETRIC, "0.25"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {0, 1}, -3, FUGE_ERR_NO_EQUILIBRIUM, "-3.0"}
};

/* Data that only a factorisation or the scales of a solve show to be bad. */
static const bad_data BAD_FOR_SOLVE[] = {
  {2, 2, {1, 2, 2, 1}, {0, 1}, 2, FUGE_ERR_NOT_DEFINITE, "points 0 and 1"},
  {2, 2, {2e300, 1e300, 1e300, 2e300}, {0, 1}, 1e30, FUGE_ERR_OVERFLOW, "units"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {-1e308, 1e308}, 2, FUGE_ERR_OVERFLOW, "units"},
  {2, 2, {0.2, 0.1, 0.1, 0.2}, {-1.7e308, 1.7e308}, 0, FUGE_ERR_OVERFLOW, "units"}
};

static void check_refused(const bad_data *bad) {
  double force[MOST], gap[MOST], approach = SENTINEL;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  fill(force, MOST);
  fill(gap, MOST);
  CHECK_SAYS(fuge_solve_dense(bad->n, bad->alpha, bad->lda, bad->gap, bad->load, force, gap, &approach, message,
                              sizeof message), bad->status, message, bad->part);
  CHECK_UNTOUCHED(force, MOST);
  CHECK_UNTOUCHED(gap, MOST);
  CHECK_UNTOUCHED(&approach, 1);
}

static void test_bad_data(void) {
  for (size_t k = 0; k < sizeof BAD_DATA / sizeof BAD_DATA[0]; k++) {
    check_refused(&BAD_DATA[k]);
  }
}

/* A repeated point: the forces there are not unique, all else is. */
static void test_repeated_point(void) {
  const double alpha[9] = {2, 1, 1, 1, 2, 2, 1, 2, 2}, zero[3] = {0, 0, 0};
  double force[3], gap[3], approach;
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_SAYS(fuge_solve_dense(3, alpha, 3, zero, 2.0, force, gap, &approach, message, sizeof message),
             FUGE_WARN_NOT_UNIQUE, message, "singular on the contact");
  CHECK_NEAR(force[0], 1.0, 2.0 * EXACT);
  CHECK_NEAR(force[1] + force[2], 1.0, 2.0 * EXACT);
  CHECK_NEAR(approach, 3.0, 4.0 * EXACT);
}

static void test_bad_for_solve(void) {
  for (size_t k = 0; k < sizeof BAD_FOR_SOLVE / sizeof BAD_FOR_SOLVE[0]; k++) {
    check_refused(&BAD_FOR_SOLVE[k]);
  }
}

/* In place, an error must leave the gaps that are also an output. */
static void test_error_in_place(void) {
  double force[2], gap[2] = {0.0, NAN}, approach = SENTINEL;
  fill(force, 2);
  CHECK_STATUS(fuge_solve_dense(2, TABLE1_ALPHA, 2, gap, TABLE1_LOAD, force, gap, &approach, NULL, 0),
               FUGE_ERR_NOT_FINITE);
  CHECK_NEAR(gap[0], 0.0, 0.0);
  CHECK(isnan(gap[1]));
}

/* One NULL at a time; `null` counts the pointers of fuge_solve_dense. */
static int solve_with_null(int null, double *force, double *gap, double *approach, char *message, size_t len) {
  return fuge_solve_dense(2, null == 0 ? NULL : TABLE1_ALPHA, 2, null == 1 ? NULL : TABLE1_GAP, TABLE1_LOAD,
                          null == 2 ? NULL : force, null == 3 ? NULL : gap, null == 4 ? NULL : approach, message, len);
}

static void test_null_pointers(void) {
  const char *const names[5] = {"alpha is NULL", "gap is NULL", "force is NULL", "gap_out is NULL", "approach is NULL"};
  double force[2], gap[2], approach = SENTINEL;
  fill(force, 2);
  fill(gap, 2);
  for (int null = 0; null < 5; null++) {
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    CHECK_STATUS(solve_with_null(null, force, gap, &approach, message, sizeof message), FUGE_ERR_POINTER);
    CHECK_STRING(message, names[null]);
    CHECK_STATUS(solve_with_null(null, force, gap, &approach, NULL, 100), FUGE_ERR_POINTER);
    CHECK_UNTOUCHED(force, 2);
    CHECK_UNTOUCHED(gap, 2);
    CHECK_UNTOUCHED(&approach, 1);
  }
}

static int solve_for_message(char *message, size_t len) {
  double force[2], gap[2], approach;
  return fuge_solve_dense(2, TABLE1_ALPHA, 2, TABLE1_GAP, -1.0, force, gap, &approach, message, len);
}

/* The bytes before and beyond stay as they are. */
static void test_message_is_cut(void) {
  char whole[256], store[9] = "########", *buffer = store + 1;
  solve_for_message(whole, sizeof whole);
  CHECK_MESSAGE(solve_for_message(buffer, 0), FUGE_ERR_NO_EQUILIBRIUM, buffer, "#######");
  CHECK_STATUS(solve_for_message(buffer, 5), FUGE_ERR_NO_EQUILIBRIUM);
  CHECK_INT(strlen(buffer), 4);
  CHECK(strncmp(buffer, whole, 4) == 0);
  CHECK_STRING(buffer + 5, "##");
  CHECK_MESSAGE(solve_for_message(buffer, 1), FUGE_ERR_NO_EQUILIBRIUM, buffer, "");
  CHECK(store[0] == '#');
}

int main(void) {
  test_table1();
  test_padding();
  test_in_place();
  test_bad_data();
  test_repeated_point();
  test_bad_for_solve();
  test_error_in_place();
  test_null_pointers();
  test_message_is_cut();
  return check_summary();
}
