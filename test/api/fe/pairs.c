/* Section "pairs of surfaces" of fuge_fe.h. */
#include "check.h"

/* An edge from x = 0 to 1 at y = 0.25, its body above, and two edges below it, at y = 0. */
static const double UPPER[4] = {0.0, 0.25, 1.0, 0.25}, LOWER[6] = {0.0, 0.0, 0.5, 0.0, 1.0, 0.0};
static const int UPPER_FACE[2] = {0, 1}, LOWER_FACE[6] = {1, 0, -1, 2, 1, -1};
static const int UPPER_DOF[4] = {6, 7, 8, 9}, LOWER_DOF[6] = {-1, 1, 2, 3, 4, 5};

static fuge_pairs *two_surfaces(void) {
  fuge_pairs *pairs = NULL;
  CHECK_DONE(fuge_pairs_create(&pairs, NULL, 0));
  CHECK_DONE(fuge_pairs_set_contact(pairs, 2, 2, UPPER, 2, 1, UPPER_FACE, UPPER_DOF));
  CHECK_DONE(fuge_pairs_set_opposite(pairs, 2, 3, LOWER, 3, 2, LOWER_FACE, LOWER_DOF));
  return pairs;
}

static double factor(int width, const int *dof, const double *normal, int wanted) {
  double sum = 0.0;
  for (int k = 0; k < width; k++)
    if (dof[k] == wanted) sum += normal[k];
  return sum;
}

static void test_mortar(void) {
  fuge_pairs *pairs = two_surfaces();
  int n = -1, width = -1, unpaired = -1, dof[40], pair[4], node[4], face[4];
  double normal[40], gap[4], upper[4], area[4], place[4], direction[8];

  CHECK_DONE(fuge_pairs_find(pairs, FUGE_MORTAR, FUGE_NORMALS_AVERAGED, NULL, 0.0, INFINITY, 0, 0));
  CHECK_DONE(fuge_pairs_get_sizes(pairs, &n, &width, &unpaired));
  CHECK_INT(n, 2);
  CHECK(width >= 4 && width <= 8);
  CHECK_INT(unpaired, 0);
  CHECK_DONE(fuge_pairs_get_contact(pairs, dof, normal));
  CHECK_NEAR(factor(width, dof, normal, 1), -0.75, 1e-15);
  CHECK_NEAR(factor(width, dof, normal, 3), -0.5, 1e-15);
  CHECK_NEAR(factor(width, dof, normal, 5), 0.25, 1e-15);
  CHECK_NEAR(factor(width, dof, normal, 7), 1.0, 1e-15);
  CHECK_DONE(fuge_pairs_get_gaps(pairs, gap, upper, area));
  for (int i = 0; i < 2; i++) {
    CHECK_NEAR(gap[i], 0.25, 1e-15);
    CHECK(isinf(upper[i]));
    CHECK_NEAR(area[i], 0.5, 1e-15);
  }
  CHECK_DONE(fuge_pairs_get_points(pairs, pair, node, face, place, direction));
  for (int i = 0; i < 2; i++) {
    CHECK_INT(pair[i], 0);
    CHECK_INT(node[i], i);
    CHECK_INT(face[i], i);
    CHECK_NEAR(direction[2 * i + 1], -1.0, 1e-15);
    CHECK(fabs(place[i]) <= 1.0);
  }
  CHECK_STATUS(fuge_pairs_find(pairs, FUGE_MORTAR, FUGE_NORMALS_AVERAGED, NULL, 0.0, 0.0, 0, 1), FUGE_WARN_PAIRS);
  CHECK_DONE(fuge_pairs_get_sizes(pairs, &n, NULL, NULL));
  CHECK_INT(n, 4);
  CHECK_DONE(fuge_pairs_get_gaps(pairs, NULL, upper, NULL));
  CHECK_NEAR(upper[3], 0.0, 0.0);
  fuge_pairs_free(&pairs);
  CHECK(pairs == NULL);
}

static void test_nodes(void) {
  fuge_pairs *pairs = two_surfaces();
  const double above[4] = {0.25, 0.25, 1.5, 0.25}, normals[4] = {0.0, -2.0, 0.0, -2.0};
  int n = -1, unpaired = -1, node = -1, pair = -1, face = -1;
  double gap = 0.0;

  CHECK_DONE(fuge_pairs_set_contact(pairs, 2, 2, above, 2, 1, UPPER_FACE, UPPER_DOF));
  CHECK_DONE(fuge_pairs_find(pairs, FUGE_NODE_TO_FACE, FUGE_NORMALS_GIVEN, normals, 1.0, INFINITY, 0, 0));
  CHECK_DONE(fuge_pairs_get_sizes(pairs, &n, NULL, &unpaired));
  CHECK_INT(n, 1);
  CHECK_INT(unpaired, 1);
  CHECK_DONE(fuge_pairs_get_unpaired(pairs, &pair, &node));
  CHECK_INT(pair, 0);
  CHECK_INT(node, 1);
  CHECK_DONE(fuge_pairs_get_points(pairs, NULL, NULL, &face, NULL, NULL));
  CHECK_INT(face, 0);
  CHECK_DONE(fuge_pairs_get_gaps(pairs, &gap, NULL, NULL));
  CHECK_NEAR(gap, 0.25, 1e-15);
  fuge_pairs_free(&pairs);
}

/* Two edges that meet at 30 degrees over a plane one: round above that angle, sharp below. */
static void test_geometry(void) {
  const double bent[6] = {0.0, 0.25, 1.0, 0.0, 1.8660254037844386, 0.5}, wide[4] = {-1.0, -1.0, 3.0, -1.0};
  const int faces[4] = {0, 1, 1, 2}, dof[6] = {0, 1, 2, 3, 4, 5}, face[2] = {1, 0};
  const double crease[3] = {29.0, 60.0, 91.0};
  double gap[2][3];
  fuge_pairs *pairs = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1];

  for (int k = 0; k < 3; k++) {
    CHECK_DONE(fuge_pairs_create(&pairs, NULL, 0));
    CHECK_DONE(fuge_pairs_set_contact(pairs, 2, 3, bent, 2, 2, faces, dof));
    CHECK_DONE(fuge_pairs_set_opposite(pairs, 2, 2, wide, 2, 1, face, NULL));
    CHECK_DONE(fuge_pairs_set_geometry(pairs, crease[k], 0));
    if (k < 2) {
      CHECK_DONE(fuge_pairs_find(pairs, FUGE_MORTAR, FUGE_NORMALS_OPPOSITE, NULL, 0.0, INFINITY, 0, 1));
      CHECK_DONE(fuge_pairs_get_gaps(pairs, gap[k], NULL, NULL));
    } else {
      CHECK_STATUS(fuge_pairs_find(pairs, FUGE_MORTAR, FUGE_NORMALS_OPPOSITE, NULL, 0.0, INFINITY, 0, 1),
                   FUGE_ERR_OPTION);
      CHECK_SAYS(fuge_pairs_message(pairs, message, sizeof message), FUGE_DONE, message, "crease = 91.0");
    }
    fuge_pairs_free(&pairs);
  }
  CHECK(gap[1][0] < gap[0][0] - 0.01);
  CHECK_STATUS(fuge_pairs_set_geometry(NULL, 25.0, 0), FUGE_ERR_POINTER);
}

static void test_bad_calls(void) {
  fuge_pairs *pairs = NULL;
  char message[FUGE_MESSAGE_LENGTH + 1];
  const int turned[2] = {1, 0}, far[2] = {0, 7};
  int n = -7;

  CHECK_STATUS(fuge_pairs_create(NULL, message, sizeof message), FUGE_ERR_POINTER);
  fuge_pairs_free(NULL);
  fuge_pairs_free(&pairs);
  CHECK_DONE(fuge_pairs_create(&pairs, NULL, 0));
  CHECK_STATUS(fuge_pairs_find(pairs, 0, 0, NULL, 0.0, INFINITY, 0, 0), FUGE_ERR_CALL_ORDER);
  CHECK_STATUS(fuge_pairs_get_sizes(pairs, &n, NULL, NULL), FUGE_ERR_CALL_ORDER);
  CHECK_INT(n, -7);
  CHECK_STATUS(fuge_pairs_set_contact(pairs, 4, 2, UPPER, 2, 1, UPPER_FACE, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_pairs_set_contact(pairs, 2, 0, UPPER, 2, 1, UPPER_FACE, NULL), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_pairs_set_contact(pairs, 2, 2, NULL, 2, 1, UPPER_FACE, NULL), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_pairs_set_contact(NULL, 2, 2, UPPER, 2, 1, UPPER_FACE, NULL), FUGE_ERR_POINTER);
  fuge_pairs_free(&pairs);
  pairs = two_surfaces();
  CHECK_STATUS(fuge_pairs_find(pairs, 0, FUGE_NORMALS_GIVEN, NULL, 0.0, INFINITY, 0, 0), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_pairs_set_contact(pairs, 2, 2, UPPER, 2, 1, far, UPPER_DOF));
  CHECK_STATUS(fuge_pairs_find(pairs, 0, 0, NULL, 0.0, INFINITY, 0, 0), FUGE_ERR_SIZE);
  CHECK_DONE(fuge_pairs_message(pairs, message, sizeof message));
  CHECK_CONTAINS(message, "contact surface: face 0 names node 7, which is not one of the 2 nodes");
  CHECK_DONE(fuge_pairs_set_contact(pairs, 2, 2, UPPER, 2, 1, turned, UPPER_DOF));
  CHECK_STATUS(fuge_pairs_find(pairs, 0, 0, NULL, 0.0, INFINITY, 0, 0), FUGE_ERR_MESH);
  CHECK_DONE(fuge_pairs_message(pairs, message, sizeof message));
  CHECK_CONTAINS(message, "face 0 of the contact surface and face 0 across from it");
  fuge_pairs_free(&pairs);
}

int main(void) {
  test_mortar();
  test_nodes();
  test_geometry();
  test_bad_calls();
  return check_summary();
}
