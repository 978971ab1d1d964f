/* A file that is written and closed without fail: on a full disk gfortran's run-time library keeps the
 * descriptor and the buffer of a file whose close has failed.  fuge_text_writer.f90 has the interfaces. */
#define _XOPEN_SOURCE 600
#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#if !defined(_WIN32)
#include <unistd.h>
#endif

/* errno, or another number than 0 where the C library does not set it. */
static int failure(void) { return errno != 0 ? errno : -1; }

/* Create or replace the file at `path`; NULL, and *error is not 0, if it cannot be opened. */
void *fuge_output_create(const char *path, int *error)
{
  FILE *file;

  errno = 0;
  file = fopen(path, "wb");
  *error = file == NULL ? failure() : 0;
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

/* Write what is still in memory, and close the file, which is released in any case; 0 or the error. */
int fuge_output_close(void *file)
{
  errno = 0;
  return fclose(file) == 0 ? 0 : failure();
}

/* Empty a file that is not complete, so that nothing takes it for a whole one.  A device or a pipe stays as it is. */
void fuge_output_empty(const char *path)
{
#if defined(_WIN32)
  FILE *file = fopen(path, "wb");

  if (file != NULL) fclose(file);
#else
  if (truncate(path, 0) != 0) errno = 0;
#endif
}

/* Why: the text of an error, cut or padded with blanks to `length` characters. */
void fuge_output_reason(int error, char *text, size_t length)
{
  const char *reason = error > 0 ? strerror(error) : "unknown reason";
  size_t known = strlen(reason);

  if (known > length) known = length;
  memcpy(text, reason, known);
  memset(text + known, ' ', length - known);
}
