/* Section "decks" of fuge_files.h. */
#include "scratch.h"

static const char *const NAME = "api_decks_scratch";

static void test_deck(void) {
  const int node[5] = {1, 1, 2, 2, 2}, direction[5] = {1, 3, 1, 2, 3};
  fuge_deck *deck = NULL;
  const double u[5] = {0., 0., 0., -1., 0.}, position[2] = {0., 0.};
  const int places[2] = {-1, -1};
  fuge_links *made = NULL;
  int links = -1, cases = -1, a[2], b[2], count = -1, fixed[4] = {-9, -9, -9, -9};
  double along[6], gap[2], play[2], compliance[2], limit[2], loads[15], displacement[4];
  char message[256] = "old", name[81];
  write_file(NAME, "SPC = 4\nSUBCASE 7\nLOAD = 3\nSUBCASE 9\nBEGIN BULK\nGRID,1\nGRID,2,,0.,0.,2.\nCGAP,12,5,1,2\n"
             "PGAP,5,.5,,4.\nFORCE,3,2,,2.,0.,0.,-1.\nSPC,4,1,13,.25\n");
  CHECK_MESSAGE(fuge_read_deck(NAME, &deck, message, sizeof message), FUGE_DONE, message, "");
  CHECK(deck != NULL);
  if (deck == NULL) return;
  write_file(NAME, "0 2 0 -3 0 1 2 0 5 rope\n");
  CHECK_DONE(fuge_deck_read_links(deck, NAME, message, sizeof message));
  write_file(NAME, "2,y\n");
  CHECK_DONE(fuge_deck_read_supports(deck, NAME, message, sizeof message));
  write_file(NAME, "row,wind\n2.1,8\n");
  CHECK_DONE(fuge_deck_read_cases(deck, NAME, message, sizeof message));
  CHECK_DONE(fuge_deck_get_counts(deck, &links, &cases));
  CHECK(links == 2 && cases == 3);
  CHECK_DONE(fuge_deck_get_counts(deck, NULL, NULL));
  CHECK_DONE(fuge_deck_get_links(deck, a, b, along, gap, play, compliance, limit));
  CHECK(a[0] == 1 && b[0] == 2 && a[1] == 0 && b[1] == 2);
  CHECK_NEAR(along[2], 1., 0.);
  CHECK_NEAR(along[4], -1., 0.);
  CHECK_NEAR(gap[0], 0.5, 0.);
  CHECK_NEAR(compliance[0], 0.25, 0.);
  CHECK(play[0] > 1e300 && limit[0] > 1e300);
  CHECK_NEAR(play[1], 2., 0.);
  CHECK_NEAR(limit[1], 5., 0.);
  CHECK_DONE(fuge_deck_get_links(deck, NULL, NULL, NULL, NULL, NULL, NULL, NULL));
  CHECK_MESSAGE(fuge_deck_get_link_name(deck, 0, name, sizeof name), FUGE_DONE, name, "CGAP 12");
  CHECK_MESSAGE(fuge_deck_get_link_name(deck, 1, name, sizeof name), FUGE_DONE, name, "rope");
  CHECK_MESSAGE(fuge_deck_get_case_name(deck, 1, name, sizeof name), FUGE_DONE, name, "SUBCASE 9");
  CHECK_STATUS(fuge_deck_get_link_name(deck, 2, name, sizeof name), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_deck_get_case_name(deck, -1, name, sizeof name), FUGE_ERR_SIZE);
  CHECK_DONE(fuge_deck_make_links(deck, 5, node, direction, &made, message, sizeof message));
  CHECK_DONE(fuge_links_get_count(made, &count));
  CHECK_INT(count, 2);
  CHECK_DONE(fuge_links_get_gaps(made, gap));
  CHECK_NEAR(gap[0], 0.5, 0.);
  CHECK_NEAR(gap[1], 1., 0.);
  CHECK_MESSAGE(fuge_links_describe(made, 5, u, 2, 1, position, places, message, sizeof message), FUGE_DONE, message,
                "rope opens; the structure is a mechanism, and degree of freedom 3 moves most");
  fuge_links_free(&made);
  CHECK_DONE(fuge_deck_get_loads(deck, 5, node, direction, loads, message, sizeof message));
  CHECK_NEAR(loads[4], -2., 0.);
  CHECK_NEAR(loads[12], 8., 0.);
  CHECK_DONE(fuge_deck_get_supports(deck, 0, 5, node, direction, 2, fixed, displacement, &count, message, sizeof message));
  CHECK(count == 3 && fixed[2] == -9);
  CHECK(fixed[0] == 1 && fixed[1] == 0);
  CHECK_NEAR(displacement[0], 0.25, 0.);
  CHECK_DONE(fuge_deck_get_supports(deck, 2, 5, node, direction, 0, NULL, NULL, &count, NULL, 0));
  CHECK_INT(count, 3);
  CHECK_STATUS(fuge_deck_get_supports(deck, 3, 5, node, direction, 0, NULL, NULL, &count, message, sizeof message),
               FUGE_ERR_SIZE);
  CHECK_STRING(message, "the deck has no load case 3");
  CHECK_STATUS(fuge_deck_get_supports(deck, 0, 5, node, direction, 0, NULL, NULL, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_make_links(deck, 0, node, direction, &made, NULL, 0), FUGE_ERR_SIZE);
  CHECK_STATUS(fuge_deck_make_links(NULL, 5, node, direction, &made, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_make_links(deck, 5, node, direction, NULL, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_make_links(deck, 4, node, direction, &made, message, sizeof message), FUGE_ERR_DOF);
  CHECK_CONTAINS(message, "the matrix has no row of node 2, direction 3, but SUBCASE 7 has no support there");
  CHECK(made == NULL);
  CHECK_STATUS(fuge_deck_get_loads(deck, 5, NULL, direction, loads, NULL, 0), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_get_links(NULL, a, b, along, gap, play, compliance, limit), FUGE_ERR_POINTER);
  fuge_deck_free(&deck);
  CHECK(deck == NULL);
  fuge_deck_free(&deck);
  fuge_deck_free(NULL);
}

static void test_refused(void) {
  fuge_deck *deck = NULL;
  char message[256] = "old";
  write_file(NAME, "GRID,1\nPGAP,5,x\n");
  CHECK_STATUS(fuge_read_deck(NAME, &deck, message, sizeof message), FUGE_ERR_FILE);
  CHECK_STRING(message, "\"api_decks_scratch\", line 2, PGAP 5: U0: \"X\" is not a number");
  CHECK(deck == NULL);
  CHECK_STATUS(fuge_read_deck(NAME, NULL, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_read_deck(NULL, &deck, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_create(NULL), FUGE_ERR_POINTER);
  CHECK_DONE(fuge_deck_create(&deck));
  CHECK_STATUS(fuge_deck_read_links(deck, "no_such_file", message, sizeof message), FUGE_ERR_FILE);
  CHECK_STATUS(fuge_deck_read_cases(NULL, NAME, message, sizeof message), FUGE_ERR_POINTER);
  CHECK_STATUS(fuge_deck_read_supports(deck, NULL, message, sizeof message), FUGE_ERR_POINTER);
  fuge_deck_free(&deck);
}

int main(void) {
  test_deck();
  test_refused();
  return check_summary();
}
