/* Files that the tests of this folder write. */
#ifndef SCRATCH_H
#define SCRATCH_H

#include "check.h"

/* An existing file is replaced. */
static inline void write_file(const char *name, const char *content) {
  FILE *file = fopen(name, "wb");
  CHECK(file != NULL);
  if (file == NULL) return;
  fputs(content, file);
  fclose(file);
}

#endif
