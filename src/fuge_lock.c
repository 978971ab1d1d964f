/* A lock for the whole process, which Fortran 2008 does not have. */
#if defined(_WIN32)

#include <windows.h>

static SRWLOCK lock = SRWLOCK_INIT;

void fuge_lock_planner(void) { AcquireSRWLockExclusive(&lock); }

void fuge_unlock_planner(void) { ReleaseSRWLockExclusive(&lock); }

#else

#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

void fuge_lock_planner(void) { pthread_mutex_lock(&lock); }

void fuge_unlock_planner(void) { pthread_mutex_unlock(&lock); }

#endif
