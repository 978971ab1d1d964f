/* Section "matrix files" of fuge_files.h. */
#if !defined(_WIN32)
#define _XOPEN_SOURCE 600
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#endif
#include <limits.h>
#include "scratch.h"

static const char *const NAME = "api_matrices_scratch.mtx";

static void test_read_matrix(void) {
  double matrix[9];
  int rows = -1, columns = -1;
  char message[256] = "old";
  write_file(NAME, "%%MatrixMarket matrix array real general\n3 2\n1\n2\n3\n4\n5\n6\n");
  CHECK_MESSAGE(fuge_read_matrix(NAME, 0, 0, NULL, &rows, &columns, message, sizeof message), FUGE_DONE, message, "");
  CHECK_INT(rows, 3);
  CHECK_INT(columns, 2);
  fill(matrix, 9);
  CHECK_DONE(fuge_read_matrix(NAME, 4, 2, matrix, &rows, &columns, NULL, 0));
  CHECK_NEAR(matrix[0], 1.0, 0.0);
  CHECK_NEAR(matrix[2], 3.0, 0.0);
  CHECK_UNTOUCHED(matrix + 3, 1);
  CHECK_NEAR(matrix[4], 4.0, 0.0);
  CHECK_NEAR(matrix[6], 6.0, 0.0);
  CHECK_UNTOUCHED(matrix + 7, 2);
  fill(matrix, 9);
  CHECK_DONE(fuge_read_matrix(NAME, 2, 1, matrix, &rows, &columns, NULL, 0));
  CHECK_NEAR(matrix[1], 2.0, 0.0);
  CHECK_UNTOUCHED(matrix + 2, 7);
  CHECK_INT(rows, 3);
  CHECK_INT(columns, 2);
  remove(NAME);
}

static void test_read_refusals(void) {
  double matrix[4], value[4];
  int rows = -1, columns = -1, entries = -1, column[3] = {-1, -1, -1}, row[4] = {-1, -1, -1, -1};
  char message[256] = "";
  fill(matrix, 4);
  fill(value, 4);
  write_file(NAME, "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n");
  CHECK_STATUS(fuge_read_matrix(NAME, 2, 2, matrix, &rows, &columns, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_matrices_scratch.mtx\", line 3: row \"3\" is outside 1 .. 2");
  message[0] = '\0';
  CHECK_MESSAGE(fuge_read_sparse(NAME, 2, 4, column, row, value, &rows, &columns, &entries, message, sizeof message),
                FUGE_ERR_FILE, message, "\"api_matrices_scratch.mtx\", line 3: row \"3\" is outside 1 .. 2");
  remove(NAME);
  CHECK_STATUS(fuge_read_matrix(NAME, 2, 2, matrix, &rows, &columns, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "cannot be opened");
  CHECK_STATUS(fuge_read_matrix("", 2, 2, matrix, &rows, &columns, NULL, 0), FUGE_ERR_FILE);
  CHECK_STATUS(fuge_read_matrix(NULL, 2, 2, matrix, &rows, &columns, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_matrix(NAME, 2, 2, matrix, NULL, &columns, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_matrix(NAME, 2, 2, matrix, &rows, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_matrix(NAME, -1, 2, matrix, &rows, &columns, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_matrix(NAME, 2, -1, matrix, &rows, &columns, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_sparse(NULL, 2, 4, column, row, value, &rows, &columns, &entries, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_sparse(NAME, 2, 4, column, row, value, NULL, &columns, &entries, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_sparse(NAME, 2, 4, column, row, value, &rows, NULL, &entries, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_sparse(NAME, 2, 4, column, row, value, &rows, &columns, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_sparse(NAME, -1, 4, column, row, value, &rows, &columns, &entries, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_sparse(NAME, 2, -1, column, row, value, &rows, &columns, &entries, NULL, 0), FUGE_ERR_SIZE);
  CHECK_UNTOUCHED(matrix, 4);
  CHECK_UNTOUCHED(value, 4);
  CHECK(rows == -1 && columns == -1 && entries == -1 && column[0] == -1 && row[0] == -1);
}

static void test_sparse(void) {
  /* [2 -1 0; -1 2 -1; 0 -1 2] */
  const int column[4] = {0, 2, 5, 7}, row[7] = {0, 1, 0, 1, 2, 1, 2};
  const double value[7] = {2, -1, -1, 2, -1, -1, 2};
  int found_column[4] = {-1, -1, -1, -1}, found_row[7], rows = -1, columns = -1, entries = -1;
  double found[7];
  for (int symmetric = 0; symmetric < 2; symmetric++) {
    fill(found, 7);
    CHECK_DONE(fuge_write_sparse(NAME, 3, 3, column, row, value, symmetric, NULL, 0));
    CHECK_DONE(fuge_read_sparse(NAME, 0, 0, NULL, NULL, NULL, &rows, &columns, &entries, NULL, 0));
    CHECK(rows == 3 && columns == 3 && entries == 7);
    CHECK_DONE(fuge_read_sparse(NAME, 3, 7, found_column, found_row, found, &rows, &columns, &entries, NULL, 0));
    CHECK(memcmp(column, found_column, sizeof column) == 0);
    CHECK(memcmp(row, found_row, sizeof row) == 0);
    CHECK(memcmp(value, found, sizeof value) == 0);
  }
  fill(found, 7);
  CHECK_DONE(fuge_read_sparse(NAME, 1, 2, found_column, found_row, found, &rows, &columns, &entries, NULL, 0));
  CHECK_INT(entries, 7);
  CHECK_NEAR(found[1], -1.0, 0.0);
  CHECK_UNTOUCHED(found + 2, 5);
  for (int k = 0; k < 4; k++) found_column[k] = -1;
  CHECK_DONE(fuge_read_sparse(NAME, 0, 0, found_column, NULL, NULL, &rows, &columns, &entries, NULL, 0));
  CHECK(found_column[0] == 0 && found_column[1] == -1);
  CHECK_DONE(fuge_read_sparse(NAME, INT_MAX, INT_MAX, found_column, found_row, found, &rows, &columns, &entries, NULL,
                              0));
  CHECK(memcmp(column, found_column, sizeof column) == 0);
  CHECK(memcmp(value, found, sizeof value) == 0);
  remove(NAME);
}

static void test_write(void) {
  const double matrix[6] = {0.1, -1e-300, HUGE_VAL, 1.0 / 3.0, 1.7976931348623157e308, HUGE_VAL};
  double found[4];
  int rows, columns;
  CHECK_DONE(fuge_write_matrix(NAME, 2, 2, matrix, 3, 0, NULL, 0));
  CHECK_DONE(fuge_read_matrix(NAME, 2, 2, found, &rows, &columns, NULL, 0));
  CHECK(memcmp(found, matrix, 2 * sizeof *found) == 0);
  CHECK(memcmp(found + 2, matrix + 3, 2 * sizeof *found) == 0);
  CHECK_DONE(fuge_write_matrix(NAME, 2, 2, matrix, 3, 1, NULL, 0));
  CHECK_DONE(fuge_read_matrix(NAME, 2, 2, found, &rows, &columns, NULL, 0));
  CHECK_NEAR(found[2], -1e-300, 0.0);
  remove(NAME);
}

static void test_write_refusals(void) {
  const double matrix[4] = {1.0, 2.0, HUGE_VAL, 4.0};
  const int column[3] = {0, 1, 2}, falling[3] = {0, 2, 1}, negative[3] = {0, 1, -1}, from_one[3] = {1, 2, 3};
  const int row[2] = {0, 1}, far[2] = {0, 2};
  char message[256] = "";
  CHECK_STATUS(fuge_write_matrix(NAME, 2, 2, matrix, 2, 0, message, sizeof message), FUGE_ERR_NOT_FINITE);
  CHECK_CONTAINS(message, "entry (0, 1)");
  CHECK_STATUS(fuge_write_matrix(NULL, 2, 2, matrix, 2, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_matrix(NAME, 2, 2, NULL, 2, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_matrix(NAME, 2, -2, matrix, 2, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_matrix(NAME, -1, 2, matrix, 2, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_matrix(NAME, 2, 2, matrix, 1, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_matrix(NAME, 1, 2, matrix, 1, 1, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_matrix("", 2, 1, matrix, 2, 0, NULL, 0), FUGE_ERR_FILE);
  /* Fortran would write to the path without the blank. */
  CHECK_STATUS(fuge_write_matrix("scratch_blank.mtx ", 2, 1, matrix, 2, 0, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "\"scratch_blank.mtx \" ends in a blank");
  CHECK(fopen("scratch_blank.mtx", "r") == NULL);
  CHECK_STATUS(fuge_write_matrix("no_such_folder/a.mtx", 2, 1, matrix, 2, 0, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "\"no_such_folder/a.mtx\" cannot be opened");
  CHECK_STATUS(fuge_write_sparse(NULL, 2, 2, column, row, matrix, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, NULL, row, matrix, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, column, NULL, matrix, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, column, row, NULL, 0, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_sparse(NAME, -2, 2, column, row, matrix, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, -2, column, row, matrix, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, falling, row, matrix, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, from_one, row, matrix, 0, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_STRING(message, "column(0) = 1: it must be 0, where the first column begins");
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, negative, row, matrix, 0, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, column, far, matrix, 0, message, sizeof message), FUGE_ERR_SIZE);
  CHECK_CONTAINS(message, "row(1) = 2 is outside 0 .. 1");
  CHECK_STATUS(fuge_write_sparse(NAME, 2, 2, column, row, matrix + 1, 0, NULL, 0), FUGE_ERR_NOT_FINITE);
  FILE *file = fopen(NAME, "rb");
  CHECK(file == NULL);
}

#if !defined(_WIN32)
/* More bytes than the library writes at a time. */
enum { LARGE = 28 };
static double large[LARGE * LARGE];

static void write_in_vain(const char *path) {
  int column[LARGE + 1], row[LARGE * LARGE];
  char message[256] = "";
  for (int k = 0; k <= LARGE; k++) column[k] = LARGE * k;
  for (int k = 0; k < LARGE * LARGE; k++) row[k] = k % LARGE;
  CHECK_STATUS(fuge_write_matrix(path, 1, 1, large, 1, 0, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "cannot be written: ");
  CHECK_STATUS(fuge_write_matrix(path, LARGE, LARGE, large, LARGE, 0, NULL, 0), FUGE_ERR_FILE);
  message[0] = '\0';
  CHECK_STATUS(fuge_write_sparse(path, LARGE, LARGE, column, row, large, 0, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "cannot be written: ");
}

/* The lowest free descriptor. */
static int free_descriptor(void) {
  int descriptor = dup(0);
  close(descriptor);
  return descriptor;
}

/* Neither a file that cannot grow beyond some bytes nor a full disk costs a descriptor, and the file is not taken
 * for a whole one. */
static void test_full_disk(void) {
  const int descriptor = free_descriptor();
  struct rlimit old, small;
  int rows, columns;
  char message[256] = "";
  CHECK(signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
  CHECK(getrlimit(RLIMIT_FSIZE, &old) == 0);
  small = old;
  for (int k = 0; k < 100; k++) {
    small.rlim_cur = k < 50 ? 20 : 60;
    CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
    write_in_vain(NAME);
    CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  }
  CHECK_STATUS(fuge_read_matrix(NAME, 0, 0, NULL, &rows, &columns, message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "is empty");
  for (int k = 0; k < 100 && access("/dev/full", W_OK) == 0; k++) write_in_vain("/dev/full");
  CHECK_INT(free_descriptor(), descriptor);
  /* The next write is not disturbed. */
  CHECK_DONE(fuge_write_matrix(NAME, LARGE, LARGE, large, LARGE, 0, NULL, 0));
  CHECK_DONE(fuge_read_matrix(NAME, 0, 0, NULL, &rows, &columns, NULL, 0));
  CHECK_INT(rows, LARGE);
  remove(NAME);
}
#endif

int main(void) {
  test_read_matrix();
  test_read_refusals();
  test_sparse();
  test_write();
  test_write_refusals();
#if !defined(_WIN32)
  test_full_disk();
#endif
  return check_summary();
}
