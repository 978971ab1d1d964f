/* A lock for the whole process: Fortran 2008 has none.  It stays inside the library. */
#if defined(_WIN32)

#include <windows.h>
static SRWLOCK lock = SRWLOCK_INIT;
void fuge_lock_planner(void) { AcquireSRWLockExclusive(&lock); }
void fuge_unlock_planner(void) { ReleaseSRWLockExclusive(&lock); }

#else

#include <pthread.h>
#if defined(__GNUC__)
__attribute__((visibility("hidden"))) void fuge_lock_planner(void);
__attribute__((visibility("hidden"))) void fuge_unlock_planner(void);
#else
void fuge_lock_planner(void);
void fuge_unlock_planner(void);
#endif
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
void fuge_lock_planner(void) { pthread_mutex_lock(&lock); }
void fuge_unlock_planner(void) { pthread_mutex_unlock(&lock); }

#endif
