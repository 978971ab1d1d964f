/* Section "meshes" of fuge_files.h. */
#include "check.h"

static const char *const NAME = "api_mesh_files_scratch.vtu";

/* The content of the file NAME; at most size bytes. */
static size_t read_back(char *content, size_t size) {
  FILE *file = fopen(NAME, "rb");
  size_t bytes = 0;
  CHECK(file != NULL);
  if (file == NULL) return 0;
  bytes = fread(content, 1, size, file);
  fclose(file);
  return bytes;
}

/* The double at `place` among the numbers of a VTK file. */
static double number_at(const char *content, size_t bytes, size_t place) {
  static const char begin[] = "<AppendedData encoding=\"raw\">\n_";
  double number = SENTINEL;
  for (size_t k = 0; k + sizeof begin + place + 7 < bytes; k++) {
    if (memcmp(content + k, begin, sizeof begin - 1) != 0) continue;
    memcpy(&number, content + k + sizeof begin - 1 + place, 8);
  }
  return number;
}

/* A square and a triangle beside it, twice, as two bodies in one file with fields. */
static void test_write(void) {
  const double position[10] = {0., 0., 1., 0., 1., 1., 0., 1., 2., 0.5};
  const int element[8] = {0, 1, 2, 3, 1, 4, 2, -1};
  const char *const types[2] = {"cps4", "CPS3"};
  const char *const long_type = "C3D8_____________";
  const char *const names[2] = {"u", "body"};
  const char *const same[2] = {"u", "u"};
  const int components[2] = {2, 1}, elements[2] = {0, 1};
  /* Of the elements; without `elements` it is read as a field of the five nodes of one body. */
  double u[20], body[5] = {1., 1., 2., 2., 0.};
  const double *const fields[2] = {u, body};
  const double *const missing[2] = {u, NULL};
  fuge_mesh *mesh = NULL, *joined = NULL, *none = NULL;
  const fuge_mesh *both[2];
  static char content[4000];
  char message[FUGE_MESSAGE_LENGTH + 1] = "old";
  size_t bytes;
  for (int k = 0; k < 20; k++) u[k] = k + 0.25;
  CHECK_DONE(fuge_mesh_create(2, 5, position, 4, 2, element, 2, types, &mesh, message, sizeof message));
  CHECK_STRING(message, "");
  if (mesh == NULL) return;
  both[0] = mesh;
  both[1] = mesh;
  CHECK_DONE(fuge_mesh_join(2, both, &joined, message, sizeof message));
  if (joined == NULL) return;
  CHECK_DONE(fuge_write_mesh(NAME, joined, 2, names, components, elements, fields, message, sizeof message));
  bytes = read_back(content, sizeof content);
  CHECK(bytes > 0 && bytes < sizeof content);
  content[bytes < sizeof content ? bytes : 0] = '\0';
  CHECK_CONTAINS(content, "NumberOfPoints=\"10\" NumberOfCells=\"4\"");
  CHECK_NEAR(number_at(content, bytes, 8), 0.25, 0.0);
  CHECK_NEAR(number_at(content, bytes, 16), 1.25, 0.0);
  CHECK_NEAR(number_at(content, bytes, 24), 0.0, 0.0);
  CHECK_NEAR(number_at(content, bytes, 8 + 9 * 24 + 8), 19.25, 0.0);
  CHECK_NEAR(number_at(content, bytes, 8 + 10 * 24 + 8 + 3 * 8), 2.0, 0.0);
  CHECK_DONE(fuge_write_mesh(NAME, mesh, 0, NULL, NULL, NULL, NULL, message, sizeof message));
  CHECK(read_back(content, sizeof content) < bytes);
  CHECK_DONE(fuge_write_mesh(NAME, mesh, 2, names, components, NULL, fields, message, sizeof message));
  remove(NAME);
  CHECK_SAYS(fuge_write_mesh(NAME, joined, 2, same, components, elements, fields, message, sizeof message),
             FUGE_ERR_OPTION, message, "names 0 and 1 are the same");
  CHECK_SAYS(fuge_write_mesh(NAME, joined, 2, names, elements, elements, fields, message, sizeof message),
             FUGE_ERR_SIZE, message, "components[0] = 0");
  CHECK_MESSAGE(fuge_write_mesh(NAME, joined, 2, names, components, elements, missing, message, sizeof message),
                FUGE_ERR_POINTER, message, "field[1] is NULL");
  CHECK_STATUS(fuge_write_mesh(NAME, joined, 2, NULL, components, elements, fields, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_mesh(NAME, joined, -1, names, components, elements, fields, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_write_mesh(NULL, joined, 0, NULL, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_write_mesh(NAME, NULL, 0, NULL, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  u[3] = NAN;
  CHECK_SAYS(fuge_write_mesh(NAME, joined, 2, names, components, elements, fields, message, sizeof message),
             FUGE_ERR_NOT_FINITE, message, "field \"u\", column 1: component(1) = NaN");
  CHECK(fopen(NAME, "rb") == NULL);
  CHECK_MESSAGE(fuge_mesh_create(2, 5, position, 4, 2, element, 1, types, &none, message, sizeof message),
                FUGE_ERR_ELEMENT, message, "element 1 of type CPS4 has 3 nodes instead of 4");
  CHECK_MESSAGE(fuge_mesh_create(2, 4, position, 4, 2, element, 2, types, &none, message, sizeof message),
                FUGE_ERR_SIZE, message, "element 1 names node 4: there are 4");
  CHECK_SAYS(fuge_mesh_create(2, 5, position, 4, 2, element, 1, &long_type, &none, message, sizeof message),
             FUGE_ERR_OPTION, message, "type[0]");
  CHECK_STATUS(fuge_mesh_create(2, 5, NULL, 4, 2, element, 2, types, &none, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_create(2, 5, position, 4, 2, NULL, 2, types, &none, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_create(2, 5, position, 4, 2, element, 2, NULL, &none, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_create(2, 5, position, 4, 2, element, 2, types, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_create(4, 2, position, 4, 2, element, 2, types, &none, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_mesh_join(0, both, &none, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_mesh_join(2, NULL, &none, NULL, 0), FUGE_ERR_POINTER);
  both[1] = NULL;
  CHECK_MESSAGE(fuge_mesh_join(2, both, &none, message, sizeof message), FUGE_ERR_POINTER, message, "mesh[1] is NULL");
  CHECK(none == NULL);
  fuge_mesh_free(&joined);
  fuge_mesh_free(&mesh);
  CHECK(mesh == NULL);
  fuge_mesh_free(&mesh);
  fuge_mesh_free(NULL);
}

/* A full disk, where there is one: more than the library writes at a time, and less. */
static void test_full_disk(void) {
  enum { LARGE = 6000 };
  static double position[2 * LARGE];
  const int element[3] = {0, 1, 2};
  const char *const type = "CPE3";
  char message[FUGE_MESSAGE_LENGTH + 1] = "";
  FILE *full = fopen("/dev/full", "wb");
  if (full == NULL) return;
  fclose(full);
  for (int n = 3; n <= LARGE; n += LARGE - 3) {
    fuge_mesh *mesh = NULL;
    CHECK_DONE(fuge_mesh_create(2, n, position, 3, 1, element, 1, &type, &mesh, NULL, 0));
    message[0] = '\0';
    CHECK_STATUS(fuge_write_mesh("/dev/full", mesh, 0, NULL, NULL, NULL, NULL, message, sizeof message), FUGE_ERR_FILE);
    CHECK_CONTAINS(message, "\"/dev/full\" cannot be written: ");
    fuge_mesh_free(&mesh);
  }
}

int main(void) {
  test_write();
  test_full_disk();
  return check_summary();
}
