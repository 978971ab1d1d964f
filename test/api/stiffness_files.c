/* Section "stiffness files" of fuge_fe.h. */
#include "check.h"

static const char *const NAME = "api_stiffness_files_scratch.txt";
static const char *const ROWS = "api_stiffness_files_scratch.dof";

static void write_file(const char *name, const char *content) {
  FILE *file = fopen(name, "wb");
  CHECK(file != NULL);
  if (file == NULL) return;
  fputs(content, file);
  fclose(file);
}

static void test_named_entries(void) {
  int column[4] = {-1, -1, -1, -1}, row[5] = {-1, -1, -1, -1, -1}, node[4] = {-1, -1, -1, -1}, direction[4], rows = -1,
      entries = -1;
  double value[5];
  char message[256] = "old";
  /* Rows of node 4 in y, node 9 in x. */
  write_file(NAME, "** stiffness\n9,1, 9,1, 8.0\n9,1, 4,2, -1.5\n4,2, 4,2, 6.0\n");
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, NULL, 0, 0, NULL, NULL, NULL, NULL, NULL, &rows,
                                   &entries, message, sizeof message), FUGE_DONE);
  CHECK_STRING(message, "");
  CHECK(rows == 2 && entries == 4);
  fill(value, 5);
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ABAQUS, NULL, "", 2, 4, column, row, value, node, direction,
                                   &rows, &entries, NULL, 0), FUGE_DONE);
  CHECK(column[0] == 0 && column[1] == 2 && column[2] == 4 && column[3] == -1);
  CHECK(row[0] == 0 && row[1] == 1 && row[2] == 0 && row[3] == 1 && row[4] == -1);
  CHECK(node[0] == 4 && node[1] == 9 && node[2] == -1);
  CHECK(direction[0] == 2 && direction[1] == 1);
  CHECK_NEAR(value[0], 6.0, 0.0);
  CHECK_NEAR(value[1], -1.5, 0.0);
  CHECK_NEAR(value[2], -1.5, 0.0);
  CHECK_NEAR(value[3], 8.0, 0.0);
  CHECK_UNTOUCHED(value + 4, 1);
  /* Less room than the matrix needs. */
  fill(value, 5);
  node[1] = -1;
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, NULL, 1, 3, column, row, value, node, NULL, &rows,
                                   &entries, NULL, 0), FUGE_DONE);
  CHECK_INT(node[1], -1);
  CHECK_INT(entries, 4);
  CHECK_UNTOUCHED(value + 3, 2);
  remove(NAME);
}

static void test_names_and_matrices(void) {
  int rows = -1, entries = -1, node[2], direction[2];
  write_file(NAME, "1 1 2.0\n1 2 -1.0\n2 2 3.0\n");
  write_file(ROWS, "17.3\n5.1\n");
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, ROWS, NULL, 2, 4, NULL, NULL, NULL, node, direction, &rows,
                                   &entries, NULL, 0), FUGE_DONE);
  CHECK(node[0] == 17 && direction[0] == 3 && node[1] == 5 && direction[1] == 1);
  write_file(NAME, "DMIG,M,0,6,2\nDMIG,M,5,1,,5,1,2.0\nDMIG,K,0,6,2\nDMIG,K,7,3,,7,3,4.0\n");
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, "K", 2, 4, NULL, NULL, NULL, node, direction, &rows,
                                   &entries, NULL, 0), FUGE_DONE);
  CHECK(rows == 1 && node[0] == 7 && direction[0] == 3);
  remove(NAME);
  remove(ROWS);
}

static void test_refusals(void) {
  int rows = -1, entries = -1, node[2] = {-1, -1};
  char message[256] = "";
  write_file(NAME, "1 1 2.0\n1 2 nan\n");
  CHECK_STATUS(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows,
                                   &entries, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_stiffness_files_scratch.txt\", line 2: \"nan\" is not a finite number");
  CHECK_STATUS(fuge_read_stiffness(NAME, 6, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_OPTION);
  CHECK_STATUS(fuge_read_stiffness(NULL, 0, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, NULL, &entries, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, NULL, NULL, 0),
               FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, -1, 4, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, 2, -1, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, "no_such.dof", NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries,
                                   message, sizeof message), FUGE_ERR_FILE);
  CHECK_CONTAINS(message, "\"no_such.dof\" cannot be opened");
  remove(NAME);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_FILE);
  CHECK(rows == -1 && entries == -1 && node[0] == -1);
}

int main(void) {
  test_named_entries();
  test_names_and_matrices();
  test_refusals();
  return check_summary();
}
