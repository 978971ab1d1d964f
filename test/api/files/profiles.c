/* Section "profiles" of fuge_files.h. */
#include "scratch.h"

static const char *const NAME = "api_profiles_scratch.txt";

static void test_read(void) {
  double x[3], z[3];
  int count = -1;
  char message[256] = "old";
  write_file(NAME, "x z\n0 1\n1 2\n2 4\n");
  CHECK_MESSAGE(fuge_read_profile(NAME, 3, x, z, &count, message, sizeof message), FUGE_DONE, message, "");
  CHECK_INT(count, 3);
  CHECK_NEAR(x[2], 2.0, 0.0);
  CHECK_NEAR(z[2], 4.0, 0.0);
  fill(x, 3);
  count = -1;
  CHECK_DONE(fuge_read_profile(NAME, 1, x, NULL, &count, NULL, 0));
  CHECK_INT(count, 3);
  CHECK_NEAR(x[0], 0.0, 0.0);
  CHECK_UNTOUCHED(x + 1, 2);
  CHECK_DONE(fuge_read_profile(NAME, 0, NULL, NULL, &count, NULL, 0));
  remove(NAME);
}

static void test_read_refusals(void) {
  double x[2], z[2];
  int count = -1;
  char message[256] = "";
  fill(x, 2);
  fill(z, 2);
  write_file(NAME, "0 1\n1\n");
  CHECK_STATUS(fuge_read_profile(NAME, 2, x, z, &count, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_profiles_scratch.txt\", line 2: only one column: x and z are needed");
  write_file(NAME, "");
  CHECK_STATUS(fuge_read_profile(NAME, 2, x, z, &count, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_profiles_scratch.txt\": the file ends after 0 point(s): a profile needs 2 or more");
  remove(NAME);
  CHECK_STATUS(fuge_read_profile(NAME, 2, x, z, &count, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "cannot be opened");
  CHECK_STATUS(fuge_read_profile("", 2, x, z, &count, NULL, 0), FUGE_ERR_FILE);
  CHECK_STATUS(fuge_read_profile(NULL, 2, x, z, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_profile(NAME, 2, x, z, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_profile(NAME, -1, x, z, &count, NULL, 0), FUGE_ERR_SIZE);
  CHECK_UNTOUCHED(x, 2);
  CHECK_UNTOUCHED(z, 2);
  CHECK_INT(count, -1);
}

static void test_sample(void) {
  const double x[2] = {0.0, 1.0}, z[2] = {0.0, 4.0}, centre[2] = {0.75, 0.25}, outside[2] = {0.5, 2.0};
  double height[2];
  char message[256] = "";
  fill(height, 2);
  CHECK_STATUS(fuge_sample_profile(2, x, z, 2, outside, height, message, sizeof message), FUGE_ERR_WIDTH);
  CHECK_CONTAINS(message, "centre(1) = 2.0");
  CHECK_STATUS(fuge_sample_profile(-1, x, z, 2, centre, height, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_sample_profile(2, x, z, -1, centre, height, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_sample_profile(2, NULL, z, 2, centre, height, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_sample_profile(2, x, NULL, 2, centre, height, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_sample_profile(2, x, z, 2, NULL, height, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_sample_profile(2, x, z, 2, centre, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(height, 2);
  CHECK_DONE(fuge_sample_profile(2, x, z, 2, centre, height, NULL, 0));
  CHECK_VALUES(height, 0.0, 3.0, 1.0);
}

static void test_level(void) {
  const double x[3] = {0.0, 1.0, 2.0};
  double z[3];
  char message[256] = "";
  fill(z, 3);
  CHECK_SAYS(fuge_level_profile(3, x, z, 5, message, sizeof message), FUGE_ERR_OPTION, message, "form = 5");
  CHECK_STATUS(fuge_level_profile(1, x, z, FUGE_LEVEL_MEAN, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_level_profile(3, NULL, z, FUGE_LEVEL_MEAN, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_level_profile(3, x, NULL, FUGE_LEVEL_MEAN, NULL, 0), FUGE_ERR_POINTER);
  CHECK_UNTOUCHED(z, 3);
  z[0] = 1.0; z[1] = 2.0; z[2] = 3.0;
  CHECK_DONE(fuge_level_profile(3, x, z, FUGE_LEVEL_MEAN, NULL, 0));
  CHECK_NEAR(z[0], -1.0, 1e-15);
  CHECK_DONE(fuge_level_profile(3, x, z, FUGE_LEVEL_LINE, NULL, 0));
  CHECK_NEAR(z[0], 0.0, 1e-15);
}

int main(void) {
  test_read();
  test_read_refusals();
  test_sample();
  test_level();
  return check_summary();
}
