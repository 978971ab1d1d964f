/* fuge.h needs no other header and may be included twice; CMakeLists.txt adds a file for each header alone. Structs
 * keep the sizes that doc/install.md promises, where pointers have eight bytes. */
#include "fuge.h"
#include "fuge.h"

static int has_promised_sizes(void) {
  if (sizeof(void *) != 8) return 1;
#ifdef FUGE_ACCURACY_H
  if (sizeof(fuge_pressing) != 176 || sizeof(fuge_resolved_report) != 448) return 0;
#endif
#ifdef FUGE_ELASTIC_H
  if (sizeof(fuge_stress_peak) != 160 || sizeof(fuge_interface_stress) != 96) return 0;
#endif
#ifdef FUGE_FE_H
  if (sizeof(fuge_link_law) != 96 || sizeof(fuge_member) != 96) return 0;
#endif
#ifdef FUGE_PUNCHES_H
  if (sizeof(fuge_punch_report) != 176) return 0;
#endif
  return sizeof(fuge_options) == 96 && sizeof(fuge_info) == 96;
}

int main(void) {
  fuge_options options;
  fuge_info info = {FUGE_DONE, 0, 0, 0, 0, {0}, 0.0, 0.0, 0.0, {0.0}};
  size_t size = sizeof options;
  fuge_default_options(&options);
  return options.method == FUGE_AUTO && info.status == FUGE_DONE && size > 0 && has_promised_sizes() ? 0 : 1;
}
