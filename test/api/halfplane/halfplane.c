/* Section "half-plane" of fuge_halfplane.h. */
#include "check.h"

enum { N = 5, LDA = 7 };
static const double H = 0.25, E_STAR = 3.0, TOLERANCE = 1e-14;
static const double X[N] = {0.125, 0.375, 0.625, 0.875, 1.125};
static const double EQUAL[N] = {0.25, 0.25, 0.25, 0.25, 0.25};
/* Cells of different widths, side by side from x = 0. */
static const double UNEQUAL_X[N] = {0.125, 0.375, 0.75, 1.5, 2.25};
static const double UNEQUAL[N] = {0.25, 0.25, 0.5, 1.0, 0.5};

/* Integral and double integral of ln|x|. */
static double log_integral(double x) { return x == 0.0 ? 0.0 : x * log(fabs(x)) - x; }
static double log_integral2(double x) { return x == 0.0 ? 0.0 : x * x * (0.5 * log(fabs(x)) - 0.75); }

/* Displacement at distance d per force on a cell of width h, log datum `datum`. */
static double at_centre(double d, double h, double datum) {
  double mean = (log_integral(d + 0.5 * h) - log_integral(d - 0.5 * h)) / h;
  return -2.0 / (acos(-1.0) * E_STAR) * (mean - log(datum));
}

/* The same, mean over a cell of the same width. */
static double mean_of_cell(double d, double h, double datum) {
  double mean = (log_integral2(d + h) - 2.0 * log_integral2(d) + log_integral2(d - h)) / (h * h);
  return -2.0 / (acos(-1.0) * E_STAR) * (mean - log(datum));
}

static void test_coefficients(int element, double (*expected)(double, double, double)) {
  double alpha[N * N];
  CHECK_DONE(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, element, 0, alpha, N, NULL, 0));
  for (int i = 0; i < N; i++)
    for (int k = 0; k < N; k++) {
      CHECK_NEAR(alpha[i + k * N], expected(X[i] - X[k], H, 2.0 * N * H), TOLERANCE);
      CHECK(alpha[i + k * N] > 0.0);
    }
}

/* (2/pi)(1 + 2 ln 2)/E*, by hand. */
static void test_one_cell(void) {
  const double x = 7.0, width = 1.0;
  double alpha;
  CHECK_DONE(fuge_halfplane_matrix(1, &x, &width, E_STAR, FUGE_CENTRE, 0, &alpha, 1, NULL, 0));
  CHECK_NEAR(alpha, 2.0 / acos(-1.0) * (1.0 + 2.0 * log(2.0)) / E_STAR, TOLERANCE);
}

/* The same cell, so narrow that its edges round to one number. */
static void test_narrow_cell_far_away(void) {
  const double x = 1e9, width = 1e-9;
  double alpha;
  CHECK_DONE(fuge_halfplane_matrix(1, &x, &width, E_STAR, FUGE_CENTRE, 0, &alpha, 1, NULL, 0));
  CHECK_NEAR(alpha, 2.0 / acos(-1.0) * (1.0 + 2.0 * log(2.0)) / E_STAR, TOLERANCE);
}

static void test_unequal_cells_are_symmetric(void) {
  for (int folded = 0; folded < 2; folded++) {
    double alpha[N * N];
    CHECK_DONE(fuge_halfplane_matrix(N, UNEQUAL_X, UNEQUAL, E_STAR, FUGE_MEAN, folded, alpha, N, NULL, 0));
    for (int i = 0; i < N; i++)
      for (int k = 0; k < i; k++) CHECK_NEAR(alpha[i + k * N], alpha[k + i * N], 0.0);
  }
}

/* Half a force on a cell and half on its mirror image. */
static void test_folding(void) {
  double x[2 * N], width[2 * N], whole[4 * N * N], folded[N * N];
  for (int k = 0; k < N; k++) {
    x[N - 1 - k] = -UNEQUAL_X[k];
    x[N + k] = UNEQUAL_X[k];
    width[N - 1 - k] = width[N + k] = UNEQUAL[k];
  }
  CHECK_DONE(fuge_halfplane_matrix(2 * N, x, width, E_STAR, FUGE_MEAN, 0, whole, 2 * N, NULL, 0));
  CHECK_DONE(fuge_halfplane_matrix(N, UNEQUAL_X, UNEQUAL, E_STAR, FUGE_MEAN, 1, folded, N, NULL, 0));
  for (int i = 0; i < N; i++)
    for (int k = 0; k < N; k++) {
      double cell = whole[N + i + (N + k) * 2 * N], image = whole[N + i + (N - 1 - k) * 2 * N];
      CHECK_NEAR(folded[i + k * N], 0.5 * (cell + image), TOLERANCE);
    }
}

/* A cell on the axis is its own mirror image. */
static void test_cell_on_axis(void) {
  const double x[2] = {0.0, 0.5}, width[2] = {0.5, 0.5};
  double alpha[4];
  CHECK_DONE(fuge_halfplane_matrix(2, x, width, E_STAR, FUGE_CENTRE, 1, alpha, 2, NULL, 0));
  CHECK_VALUES(alpha, TOLERANCE, at_centre(0.0, 0.5, 3.0), at_centre(0.5, 0.5, 3.0));
  CHECK_NEAR(alpha[3], 0.5 * (at_centre(0.0, 0.5, 3.0) + at_centre(1.0, 0.5, 3.0)), TOLERANCE);
}

/* Rows beyond n are never written. */
static void test_padding(void) {
  for (int folded = 0; folded < 2; folded++) {
    double tight[N * N], wide[LDA * N];
    fill(wide, LDA * N);
    CHECK_DONE(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, FUGE_HAT, folded, tight, N, NULL, 0));
    CHECK_DONE(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, FUGE_HAT, folded, wide, LDA, NULL, 0));
    for (int k = 0; k < N; k++) {
      for (int i = 0; i < N; i++) CHECK_NEAR(wide[i + k * LDA], tight[i + k * N], 0.0);
      CHECK_UNTOUCHED(&wide[N + k * LDA], LDA - N);
    }
  }
}

/* One value of good input made bad; `folded` says for which model: 0, 1 or both (2). */
typedef struct bad_input {
  int n;
  int at;                /* index that gets `x` and `width` */
  double x, width, e_star;
  int element, folded, status;
  const char *part;
} bad_input;

static const bad_input BAD_INPUT[] = {
  {0, 0, 0.125, 0.25, 3, FUGE_MEAN, 2, FUGE_ERR_SIZE, "n = 0"},
  {-2, 0, 0.125, 0.25, 3, FUGE_MEAN, 2, FUGE_ERR_SIZE, "n = -2"},
  {N, 2, NAN, 0.25, 3, FUGE_MEAN, 2, FUGE_ERR_NOT_FINITE, "x(2)"},
  {N, 4, 1.125, INFINITY, 3, FUGE_MEAN, 2, FUGE_ERR_NOT_FINITE, "width(4)"},
  {N, 0, 0.125, 0.25, NAN, FUGE_MEAN, 2, FUGE_ERR_NOT_FINITE, "e_star"},
  {N, 1, 0.375, 0.0, 3, FUGE_MEAN, 2, FUGE_ERR_WIDTH, "width(1) = 0"},
  {N, 1, 0.375, -0.5, 3, FUGE_CENTRE, 2, FUGE_ERR_WIDTH, "-0.5"},
  {N, 0, -0.125, 0.25, 3, FUGE_MEAN, 1, FUGE_ERR_WIDTH, "x(0) = -0.125"},
  {N, 0, -0.125, 0.25, 3, FUGE_MEAN, 0, FUGE_DONE, ""},
  {N, 0, 0.125, 0.25, 0, FUGE_MEAN, 2, FUGE_ERR_MODULUS, "e_star = 0"},
  {N, 0, 0.125, 0.25, -2, FUGE_MEAN, 2, FUGE_ERR_MODULUS, "-2.0"},
  {N, 0, 0.125, 0.25, 3, FUGE_HAT + 1, 2, FUGE_ERR_ELEMENT, "element = 3"},
  {N, 0, 0.125, 0.25, 3, -1, 2, FUGE_ERR_ELEMENT, "element = -1"},
  {N, 3, 0.875, 0.5, 3, FUGE_CENTRE, 2, FUGE_ERR_GRID, "width(3) = 0.5"},
  {N, 3, 0.875, 0.5, 3, FUGE_HAT, 2, FUGE_ERR_GRID, "FUGE_MEAN"},
  {N, 3, 0.875, 0.125, 3, FUGE_MEAN, 2, FUGE_DONE, ""},
  {N, 3, 0.875, 0.5, 3, FUGE_MEAN, 2, FUGE_ERR_WIDTH, "cells 2 and 3"},
  {N, 4, 0.375, 0.25, 3, FUGE_CENTRE, 2, FUGE_ERR_WIDTH, "cells 1 and 4"},
  {N, 4, 0.375, 0.25, 3, FUGE_HAT, 2, FUGE_ERR_WIDTH, "cells 1 and 4"},
  {N, 0, 0.0625, 0.25, 3, FUGE_MEAN, 1, FUGE_ERR_WIDTH, "cell 0"},
  {N, 0, 0.125, 0.25, 1e-200, FUGE_MEAN, 2, FUGE_ERR_OVERFLOW, "units"},
  {N, 0, 0.125, 0.25, 1e200, FUGE_MEAN, 2, FUGE_ERR_OVERFLOW, "units"},
  {N, 4, 1e200, 0.25, 3, FUGE_MEAN, 2, FUGE_ERR_OVERFLOW, "cell 4"}
};

/* The message says what and where. */
static void check_bad_input(const bad_input *bad, int folded) {
  double x[N], width[N], alpha[N * N];
  char message[FUGE_MESSAGE_LENGTH + 1] = "not written";
  memcpy(x, X, sizeof x);
  memcpy(width, EQUAL, sizeof width);
  x[bad->at] = bad->x;
  width[bad->at] = bad->width;
  fill(alpha, N * N);
  CHECK_STATUS(fuge_halfplane_matrix(bad->n, x, width, bad->e_star, bad->element, folded, alpha, bad->n, message,
                                     sizeof message), bad->status);
  if (bad->status < 0) CHECK_UNTOUCHED(alpha, N * N);
  if (bad->status < 0) CHECK_CONTAINS(message, bad->part);
  else CHECK_STRING(message, "");
}

static void test_bad_input(void) {
  for (size_t k = 0; k < sizeof BAD_INPUT / sizeof BAD_INPUT[0]; k++)
    for (int folded = 0; folded < 2; folded++)
      if (BAD_INPUT[k].folded == folded || BAD_INPUT[k].folded == 2) check_bad_input(&BAD_INPUT[k], folded);
}

static void test_leading_dimension(void) {
  for (int folded = 0; folded < 2; folded++) {
    double alpha[N * N];
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    fill(alpha, N * N);
    CHECK_SAYS(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, FUGE_MEAN, folded, alpha, N - 1, message, sizeof message),
               FUGE_ERR_SIZE, message, "lda = 4");
    CHECK_STATUS(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, FUGE_MEAN, folded, alpha, -N, NULL, 0), FUGE_ERR_SIZE);
    CHECK_UNTOUCHED(alpha, N * N);
  }
}

static void test_null_pointers(void) {
  for (int folded = 0; folded < 2; folded++) {
    double alpha[N * N];
    char message[FUGE_MESSAGE_LENGTH + 1] = "";
    fill(alpha, N * N);
    CHECK_MESSAGE(fuge_halfplane_matrix(N, NULL, EQUAL, E_STAR, FUGE_MEAN, folded, alpha, N, message, sizeof message),
                  FUGE_ERR_POINTER, message, "x is NULL");
    CHECK_MESSAGE(fuge_halfplane_matrix(N, X, NULL, E_STAR, FUGE_MEAN, folded, alpha, N, message, sizeof message),
                  FUGE_ERR_POINTER, message, "width is NULL");
    CHECK_MESSAGE(fuge_halfplane_matrix(N, X, EQUAL, E_STAR, FUGE_MEAN, folded, NULL, N, message, sizeof message),
                  FUGE_ERR_POINTER, message, "alpha is NULL");
    CHECK_UNTOUCHED(alpha, N * N);
  }
}

/* The bytes before and beyond stay as they are. */
static void test_message_is_cut(void) {
  char store[9] = "########", *buffer = store + 1;
  CHECK_STATUS(fuge_halfplane_matrix(0, X, EQUAL, E_STAR, FUGE_MEAN, 0, NULL, 0, buffer, 0), FUGE_ERR_SIZE);
  CHECK_STRING(buffer, "#######");
  CHECK_STATUS(fuge_halfplane_matrix(0, X, EQUAL, E_STAR, FUGE_MEAN, 0, NULL, 0, buffer, 5), FUGE_ERR_SIZE);
  CHECK_STRING(buffer, "n = ");
  CHECK_STRING(buffer + 5, "##");
  CHECK_STATUS(fuge_halfplane_matrix(0, X, EQUAL, E_STAR, FUGE_MEAN, 0, NULL, 0, buffer, 1), FUGE_ERR_SIZE);
  CHECK_STRING(buffer, "");
  CHECK(store[0] == '#');
}

/* Edge on the left with a cell beyond, corner on the right: widths by hand, 1/16 of I_t(2, 4) and so on. */
static void test_graded_cells(void) {
  double x[5], width[5];
  /* I_t(2, 4) at t = 1/4, 1/2, 3/4: 376/1024, 832/1024, 1008/1024. */
  const double at[6] = {-376, 0, 376, 832, 1008, 1024};
  CHECK_DONE(fuge_graded_cells(1.0, 3.0, FUGE_END_EDGE, FUGE_END_CORNER, 1, 0, 5, x, width, NULL, 0));
  for (int k = 0; k < 5; k++) {
    CHECK_NEAR(x[k], 1.0 + (at[k] + at[k + 1]) / 1024.0, TOLERANCE);
    CHECK_NEAR(width[k], 2.0 * (at[k + 1] - at[k]) / 1024.0, TOLERANCE);
  }
  CHECK_DONE(fuge_graded_cells(-1.0, 1.0, FUGE_END_PLAIN, FUGE_END_PLAIN, 0, 0, 1, x, width, NULL, 0));
  CHECK_NEAR(x[0], 0.0, 0.0);
  CHECK_NEAR(width[0], 2.0, 0.0);
}

static void check_bad_cells(int n, int kind, int beyond, double right, double *x, double *width, int status,
                            const char *part) {
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  CHECK_SAYS(fuge_graded_cells(1.0, right, FUGE_END_EDGE, kind, 0, beyond, n, x, width, message, sizeof message),
             status, message, part);
}

static void test_bad_graded_cells(void) {
  double x[N], width[N];
  fill(x, N);
  fill(width, N);
  check_bad_cells(0, FUGE_END_EDGE, 0, 3.0, x, width, FUGE_ERR_SIZE, "n = 0");
  check_bad_cells(-7, FUGE_END_EDGE, 0, 3.0, x, width, FUGE_ERR_SIZE, "n = -7");
  check_bad_cells(N, FUGE_END_EDGE, N, 3.0, x, width, FUGE_ERR_SIZE, "at least one cell");
  check_bad_cells(N, 3, 0, 3.0, x, width, FUGE_ERR_OPTION, "kind 3");
  check_bad_cells(N, FUGE_END_EDGE, 0, NAN, x, width, FUGE_ERR_NOT_FINITE, "right");
  check_bad_cells(N, FUGE_END_EDGE, 0, 1.0, x, width, FUGE_ERR_WIDTH, "left has to be less");
  check_bad_cells(N, FUGE_END_EDGE, 0, 3.0, NULL, width, FUGE_ERR_POINTER, "x is NULL");
  check_bad_cells(N, FUGE_END_EDGE, 0, 3.0, x, NULL, FUGE_ERR_POINTER, "width is NULL");
  CHECK_UNTOUCHED(x, N);
  CHECK_UNTOUCHED(width, N);
}

int main(void) {
  test_coefficients(FUGE_CENTRE, at_centre);
  test_coefficients(FUGE_MEAN, mean_of_cell);
  /* A hat is the mean of a uniform cell: the same number on equal cells. */
  test_coefficients(FUGE_HAT, mean_of_cell);
  test_one_cell();
  test_narrow_cell_far_away();
  test_unequal_cells_are_symmetric();
  test_folding();
  test_cell_on_axis();
  test_padding();
  test_bad_input();
  test_leading_dimension();
  test_null_pointers();
  test_message_is_cut();
  test_graded_cells();
  test_bad_graded_cells();
  return check_summary();
}
