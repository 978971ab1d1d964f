/* Threads for work that can be done in parts, which Fortran 2008 does not have.
 *
 * A thread begins a team, and until it ends it, its work is shared by the members of the team: itself, and threads that
 * wait for work in between. They start with the first work, so that a team that has none costs nothing. A process that
 * has been forked has only the thread that forked: there, as without a team, that one does all the work. */
#if defined(__linux__)
#define _GNU_SOURCE
#endif
#include <stdlib.h>
#if defined(_WIN32)
#include <windows.h>
#else
#include <pthread.h>
#include <sched.h>
#include <sys/types.h>
#include <unistd.h>
#endif

typedef void (*fuge_task)(int part, int parts, void *data);

typedef struct team team;

typedef struct {
  team *team;
  int number;
#if defined(_WIN32)
  HANDLE thread;
#else
  pthread_t thread;
#endif
} member;

struct team {
  int threads;
  team *outer;
  fuge_task task;
  int parts;
  void *data;
  member *others;
  /* Members that have started, the one that began the team included. */
  int started;
#if !defined(_WIN32)
  pid_t process;
  pthread_mutex_t mutex;
  pthread_cond_t begun, done;
  /* The number of the present work, and of members that are still at it. */
  unsigned work;
  int busy;
  int leaving;
#endif
};

/* The team of each thread: none where it has begun none, and none while it does its part of some work. */
static _Thread_local team *current;

/* Do the parts of a member: its own, and those for which there are no members. */
static void do_parts(const team *t, int number)
{
  int part;

  for (part = number; part < t->parts; part += t->started) t->task(part, t->parts, t->data);
}

#if defined(_WIN32)

static DWORD WINAPI run_member(LPVOID argument)
{
  const member *m = argument;

  do_parts(m->team, m->number);
  return 0;
}

/* Threads of their own for each work. */
static void share_work(team *t)
{
  HANDLE started[MAXIMUM_WAIT_OBJECTS];
  int k, most = t->threads;

  if (most > t->parts) most = t->parts;
  if (most > MAXIMUM_WAIT_OBJECTS) most = MAXIMUM_WAIT_OBJECTS;
  t->started = most;
  for (k = 1; k < most; ++k) {
    t->others[k - 1].team = t;
    t->others[k - 1].number = k;
    started[k] = CreateThread(NULL, 0, run_member, &t->others[k - 1], 0, NULL);
  }
  do_parts(t, 0);
  for (k = 1; k < most; ++k) {
    if (started[k] != NULL) {
      WaitForSingleObject(started[k], INFINITE);
      CloseHandle(started[k]);
    } else {
      do_parts(t, k);
    }
  }
}

static int can_share(const team *t) { return t->others != NULL; }

static void open_team(team *t) { (void)t; }

static void close_team(team *t) { (void)t; }

int fuge_usable_threads(void)
{
  SYSTEM_INFO system;

  GetSystemInfo(&system);
  return system.dwNumberOfProcessors > 1 ? (int)system.dwNumberOfProcessors : 1;
}

#else

/* Looks at a number that is about to change before a thread sleeps, which takes longer. */
#define LOOKS 1000

static void rest(void)
{
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/* Wait for work that is not number `last`; its number. */
static unsigned wait_for_work(team *t, unsigned last)
{
  unsigned work;
  int k;

  for (k = 0; k < LOOKS; ++k) {
    work = __atomic_load_n(&t->work, __ATOMIC_ACQUIRE);
    if (work != last) return work;
    rest();
  }
  pthread_mutex_lock(&t->mutex);
  while ((work = __atomic_load_n(&t->work, __ATOMIC_ACQUIRE)) == last) pthread_cond_wait(&t->begun, &t->mutex);
  pthread_mutex_unlock(&t->mutex);
  return work;
}

static void *run_member(void *argument)
{
  const member *m = argument;
  team *t = m->team;
  unsigned work = 0;

  for (;;) {
    work = wait_for_work(t, work);
    if (t->leaving) return NULL;
    do_parts(t, m->number);
    if (__atomic_sub_fetch(&t->busy, 1, __ATOMIC_ACQ_REL) == 0) {
      pthread_mutex_lock(&t->mutex);
      pthread_cond_signal(&t->done);
      pthread_mutex_unlock(&t->mutex);
    }
  }
}

static void open_team(team *t)
{
  pthread_mutex_init(&t->mutex, NULL);
  pthread_cond_init(&t->begun, NULL);
  pthread_cond_init(&t->done, NULL);
}

static void start_members(team *t)
{
  int k;

  t->process = getpid();
  for (k = 1; k < t->threads; ++k) {
    t->others[k - 1].team = t;
    t->others[k - 1].number = k;
    if (pthread_create(&t->others[k - 1].thread, NULL, run_member, &t->others[k - 1]) != 0) break;
  }
  t->started = k;
}

/* Tell the members that there is work, or that they leave. */
static void call_members(team *t)
{
  pthread_mutex_lock(&t->mutex);
  __atomic_store_n(&t->busy, t->started - 1, __ATOMIC_RELEASE);
  __atomic_store_n(&t->work, t->work + 1, __ATOMIC_RELEASE);
  pthread_cond_broadcast(&t->begun);
  pthread_mutex_unlock(&t->mutex);
}

static void share_work(team *t)
{
  int k;

  call_members(t);
  do_parts(t, 0);
  for (k = 0; k < LOOKS; ++k) {
    if (__atomic_load_n(&t->busy, __ATOMIC_ACQUIRE) == 0) return;
    rest();
  }
  pthread_mutex_lock(&t->mutex);
  while (__atomic_load_n(&t->busy, __ATOMIC_ACQUIRE) > 0) pthread_cond_wait(&t->done, &t->mutex);
  pthread_mutex_unlock(&t->mutex);
}

static int can_share(team *t)
{
  if (t->others == NULL) return 0;
  if (t->started == 0) start_members(t);
  return t->started > 1 && t->process == getpid();
}

static void close_team(team *t)
{
  int k;

  if (t->started > 1 && t->process != getpid()) return;
  if (t->started > 1) {
    t->leaving = 1;
    call_members(t);
    for (k = 1; k < t->started; ++k) pthread_join(t->others[k - 1].thread, NULL);
  }
  pthread_cond_destroy(&t->done);
  pthread_cond_destroy(&t->begun);
  pthread_mutex_destroy(&t->mutex);
}

/* How many cores this process may use. */
int fuge_usable_threads(void)
{
  long count;
#if defined(__linux__)
  cpu_set_t cores;

  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return CPU_COUNT(&cores) > 1 ? CPU_COUNT(&cores) : 1;
#endif
  count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 1 ? (int)count : 1;
}

#endif

/* Let up to `threads` threads share the work of this one until fuge_end_team; NULL without memory. */
void *fuge_begin_team(int threads)
{
  team *t = calloc(1, sizeof *t);

  if (t == NULL) return NULL;
  t->threads = threads;
  if (threads > 1) t->others = calloc((size_t)threads - 1, sizeof *t->others);
  open_team(t);
  t->outer = current;
  current = t;
  return t;
}

/* End the team that this thread began last. */
void fuge_end_team(void *begun)
{
  team *t = begun;

  if (t == NULL) return;
  current = t->outer;
  close_team(t);
  free(t->others);
  free(t);
}

/* How many threads share the work of this one. */
int fuge_threads_here(void) { return current == NULL || current->others == NULL ? 1 : current->threads; }

/* Do the parts 0 .. parts - 1 of a task, at once as far as there are members of the team, and wait for them. */
void fuge_run_in_threads(int parts, fuge_task task, void *data)
{
  team *t = current;
  int part;

  /* A part that has parts of its own does them alone. */
  current = NULL;
  if (t == NULL || parts < 2 || !can_share(t)) {
    for (part = 0; part < parts; ++part) task(part, parts, data);
  } else {
    t->task = task;
    t->parts = parts;
    t->data = data;
    share_work(t);
  }
  current = t;
}
