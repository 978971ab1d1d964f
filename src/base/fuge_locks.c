/* Locks for the whole process, which Fortran 2008 does not have; fuge_locks.f90 gives their numbers. */
#if defined(_WIN32)

#include <windows.h>

static SRWLOCK locks[5] = {SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT};

void fuge_lock(int which) { AcquireSRWLockExclusive(&locks[which]); }

void fuge_unlock(int which) { ReleaseSRWLockExclusive(&locks[which]); }

#else

#include <pthread.h>

static pthread_mutex_t locks[5] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER,
                                   PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};

void fuge_lock(int which) { pthread_mutex_lock(&locks[which]); }

void fuge_unlock(int which) { pthread_mutex_unlock(&locks[which]); }

#endif

/* The last number of fuge_new_stamp, under a lock of its own. */
static long long last_stamp;

long long fuge_new_stamp(void)
{
  long long stamp;

  fuge_lock(3);
  stamp = ++last_stamp;
  fuge_unlock(3);
  return stamp;
}
