/* What Fortran does not know of files: which paths lead to the same one, and whether all that was written is there.
 * file_access.f90 has the interfaces. */
#define _XOPEN_SOURCE 700
#include "../../files/text/written_file.h"
#include <stdlib.h>
#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#else
#include <sys/stat.h>
#endif

#if defined(_WIN32)

typedef BY_HANDLE_FILE_INFORMATION identity;

static int identify(const char *path, identity *found)
{
  HANDLE file = path[0] == '\0' ? (HANDLE)_get_osfhandle(1)
                                : CreateFileA(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                                              OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
  int known = file != INVALID_HANDLE_VALUE && GetFileType(file) == FILE_TYPE_DISK &&
              GetFileInformationByHandle(file, found);

  if (path[0] != '\0' && file != INVALID_HANDLE_VALUE) CloseHandle(file);
  return known;
}

static int equal(const identity *a, const identity *b)
{
  return a->dwVolumeSerialNumber == b->dwVolumeSerialNumber && a->nFileIndexHigh == b->nFileIndexHigh &&
         a->nFileIndexLow == b->nFileIndexLow;
}

static int is_special(const char *path)
{
  (void)path;
  return 0;
}

static int is_endless(const char *path)
{
  (void)path;
  return 0;
}

static void remove_file(const char *path) { remove(path); }

#else

typedef struct stat identity;

/* Devices and pipes may be read and written at once. */
static int identify(const char *path, identity *found)
{
  return (path[0] == '\0' ? fstat(STDOUT_FILENO, found) : stat(path, found)) == 0 && S_ISREG(found->st_mode);
}

static int equal(const identity *a, const identity *b) { return a->st_dev == b->st_dev && a->st_ino == b->st_ino; }

static int is_special(const char *path)
{
  identity found;

  return stat(path, &found) == 0 && !S_ISREG(found.st_mode) && !S_ISDIR(found.st_mode);
}

static int is_endless(const char *path)
{
  identity found;

  return stat(path, &found) == 0 && !S_ISREG(found.st_mode) && !S_ISFIFO(found.st_mode);
}

/* The file at the end of the links, which stay. */
static void remove_file(const char *path)
{
  char *place = realpath(path, NULL);

  if (place != NULL) unlink(place);
  free(place);
}

#endif

/* Do two paths lead to one file, by links or by other names?  An empty path is standard output. */
int program_same_file(const char *path, const char *other)
{
  identity a, b;

  return identify(path, &a) && identify(other, &b) && equal(&a, &b);
}

/* Make the file at `path` if there is none, and leave an existing one as it is; 0 or the error. */
int program_prepare_file(const char *path, int *made)
{
  identity found;
  FILE *file;

  *made = 0;
  if (is_special(path)) return 0;
  *made = !identify(path, &found);
  errno = 0;
  file = fopen(path, "ab");
  if (file != NULL && fclose(file) == 0) return 0;
  *made = 0;
  return failure();
}

/* Is it a device or a folder, from which lines cannot be read up to an end? */
int program_is_endless(const char *path) { return is_endless(path); }

void program_remove_file(const char *path) { remove_file(path); }

/* Begin a file anew, or standard output if the path is empty; NULL, and *error is not 0, if it cannot be opened. */
void *program_open_table(const char *path, int *error)
{
  if (path[0] != '\0') return open_anew(path, error);
  *error = 0;
  return stdout;
}

/* Write a line; 0 or the error. */
int program_put_line(void *file, const char *line, size_t length)
{
  errno = 0;
  return fwrite(line, 1, length, file) == length && putc('\n', file) != EOF ? 0 : failure();
}

/* Write what is still in memory, and close the file in any case; 0 or the error. */
int program_close_table(void *file) { return close_written(file); }

/* Leave no part of a table that could be taken for the whole. */
void program_empty_file(const char *path) { empty_incomplete(path); }

/* The text of an error, cut or padded with blanks to `length` characters. */
void program_reason(int error, char *text, size_t length) { copy_reason(error, text, length); }
