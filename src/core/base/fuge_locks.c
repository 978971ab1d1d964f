/* Locks for the whole process, which Fortran 2008 does not have; fuge_locks.f90 gives their numbers. */
#if defined(_WIN32)

#include <windows.h>

static SRWLOCK locks[6] = {SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT, SRWLOCK_INIT};

void fuge_lock(int which) { AcquireSRWLockExclusive(&locks[which]); }

void fuge_unlock(int which) { ReleaseSRWLockExclusive(&locks[which]); }

#else

#include <pthread.h>

static pthread_mutex_t locks[6] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER,
                                   PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};
static pthread_once_t fork_once = PTHREAD_ONCE_INIT;

/* A process waits with its fork until no thread holds a lock: a child has none of those threads, and what they were
 * changing would stay half done.  Kernels are computed while the grids are locked, and plans are made meanwhile, hence
 * those first. */
static const int order[6] = {2, 5, 0, 1, 3, 4};

static void acquire_all(void)
{
  int k;

  for (k = 0; k < 6; ++k) pthread_mutex_lock(&locks[order[k]]);
}

static void release_all(void)
{
  int k;

  for (k = 5; k >= 0; --k) pthread_mutex_unlock(&locks[order[k]]);
}

static void prepare_forks(void) { pthread_atfork(acquire_all, release_all, release_all); }

void fuge_lock(int which)
{
  pthread_once(&fork_once, prepare_forks);
  pthread_mutex_lock(&locks[which]);
}

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
