/* Section "surfaces" of fuge_files.h. */
#include <stdlib.h>
#include "scratch.h"

static const char *const NAME = "api_surfaces_scratch.txt";

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

static void test_read(void) {
  double height[6], spacing[2], origin[2];
  int nx = -1, ny = -1, filled = -1;
  char message[256] = "old";
  write_file(NAME, "# made by hand\n1 2 4\n8 16 nan\n");
  CHECK_MESSAGE(fuge_read_surface(NAME, FUGE_FILE_GRID, 1, 6, height, &nx, &ny, spacing, origin, &filled, message,
                                  sizeof message), FUGE_DONE, message, "");
  CHECK_INT(nx, 3);
  CHECK_INT(ny, 2);
  CHECK_INT(filled, 1);
  CHECK_NEAR(height[2], 4.0, 0.0);
  CHECK_NEAR(height[4], 16.0, 0.0);
  CHECK_NEAR(height[5], 10.0, 0.0);
  CHECK_NEAR(spacing[0], 0.0, 0.0);
  CHECK_NEAR(origin[1], 0.0, 0.0);
  fill(height, 6);
  write_file(NAME, "10 5 1\n12 5 2\n12 6 4\n10 6 3\n10 7 5\n12 7 6\n");
  CHECK_DONE(fuge_read_surface(NAME, FUGE_FILE_ANY, 0, 4, height, &nx, &ny, spacing, origin, NULL, NULL, 0));
  CHECK_INT(nx, 2);
  CHECK_INT(ny, 3);
  CHECK_NEAR(height[2], 3.0, 0.0);
  CHECK_NEAR(height[3], 4.0, 0.0);
  CHECK_UNTOUCHED(height + 4, 2);
  CHECK_VALUES(spacing, 0.0, 2.0, 1.0);
  CHECK_VALUES(origin, 0.0, 10.0, 5.0);
  fill(height, 6);
  CHECK_DONE(fuge_read_surface(NAME, FUGE_FILE_ANY, 0, 0, height, &nx, &ny, NULL, NULL, NULL, NULL, 0));
  CHECK_UNTOUCHED(height, 6);
  CHECK_DONE(fuge_read_surface(NAME, FUGE_FILE_ANY, 0, 9, NULL, &nx, &ny, NULL, NULL, NULL, NULL, 0));
  remove(NAME);
}

static void test_read_refusals(void) {
  double height[4];
  int nx = -1, ny = -1;
  char message[256] = "";
  fill(height, 4);
  write_file(NAME, "1 2\n3\n");
  CHECK_MESSAGE(fuge_read_surface(NAME, 0, 0, 4, height, &nx, &ny, NULL, NULL, NULL, message, sizeof message),
                FUGE_ERR_FILE, message, "\"api_surfaces_scratch.txt\", line 2: 1 value(s), but the first row has 2");
  CHECK_STATUS(fuge_read_surface(NAME, 9, 0, 4, height, &nx, &ny, NULL, NULL, NULL, NULL, 0), FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_read_surface(NAME, 0, 0, -1, height, &nx, &ny, NULL, NULL, NULL, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_surface(NAME, 0, 0, 4, height, NULL, &ny, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_surface(NAME, 0, 0, 4, height, &nx, NULL, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_surface(NULL, 0, 0, 4, height, &nx, &ny, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  remove(NAME);
  CHECK_SAYS(fuge_read_surface(NAME, 0, 0, 4, height, &nx, &ny, NULL, NULL, NULL, message, sizeof message),
             FUGE_ERR_FILE, message, "cannot be opened");
  CHECK_UNTOUCHED(height, 4);
  CHECK_INT(nx, -1);
  CHECK_INT(ny, -1);
}

/* A surface that is written is read back to the last bit. */
static void test_write(void) {
  const double height[6] = {1.0 / 3.0, -2.0 / 7.0, 1e-6, 3e-300, 0.0, 12345.678}, spacing[2] = {0.1, 0.3};
  const double wrong[2] = {1.0, -1.0}, bad[2] = {1.0, NAN};
  double back[6], found[2];
  int nx, ny;
  char message[256] = "";
  CHECK_DONE(fuge_write_surface(NAME, 2, 3, spacing, height, message, sizeof message));
  CHECK_DONE(fuge_read_surface(NAME, FUGE_FILE_GRID, 0, 6, back, &nx, &ny, found, NULL, NULL, NULL, 0));
  CHECK_INT(nx, 2);
  CHECK_INT(ny, 3);
  CHECK(memcmp(back, height, sizeof back) == 0);
  CHECK(memcmp(found, spacing, sizeof found) == 0);
  CHECK_DONE(fuge_write_surface(NAME, 6, 1, NULL, height, NULL, 0));
  CHECK_DONE(fuge_read_surface(NAME, FUGE_FILE_ANY, 0, 6, back, &nx, &ny, found, NULL, NULL, NULL, 0));
  CHECK_INT(nx, 6);
  CHECK_NEAR(found[0], 0.0, 0.0);
  CHECK_STATUS(fuge_write_surface(NAME, 2, 3, wrong, height, NULL, 0), FUGE_ERR_WIDTH);
  CHECK_STATUS(fuge_write_surface(NAME, 2, 1, NULL, bad, message, sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_CONTAINS(message, "height(1, 0) = NaN");
  CHECK_STATUS(fuge_write_surface(NAME, 0, 3, NULL, height, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_surface(NAME, 65536, 65536, NULL, height, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_surface(NAME, 2, 3, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_surface(NULL, 2, 3, NULL, height, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_surface("no_such_folder/a.txt", 2, 3, NULL, height, NULL, 0), FUGE_ERR_FILE);
  remove(NAME);
}

static void test_level(void) {
  double height[6] = {1.0, 3.0, 2.0, 4.0, 3.0, 5.0};
  char message[256] = "";
  CHECK_DONE(fuge_level_surface(2, 3, height, FUGE_LEVEL_MEAN, NULL, 0));
  CHECK_NEAR(height[0], -2.0, 1e-15);
  CHECK_DONE(fuge_level_surface(2, 3, height, FUGE_LEVEL_PLANE, NULL, 0));
  CHECK_NEAR(height[0], 0.0, 1e-15);
  CHECK_NEAR(height[5], 0.0, 1e-15);
  fill(height, 6);
  CHECK_STATUS(fuge_level_surface(2, 3, height, FUGE_LEVEL_LINE, message, sizeof message), FUGE_ERR_OPTION);
  CHECK_CONTAINS(message, "form = 1");
  CHECK_STATUS(fuge_level_surface(-1, 3, height, FUGE_LEVEL_MEAN, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_level_surface(2, 3, NULL, FUGE_LEVEL_MEAN, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(height, 6);
}

static void test_fill(void) {
  double height[6] = {1.0, 3.0, NAN, 4.0, 3.0, 5.0}, hole[2] = {NAN, NAN}, infinite[2] = {NAN, -INFINITY};
  char message[256] = "old";
  int filled = -1;
  CHECK_MESSAGE(fuge_fill_surface(2, 3, height, &filled, message, sizeof message), FUGE_DONE, message, "");
  CHECK_INT(filled, 1);
  CHECK_NEAR(height[2], (1.0 + 4.0 + 3.0) / 3.0, 1e-15);
  CHECK_NEAR(height[5], 5.0, 0.0);
  CHECK_DONE(fuge_fill_surface(2, 3, height, NULL, NULL, 0));
  CHECK_STATUS(fuge_fill_surface(2, 1, hole, &filled, message, sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_CONTAINS(message, "all heights are NaN");
  CHECK(isnan(hole[0]) && isnan(hole[1]));
  CHECK_STATUS(fuge_fill_surface(2, 1, infinite, &filled, message, sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_CONTAINS(message, "height(1, 0) = -Inf");
  CHECK(isnan(infinite[0]));
  CHECK_STATUS(fuge_fill_surface(0, 1, hole, &filled, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_fill_surface(2, 1, NULL, &filled, NULL, 0), FUGE_ERR_POINTER);
  CHECK_INT(filled, 1);
}

static void test_volume(void) {
  const double stress[6] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, depth[3] = {0.0, 0.5, 2.0}, back_up[3] = {0.0, 2.0, 0.5};
  const double spacing[2] = {0.5, 2.0}, origin[2] = {10.0, 20.0};
  const char *const names[1] = {"zz"};
  const double *const results[1] = {stress};
  char message[256] = "", *bytes, *values;
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
  char message[256] = "", *bytes, *values;
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
  char message[256] = "";
  FILE *full = fopen("/dev/full", "wb");
  if (full == NULL) return;
  fclose(full);
  for (int n = 1; n <= LARGE; n += LARGE - 1) {
    CHECK_STATUS(fuge_write_surface("/dev/full", n, n, NULL, values, message, sizeof message), FUGE_ERR_FILE);
    CHECK_CONTAINS(message, "\"/dev/full\" cannot be written: ");
    message[0] = '\0';
    CHECK_SAYS(fuge_write_results("/dev/full", n, n, spacing, NULL, 1, &name, &result, message, sizeof message),
               FUGE_ERR_FILE, message, "\"/dev/full\" cannot be written: ");
  }
}

/* The same surface in two formats, ground.sdf and ground.txt in `folder`: with and without the points that were not
 * measured. */
static void test_data(const char *folder) {
  enum { NX = 40, NY = 30 };
  static double from_sdf[NX * NY], from_grid[NX * NY];
  const char *const names[2] = {"ground.sdf", "ground.txt"};
  double *const heights[2] = {from_sdf, from_grid};
  double difference = 0.0, spacing[2];
  char path[1000], message[256] = "";
  int nx, ny, filled;
  for (int k = 0; k < 2; k++) {
    snprintf(path, sizeof path, "%s/%s", folder, names[k]);
    CHECK_SAYS(fuge_read_surface(path, FUGE_FILE_ANY, 0, 0, NULL, &nx, &ny, NULL, NULL, NULL, message, sizeof message),
               FUGE_ERR_FILE, message, "not measured");
    CHECK_DONE(fuge_read_surface(path, FUGE_FILE_ANY, 1, NX * NY, heights[k], &nx, &ny, spacing, NULL, &filled, message,
                                 sizeof message));
    CHECK_INT(nx, NX);
    CHECK_INT(ny, NY);
    CHECK_INT(filled, 9);
    CHECK_VALUES(spacing, 0.0, 2.0e-6, 2.5e-6);
  }
  for (int k = 0; k < NX * NY; k++) difference = fmax(difference, fabs(from_sdf[k] - from_grid[k]));
  CHECK_NEAR(from_sdf[1], 7.259e-7, 1e-21);
  CHECK_NEAR(difference, 0.0, 1e-21);
}

int main(int argc, char **argv) {
  if (argc > 1) {
    test_data(argv[1]);
    return check_summary();
  }
  test_read();
  test_read_refusals();
  test_write();
  test_level();
  test_fill();
  test_fields();
  test_volume();
  test_full_disk();
  return check_summary();
}
