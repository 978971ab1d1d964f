/* Checks for the C tests: each counts, and prints file, line and both values when it
 * fails.  A program ends with `return check_summary();`, which is non-zero after a
 * failure or when nothing was checked. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdio.h>
#include <string.h>
#include "fuge.h"

static int checks_made, checks_failed;

/* In arrays that a failing call must leave alone. */
static const double SENTINEL = -12345.75;
/* A change of one load by its unit. */
static const double ONE = 1.0;

#define CHECK(condition) check_true(__FILE__, __LINE__, #condition, (condition))
#define CHECK_INT(actual, expected) check_int(__FILE__, __LINE__, #actual, (actual), (expected))
#define CHECK_NEAR(actual, expected, tolerance) \
  check_near(__FILE__, __LINE__, #actual, (actual), (expected), (tolerance))
/* The first values of an array, each within `tolerance`. */
#define CHECK_VALUES(array, tolerance, ...) \
  check_values(__FILE__, __LINE__, #array, (array), (const double[]){__VA_ARGS__}, \
               (int)(sizeof((const double[]){__VA_ARGS__}) / sizeof(double)), (tolerance))
#define CHECK_STRING(actual, expected) check_string(__FILE__, __LINE__, #actual, (actual), (expected))
#define CHECK_CONTAINS(text, part) check_contains(__FILE__, __LINE__, #text, (text), (part))
#define CHECK_DONE(call) check_status(__FILE__, __LINE__, #call, (call), FUGE_DONE)
#define CHECK_STATUS(call, expected) check_status(__FILE__, __LINE__, #call, (call), (expected))
/* Status and message of one call: a part of the message, or all of it. */
#define CHECK_SAYS(call, expected, message, part) \
  do { \
    check_status(__FILE__, __LINE__, #call, (call), (expected)); \
    CHECK_CONTAINS(message, part); \
  } while (0)
#define CHECK_MESSAGE(call, expected, message, whole) \
  do { \
    check_status(__FILE__, __LINE__, #call, (call), (expected)); \
    CHECK_STRING(message, whole); \
  } while (0)
#define CHECK_UNTOUCHED(array, n) check_untouched(__FILE__, __LINE__, #array, (array), (n))

static inline int check_count(const char *file, int line, int passed) {
  checks_made++;
  if (passed) return 1;
  checks_failed++;
  printf("%s:%d: ", file, line);
  return 0;
}

static inline void check_true(const char *file, int line, const char *what, int passed) {
  if (!check_count(file, line, passed)) printf("not true: %s\n", what);
}

static inline void check_int(const char *file, int line, const char *what, long actual, long expected) {
  if (!check_count(file, line, actual == expected)) printf("%s is %ld, expected %ld\n", what, actual, expected);
}

/* Written so that NaN fails. */
static inline void check_near(const char *file, int line, const char *what, double actual, double expected,
                              double tolerance) {
  if (!check_count(file, line, fabs(actual - expected) <= tolerance))
    printf("%s is %.17g, expected %.17g within %g\n", what, actual, expected, tolerance);
}

static inline void check_values(const char *file, int line, const char *what, const double *actual,
                                const double *expected, int n, double tolerance) {
  for (int k = 0; k < n; k++)
    if (!check_count(file, line, fabs(actual[k] - expected[k]) <= tolerance))
      printf("%s[%d] is %.17g, expected %.17g within %g\n", what, k, actual[k], expected[k], tolerance);
}

static inline void check_string(const char *file, int line, const char *what, const char *actual,
                                const char *expected) {
  if (!check_count(file, line, strcmp(actual, expected) == 0))
    printf("%s is \"%s\", expected \"%s\"\n", what, actual, expected);
}

static inline void check_contains(const char *file, int line, const char *what, const char *text,
                                  const char *part) {
  if (!check_count(file, line, strstr(text, part) != NULL))
    printf("%s is \"%s\", which does not contain \"%s\"\n", what, text, part);
}

static inline void check_status(const char *file, int line, const char *what, int actual, int expected) {
  if (!check_count(file, line, actual == expected))
    printf("%s\n  gives %d (%s), expected %d (%s)\n", what, actual, fuge_status_text(actual), expected,
           fuge_status_text(expected));
}

static inline void check_untouched(const char *file, int line, const char *what, const double *array, int n) {
  int touched = 0;
  for (int k = n - 1; k >= 0; k--)
    if (memcmp(&array[k], &SENTINEL, sizeof SENTINEL) != 0) touched = k + 1;
  if (!check_count(file, line, touched == 0))
    printf("%s[%d] is %.17g, should be untouched\n", what, touched - 1, array[touched - 1]);
}

/* Prepare an array for CHECK_UNTOUCHED. */
static inline void fill(double *array, int n) {
  for (int k = 0; k < n; k++) array[k] = SENTINEL;
}

static inline int check_summary(void) {
  printf("%d checks, %d failed\n", checks_made, checks_failed);
  return checks_failed > 0 || checks_made == 0;
}

#endif
