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
