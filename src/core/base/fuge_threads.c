/* Threads for work that can be done in parts, which Fortran 2008 does not have. */
#include <stdlib.h>
#if defined(_WIN32)
#include <windows.h>
typedef HANDLE thread_handle;
#else
#include <pthread.h>
typedef pthread_t thread_handle;
#endif

typedef void (*fuge_task)(int part, int parts, void *data);

typedef struct {
  fuge_task task;
  int part, parts;
  void *data;
  int started;
  thread_handle thread;
} share;

#if defined(_WIN32)

static DWORD WINAPI run_share(LPVOID argument)
{
  share *s = argument;

  s->task(s->part, s->parts, s->data);
  return 0;
}

static int start(share *s)
{
  s->thread = CreateThread(NULL, 0, run_share, s, 0, NULL);
  return s->thread != NULL;
}

static void wait_for(share *s)
{
  WaitForSingleObject(s->thread, INFINITE);
  CloseHandle(s->thread);
}

#else

static void *run_share(void *argument)
{
  share *s = argument;

  s->task(s->part, s->parts, s->data);
  return NULL;
}

static int start(share *s) { return pthread_create(&s->thread, NULL, run_share, s) == 0; }

static void wait_for(share *s) { pthread_join(s->thread, NULL); }

#endif

/* Do the parts 0 .. parts - 1 of a task at once, each in a thread of its own. A part whose thread cannot be started is
 * done here. */
void fuge_run_in_threads(int parts, fuge_task task, void *data)
{
  share *shares = parts > 1 ? malloc((size_t)parts * sizeof *shares) : NULL;
  int k;

  if (shares == NULL) {
    for (k = 0; k < parts; ++k) task(k, parts, data);
    return;
  }
  for (k = 1; k < parts; ++k) {
    shares[k].task = task;
    shares[k].part = k;
    shares[k].parts = parts;
    shares[k].data = data;
    shares[k].started = start(&shares[k]);
  }
  task(0, parts, data);
  for (k = 1; k < parts; ++k) {
    if (shares[k].started)
      wait_for(&shares[k]);
    else
      task(k, parts, data);
  }
  free(shares);
}

/* Jobs that lie one after the other in memory, `bytes` each. */
typedef struct {
  void *(*work)(char *job);
  char *first;
  size_t bytes;
} job_list;

static void run_job(int part, int parts, void *data)
{
  const job_list *jobs = data;

  (void)parts;
  jobs->work(jobs->first + (size_t)part * jobs->bytes);
}

/* Do `count` jobs at once, as FFTW calls it. */
void fuge_run_jobs(void *(*work)(char *job), char *first, size_t bytes, int count, void *unused)
{
  job_list jobs;

  (void)unused;
  jobs.work = work;
  jobs.first = first;
  jobs.bytes = bytes;
  fuge_run_in_threads(count, run_job, &jobs);
}

/* Let every child that this process forks begin with `action`: that of the first call, later ones change nothing.
 * Calls must not overlap. */
void fuge_begin_children_with(void (*action)(void))
{
#if defined(_WIN32)
  (void)action;
#else
  static int registered;

  if (!registered) registered = pthread_atfork(NULL, NULL, action) == 0;
#endif
}
