/* fuge.h needs no other header and may be included twice; CMakeLists.txt adds a file for each header alone. */
#include "fuge.h"
#include "fuge.h"

int main(void) {
  fuge_options options;
  fuge_info info = {FUGE_DONE, 0, 0, 0, 0, {0}, 0.0, 0.0, 0.0, {0.0}};
  size_t size = sizeof options;
  fuge_default_options(&options);
  return options.method == FUGE_AUTO && info.status == FUGE_DONE && size > 0 ? 0 : 1;
}
