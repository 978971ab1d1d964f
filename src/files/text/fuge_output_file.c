/* A file that is written and closed without fail: on a full disk gfortran's run-time library keeps the
 * descriptor and the buffer of a file whose close has failed.  fuge_text_writer.f90 has the interfaces. And
 * what can be read as a whole, for fuge_text_reader.f90. */
#define _XOPEN_SOURCE 600
#include "written_file.h"
#if !defined(_WIN32)
#include <sys/stat.h>
#endif

/* Create or replace the file at `path`; NULL, and *error is not 0, if it cannot be opened. */
void *fuge_output_create(const char *path, int *error)
{
  FILE *file = open_anew(path, error);

  /* The caller has a buffer. */
  if (file != NULL) setvbuf(file, NULL, _IONBF, 0);
  return file;
}

/* Write so many bytes; 0 or the error. */
int fuge_output_write(void *file, const char *bytes, size_t count)
{
  errno = 0;
  return fwrite(bytes, 1, count, file) == count ? 0 : failure();
}

/* Close the file, which is released in any case; 0 or the error. */
int fuge_output_close(void *file) { return close_written(file); }

/* Empty a file that is not complete, so that nothing takes it for a whole one.  A device or a pipe stays as it is. */
void fuge_output_empty(const char *path) { empty_incomplete(path); }

/* Why: the text of an error, cut or padded with blanks to `length` characters. */
void fuge_output_reason(int error, char *text, size_t length) { copy_reason(error, text, length); }

/* Is there anything other than a regular file at `path`: a device, a pipe, a folder?  Their size may be unknown or
 * unbounded. */
int fuge_input_is_special(const char *path)
{
#if defined(_WIN32)
  (void)path;
  return 0;
#else
  struct stat found;

  return stat(path, &found) == 0 && !S_ISREG(found.st_mode);
#endif
}
