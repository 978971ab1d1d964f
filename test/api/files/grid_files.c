/* Section "grids" of fuge_files.h. */
#include <stdlib.h>
#include "check.h"

static const char *const NAME = "api_grid_files_scratch.vti";

/* The bytes of the file, ended by NUL; their number.  The caller frees them. */
static char *read_file(size_t *length) {
  FILE *file = fopen(NAME, "rb");
  char *bytes = calloc(1, 4096);
  CHECK(file != NULL && bytes != NULL);
  *length = 0;
  if (file == NULL || bytes == NULL) return bytes;
  *length = fread(bytes, 1, 4095, file);
  fclose(file);
  return bytes;
}

static void test_volume(void) {
  const double stress[6] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, depth[3] = {0.0, 0.5, 2.0}, back_up[3] = {0.0, 2.0, 0.5};
  const double spacing[2] = {0.5, 2.0}, origin[2] = {10.0, 20.0};
  const char *const names[1] = {"zz"};
  const double *const results[1] = {stress};
  char message[FUGE_MESSAGE_LENGTH + 1] = "", *bytes, *values;
  size_t length;
  double back[6];
  CHECK_DONE(fuge_write_volume(NAME, 2, 1, spacing, origin, 3, depth, 1, names, results, message, sizeof message));
  bytes = read_file(&length);
  CHECK_CONTAINS(bytes, "<RectilinearGrid WholeExtent=\"0 1 0 0 0 2\">");
  CHECK_CONTAINS(bytes, "Name=\"zz\" format=\"appended\" offset=\"0\"");
  CHECK_CONTAINS(bytes, "Name=\"x\" format=\"appended\" offset=\"56\"");
  CHECK_CONTAINS(bytes, "Name=\"z\" format=\"appended\" offset=\"96\"");
  values = strstr(bytes, "\n_");
  CHECK(values != NULL);
  if (values != NULL) {
    memcpy(back, values + 2 + 8, sizeof back);
    CHECK_NEAR(back[5], 6.0, 0.0);
    memcpy(back, values + 2 + 56 + 8, 2*sizeof back[0]);
    CHECK_NEAR(back[1], 10.5, 0.0);
    memcpy(back, values + 2 + 96 + 8, 3*sizeof back[0]);
    CHECK_NEAR(back[2], 2.0, 0.0);
  }
  free(bytes);
  CHECK_SAYS(fuge_write_volume(NAME, 2, 1, spacing, NULL, 3, back_up, 1, names, results, message, sizeof message),
             FUGE_ERR_GRID, message, "depth(2) = 0.5");
  CHECK_STATUS(fuge_write_volume(NAME, 2, 1, spacing, NULL, 0, depth, 1, names, results, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_volume(NAME, 2, 1, spacing, NULL, 3, NULL, 1, names, results, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_volume(NAME, 32768, 32768, spacing, NULL, 3, depth, 1, names, results, message,
               sizeof message), FUGE_ERR_SIZE);
}

static void test_fields(void) {
  const double height[2] = {1.0, 2.0}, pressure[2] = {0.5, -3.0}, bad[2] = {0.0, HUGE_VAL};
  const double spacing[2] = {0.5, 2.0}, origin[2] = {10.0, 20.0}, flat[2] = {1.0, 0.0};
  const char *const names[2] = {"height", "p & q"}, *const same[2] = {"a", "a"}, *const none[2] = {"a", NULL};
  const double *const results[2] = {height, pressure}, *const infinite[2] = {height, bad};
  const double *const no_result[2] = {height, NULL};
  char message[FUGE_MESSAGE_LENGTH + 1] = "", *bytes, *values;
  size_t length;
  double back[2];
  CHECK_DONE(fuge_write_results(NAME, 2, 1, spacing, origin, 2, names, results, message, sizeof message));
  bytes = read_file(&length);
  CHECK_CONTAINS(bytes, "WholeExtent=\"0 2 0 1 0 0\"");
  CHECK_CONTAINS(bytes, "Origin=\" 9.75");
  CHECK_CONTAINS(bytes, "Name=\"p &amp; q\" format=\"appended\" offset=\"24\"");
  values = strstr(bytes, "\n_");
  CHECK(values != NULL);
  if (values != NULL) {
    memcpy(back, values + 2 + 8 + 16 + 8, sizeof back);
    CHECK_VALUES(back, 0.0, 0.5, -3.0);
  }
  free(bytes);
  CHECK_DONE(fuge_write_results(NAME, 2, 1, spacing, NULL, 1, names, results, NULL, 0));
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, same, results, message, sizeof message),
               FUGE_ERR_OPTION);
  CHECK_CONTAINS(message, "names 0 and 1");
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, none, results, message, sizeof message),
               FUGE_ERR_POINTER);
  CHECK_STRING(message, "names[1] is NULL");
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, names, no_result, NULL, 0), FUGE_ERR_POINTER);
  CHECK_SAYS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, names, infinite, message, sizeof message),
             FUGE_ERR_NOT_FINITE, message, "result \"p & q\": value(1)");
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, flat, NULL, 2, names, results, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_write_results(NAME, 2, 0, spacing, NULL, 2, names, results, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_results(NAME, 65536, 65536, spacing, NULL, 2, names, results, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 0, names, results, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, NULL, NULL, 2, names, results, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, NULL, results, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_results(NAME, 2, 1, spacing, NULL, 2, names, NULL, NULL, 0), FUGE_ERR_POINTER);
  remove(NAME);
}

/* A full disk, where there is one: more than the library writes at a time, and less. */
static void test_full_disk(void) {
  enum { LARGE = 60 };
  static double values[LARGE * LARGE];
  const char *const name = "p";
  const double *const result = values;
  const double spacing[2] = {1.0, 1.0};
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  FILE *full = fopen("/dev/full", "wb");
  if (full == NULL) return;
  fclose(full);
  for (int n = 1; n <= LARGE; n += LARGE - 1) {
    message[0] = '\0';
    CHECK_SAYS(fuge_write_results("/dev/full", n, n, spacing, NULL, 1, &name, &result, message, sizeof message),
               FUGE_ERR_FILE, message, "\"/dev/full\" cannot be written: ");
  }
}

int main(void) {
  test_fields();
  test_volume();
  test_full_disk();
  return check_summary();
}
