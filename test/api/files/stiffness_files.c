/* Section "stiffness files" of fuge_files.h. */
#include "scratch.h"

static const char *const NAME = "api_stiffness_files_scratch.txt";
static const char *const ROWS = "api_stiffness_files_scratch.dof";

static void test_named_entries(void) {
  int column[4] = {-1, -1, -1, -1}, row[5] = {-1, -1, -1, -1, -1}, node[4] = {-1, -1, -1, -1}, direction[4], rows = -1,
      entries = -1;
  double value[5];
  char message[256] = "old";
  /* Rows of node 4 in y, node 9 in x. */
  write_file(NAME, "** stiffness\n9,1, 9,1, 8.0\n9,1, 4,2, -1.5\n4,2, 4,2, 6.0\n");
  CHECK_MESSAGE(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, NULL, 0, 0, NULL, NULL, NULL, NULL, NULL, &rows,
                                    &entries, message, sizeof message), FUGE_DONE, message, "");
  CHECK(rows == 2 && entries == 4);
  fill(value, 5);
  CHECK_DONE(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ABAQUS, NULL, "", 2, 4, column, row, value, node, direction,
                                 &rows, &entries, NULL, 0));
  CHECK(column[0] == 0 && column[1] == 2 && column[2] == 4 && column[3] == -1);
  CHECK(row[0] == 0 && row[1] == 1 && row[2] == 0 && row[3] == 1 && row[4] == -1);
  CHECK(node[0] == 4 && node[1] == 9 && node[2] == -1);
  CHECK(direction[0] == 2 && direction[1] == 1);
  CHECK_VALUES(value, 0.0, 6.0, -1.5, -1.5, 8.0);
  CHECK_UNTOUCHED(value + 4, 1);
  /* Less room than the matrix needs. */
  fill(value, 5);
  node[1] = -1;
  CHECK_DONE(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, NULL, 1, 3, column, row, value, node, NULL, &rows,
                                 &entries, NULL, 0));
  CHECK_INT(node[1], -1);
  CHECK_INT(entries, 4);
  CHECK_UNTOUCHED(value + 3, 2);
  remove(NAME);
}

static void test_names_and_matrices(void) {
  int rows = -1, entries = -1, node[2], direction[2];
  write_file(NAME, "1 1 2.0\n1 2 -1.0\n2 2 3.0\n");
  write_file(ROWS, "17.3\n5.1\n");
  CHECK_DONE(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, ROWS, NULL, 2, 4, NULL, NULL, NULL, node, direction, &rows,
                                 &entries, NULL, 0));
  CHECK(node[0] == 17 && direction[0] == 3 && node[1] == 5 && direction[1] == 1);
  write_file(NAME, "DMIG,M,0,6,2\nDMIG,M,5,1,,5,1,2.0\nDMIG,K,0,6,2\nDMIG,K,7,3,,7,3,4.0\n");
  CHECK_DONE(fuge_read_stiffness(NAME, FUGE_STIFFNESS_ANY, NULL, "K", 2, 4, NULL, NULL, NULL, node, direction, &rows,
                                 &entries, NULL, 0));
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
  CHECK_SAYS(fuge_read_stiffness(NAME, 0, "no_such.dof", NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries,
                                 message, sizeof message), FUGE_ERR_FILE, message, "\"no_such.dof\" cannot be opened");
  remove(NAME);
  CHECK_STATUS(fuge_read_stiffness(NAME, 0, NULL, NULL, 2, 4, NULL, NULL, NULL, node, NULL, &rows, &entries, NULL, 0),
               FUGE_ERR_FILE);
  CHECK(rows == -1 && entries == -1 && node[0] == -1);
}

enum { DEGREES = 12, NODES = 6 };

/* K of the two elements of block.inp, by names; rows of another file may have another order. */
static void read_sample(const char *folder, const char *name, const char *names, double *k) {
  char path[512], names_path[512], message[256] = "";
  int column[DEGREES + 1], row[DEGREES * DEGREES], node[DEGREES], direction[DEGREES], rows = -1, entries = -1;
  double value[DEGREES * DEGREES];
  const int nodes[NODES] = {1, 2, 3, 4, 11, 12};
  int place[DEGREES];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  snprintf(names_path, sizeof names_path, "%s/block.dof", folder);
  CHECK_MESSAGE(fuge_read_stiffness(path, FUGE_STIFFNESS_ANY, names != NULL ? names_path : NULL, NULL, DEGREES,
                                    DEGREES * DEGREES, column, row, value, node, direction, &rows, &entries, message,
                                    sizeof message), FUGE_DONE, message, "");
  CHECK_INT(rows, DEGREES);
  for (int i = 0; i < DEGREES * DEGREES; i++) k[i] = 0.0;
  if (rows != DEGREES) return;
  for (int i = 0; i < DEGREES; i++) {
    place[i] = -1;
    for (int l = 0; l < NODES; l++)
      if (nodes[l] == node[i]) place[i] = 2 * l + direction[i] - 1;
    CHECK(place[i] >= 0 && place[i] < DEGREES);
    if (place[i] < 0 || place[i] >= DEGREES) return;
  }
  for (int j = 0; j < DEGREES; j++)
    for (int p = column[j]; p < column[j + 1]; p++) k[place[row[p]] + DEGREES * place[j]] = value[p];
}

/* The samples in all formats hold one matrix, and rigid motions of the mesh need no force. */
static void test_samples(const char *folder) {
  const char *const names[7] = {"block.sti", "block_matrix_input.mtx", "block_coordinate.mtx", "block.pch",
                                "block_dense.op4", "block_sparse.op4", "block.mtx"};
  const int without_names[7] = {0, 0, 1, 0, 1, 1, 1};
  double k[DEGREES * DEGREES], other[DEGREES * DEGREES], position[3 * NODES];
  fuge_mesh *mesh = NULL;
  char path[512];
  int faces[8], count = -1;
  read_sample(folder, names[0], NULL, k);
  for (int f = 1; f < 7; f++) {
    read_sample(folder, names[f], without_names[f] ? "block.dof" : NULL, other);
    CHECK(memcmp(k, other, sizeof k) == 0);
  }
  snprintf(path, sizeof path, "%s/block.inp", folder);
  CHECK_DONE(fuge_read_mesh(path, &mesh, NULL, 0));
  if (mesh == NULL) return;
  CHECK_DONE(fuge_mesh_get_nodes(mesh, NULL, position));
  CHECK_DONE(fuge_mesh_get_faces(mesh, "TOP", 1, faces, &count, NULL, 0));
  CHECK(count == 1 && faces[0] == 4 && faces[1] == 5 && faces[2] == -1);
  fuge_mesh_free(&mesh);
  CHECK_NEAR(k[0], 12.0, 0.0);
  for (int i = 0; i < DEGREES; i++) {
    double force[3] = {0.0, 0.0, 0.0};
    for (int l = 0; l < NODES; l++) {
      force[0] += k[i + DEGREES * (2 * l)];
      force[1] += k[i + DEGREES * (2 * l + 1)];
      force[2] += k[i + DEGREES * (2 * l + 1)] * position[3 * l] - k[i + DEGREES * (2 * l)] * position[3 * l + 1];
    }
    CHECK(force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0);
  }
}

int main(int argc, char **argv) {
  if (argc > 1) test_samples(argv[1]);
  test_named_entries();
  test_names_and_matrices();
  test_refusals();
  return check_summary();
}
