/* Section "mesh files" of fuge_fe.h. */
#include "check.h"

static const char *const NAME = "api_mesh_files_scratch.inp";

static void write_file(const char *content) {
  FILE *file = fopen(NAME, "wb");
  CHECK(file != NULL);
  if (file == NULL) return;
  fputs(content, file);
  fclose(file);
}

static void test_mesh(void) {
  fuge_mesh *mesh = NULL;
  int nodes = -1, elements = -1, connections = -1, count = -1;
  int node[4], element[1], first[2], connection[4], member[4], faces[16];
  double position[12];
  char message[256] = "old", type[17];
  write_file("*NODE\n10, 0., 0., 0.\n20, 1., 0., 0.\n30, 0., 1., 0.\n40, 0., 0., 1.\n"
             "*ELEMENT, TYPE=c3d4, ELSET=Tet\n7, 10, 20, 30, 40\n*NSET, NSET=BASE\n10, 30, 20\n"
             "*SURFACE, NAME=FOOT\nTET, S1\nTET, S3\n");
  CHECK_STATUS(fuge_read_mesh(NAME, &mesh, message, sizeof message), FUGE_DONE);
  CHECK_STRING(message, "");
  CHECK(mesh != NULL);
  if (mesh == NULL) return;
  CHECK_STATUS(fuge_mesh_get_sizes(mesh, &nodes, &elements, &connections), FUGE_DONE);
  CHECK(nodes == 4 && elements == 1 && connections == 4);
  CHECK_STATUS(fuge_mesh_get_nodes(mesh, node, position), FUGE_DONE);
  CHECK(node[0] == 10 && node[3] == 40);
  CHECK_NEAR(position[3], 1.0, 0.0);
  CHECK_NEAR(position[11], 1.0, 0.0);
  CHECK_STATUS(fuge_mesh_get_nodes(mesh, NULL, NULL), FUGE_DONE);
  CHECK_STATUS(fuge_mesh_get_elements(mesh, element, first, connection), FUGE_DONE);
  CHECK(element[0] == 7 && first[0] == 0 && first[1] == 4 && connection[0] == 0 && connection[3] == 3);
  CHECK_STATUS(fuge_mesh_get_type(mesh, 0, type, sizeof type), FUGE_DONE);
  CHECK_STRING(type, "C3D4");
  CHECK_STATUS(fuge_mesh_get_type(mesh, 1, type, sizeof type), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_mesh_get_type(mesh, -1, type, sizeof type), FUGE_ERR_SIZE);
  member[2] = -9;
  CHECK_STATUS(fuge_mesh_get_node_set(mesh, "base", 2, member, &count, NULL, 0), FUGE_DONE);
  CHECK(count == 3 && member[0] == 0 && member[1] == 2 && member[2] == -9);
  CHECK_STATUS(fuge_mesh_get_element_set(mesh, "TET", 4, member, &count, NULL, 0), FUGE_DONE);
  CHECK(count == 1 && member[0] == 0);
  CHECK_STATUS(fuge_mesh_get_element_set(mesh, "BASE", 4, member, &count, message, sizeof message), FUGE_ERR_OPTION);
  CHECK_STRING(message, "the mesh has no set of elements \"BASE\"");
  CHECK_STATUS(fuge_mesh_get_faces(mesh, "foot", 0, NULL, &count, NULL, 0), FUGE_DONE);
  CHECK_INT(count, 2);
  CHECK_STATUS(fuge_mesh_get_faces(mesh, "foot", 2, faces, &count, NULL, 0), FUGE_DONE);
  CHECK(faces[0] == 0 && faces[1] == 2 && faces[2] == 1 && faces[3] == -1 && faces[7] == -1);
  CHECK(faces[8] == 1 && faces[9] == 2 && faces[10] == 3 && faces[15] == -1);
  CHECK_STATUS(fuge_mesh_get_faces(mesh, "TOP", 2, faces, &count, message, sizeof message), FUGE_ERR_OPTION);
  CHECK_STRING(message, "the mesh has no surface \"TOP\"");
  CHECK_STATUS(fuge_mesh_get_faces(mesh, NULL, 2, faces, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_faces(mesh, "TOP", 2, faces, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_faces(mesh, "TOP", -1, faces, &count, NULL, 0), FUGE_ERR_SIZE);
  fuge_mesh_free(&mesh);
  CHECK(mesh == NULL);
  fuge_mesh_free(&mesh);
  fuge_mesh_free(NULL);
  remove(NAME);
}

static void test_refusals(void) {
  fuge_mesh *mesh = NULL;
  int count = -1;
  char message[256] = "";
  write_file("*NODE\n1, 0., 0., 0.\n1, 0., 0., 0.\n");
  CHECK_STATUS(fuge_read_mesh(NAME, &mesh, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_mesh_files_scratch.inp\", line 3: node 1 is defined a second time");
  CHECK(mesh == NULL);
  CHECK_STATUS(fuge_read_mesh(NULL, &mesh, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_mesh(NAME, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_sizes(NULL, &count, &count, &count), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_nodes(NULL, &count, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_elements(NULL, &count, NULL, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_type(NULL, 0, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_mesh_get_node_set(NULL, "A", 1, &count, &count, NULL, 0), FUGE_ERR_POINTER);
  CHECK_INT(count, -1);
  remove(NAME);
}

int main(void) {
  test_mesh();
  test_refusals();
  return check_summary();
}
