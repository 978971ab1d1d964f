/* Locks for the whole process, which Fortran 2008 does not have; fuge_locks.f90 gives their numbers. */
#if defined(_WIN32)

#include <windows.h>

static SRWLOCK locks[3] = {SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT};

void fuge_lock(int which) { AcquireSRWLockExclusive(&locks[which]); }

void fuge_unlock(int which) { ReleaseSRWLockExclusive(&locks[which]); }

#else

#include <pthread.h>

static pthread_mutex_t locks[3] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};

void fuge_lock(int which) { pthread_mutex_lock(&locks[which]); }

void fuge_unlock(int which) { pthread_mutex_unlock(&locks[which]); }

#endif

/* A number that no earlier call in this process has returned, from 1 on. */
long long fuge_new_stamp(void)
{
  static long long last = 0;
  long long stamp;

  fuge_lock(2);
  stamp = ++last;
  fuge_unlock(2);
  return stamp;
}
