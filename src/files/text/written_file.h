/* What fuge_output_file.c and the program's file_access.c do alike with a file that is written.  The including file
 * defines _XOPEN_SOURCE before all headers. */
#ifndef FUGE_WRITTEN_FILE_H
#define FUGE_WRITTEN_FILE_H

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#if !defined(_WIN32)
#include <unistd.h>
#endif

/* errno, or another number than 0 where the C library does not set it. */
static int failure(void) { return errno != 0 ? errno : -1; }

/* Open the file at `path` to write it anew; NULL, and *error is not 0, if it cannot be opened. */
static FILE *open_anew(const char *path, int *error)
{
  FILE *file;

  errno = 0;
  file = fopen(path, "wb");
  *error = file == NULL ? failure() : 0;
  return file;
}

/* Write what is still in memory, and close the file, which is released in any case; 0 or the error. */
static int close_written(void *file)
{
  errno = 0;
  return fclose(file) == 0 ? 0 : failure();
}

/* Empty a file that is not complete, so that nothing takes it for a whole one.  A device or a pipe stays as it is. */
static void empty_incomplete(const char *path)
{
#if defined(_WIN32)
  FILE *file = fopen(path, "wb");

  if (file != NULL) fclose(file);
#else
  if (truncate(path, 0) != 0) errno = 0;
#endif
}

/* The text of an error, cut or padded with blanks to `length` characters. */
static void copy_reason(int error, char *text, size_t length)
{
  const char *reason = error > 0 ? strerror(error) : "unknown reason";
  size_t known = strlen(reason);

  if (known > length) known = length;
  memcpy(text, reason, known);
  memset(text + known, ' ', length - known);
}

#endif
