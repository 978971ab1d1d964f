/* Section "status" and "options and report" of fuge_core.h. */
#include <limits.h>
#include "check.h"

static void test_version(void) {
  CHECK_STRING(fuge_version(), FUGE_VERSION);
  CHECK(fuge_version() == fuge_version());
}

static void test_status_texts(void) {
  const char *unknown = fuge_status_text(FUGE_WARN_ACCURACY + 1);
  for (int status = FUGE_ERR_LAW; status <= FUGE_WARN_ACCURACY; status++) {
    const char *meaning = fuge_status_text(status);
    CHECK(meaning != NULL && strlen(meaning) > 0);
    CHECK(strcmp(meaning, unknown) != 0);
    CHECK(meaning[strlen(meaning) - 1] != ' ');
    for (int other = FUGE_ERR_LAW; other < status; other++)
      CHECK(strcmp(meaning, fuge_status_text(other)) != 0);
  }
  CHECK_STRING(fuge_status_text(FUGE_DONE), "done");
  CHECK_CONTAINS(fuge_status_text(FUGE_WARN_RESIDUAL), "residual");
  CHECK_CONTAINS(fuge_status_text(FUGE_WARN_NOT_UNIQUE), "not unique");
  CHECK_CONTAINS(fuge_status_text(FUGE_WARN_ILL_CONDITIONED), "far off");
  CHECK_CONTAINS(fuge_status_text(FUGE_ERR_NOT_SYMMETRIC), "not symmetric");
}

static void test_unknown_status(void) {
  const int unknown[] = {FUGE_WARN_ACCURACY + 1, FUGE_ERR_LAW - 1, INT_MAX, INT_MIN};
  for (int k = 0; k < 4; k++) CHECK_STRING(fuge_status_text(unknown[k]), "unknown status");
}

/* A caller keeps the pointer while others ask for other texts. */
static void test_status_text_stays(void) {
  const char *kept = fuge_status_text(FUGE_ERR_SIZE);
  char copy[128] = "";
  strncpy(copy, kept, sizeof copy - 1);
  fuge_status_text(FUGE_ERR_POINTER);
  fuge_status_text(INT_MAX);
  CHECK_STRING(kept, copy);
  CHECK(kept == fuge_status_text(FUGE_ERR_SIZE));
}

static void test_default_options(void) {
  fuge_options options;
  memset(&options, 0xff, sizeof options);
  fuge_default_options(&options);
  CHECK_INT(options.method, FUGE_AUTO);
  CHECK_INT(options.pivot_rule, FUGE_PAPER_RULE);
  CHECK_INT(options.max_iterations, 0);
  CHECK_INT(options.keep_history, 0);
  CHECK_INT(options.threads, 1);
  CHECK_NEAR(options.tolerance, 1e-10, 0.0);
  for (int k = 0; k < 3; k++) CHECK_INT(options.reserved_int[k], 0);
  for (int k = 0; k < 7; k++) CHECK_NEAR(options.reserved[k], 0.0, 0.0);
  fuge_default_options(NULL);
}

/* A program compiled with this header must run with a later library. */
static void test_struct_layout(void) {
  CHECK_INT(sizeof(fuge_options), 8 * sizeof(int) + 8 * sizeof(double));
  CHECK_INT(offsetof(fuge_options, keep_history), 3 * sizeof(int));
  CHECK_INT(offsetof(fuge_options, threads), 4 * sizeof(int));
  CHECK_INT(offsetof(fuge_options, tolerance), 8 * sizeof(int));
  CHECK_INT(sizeof(fuge_info), 8 * sizeof(int) + 8 * sizeof(double));
  CHECK_INT(offsetof(fuge_info, preconditionings), 4 * sizeof(int));
  CHECK_INT(offsetof(fuge_info, residual), 8 * sizeof(int));
}

int main(void) {
  test_version();
  test_status_texts();
  test_unknown_status();
  test_status_text_stays();
  test_default_options();
  test_struct_layout();
  return check_summary();
}
