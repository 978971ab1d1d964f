/* The memory of the machine, which Fortran does not know. */
#if defined(_WIN32)

#include <windows.h>

double fuge_physical_memory(void)
{
  MEMORYSTATUSEX status;

  status.dwLength = sizeof status;
  return GlobalMemoryStatusEx(&status) ? (double)status.ullTotalPhys : 0.0;
}

#else

#include <unistd.h>

double fuge_physical_memory(void)
{
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
  long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);

  if (pages > 0 && size > 0) return (double)pages * (double)size;
#endif
  return 0.0;
}

#endif
