/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols that glibc 2.28 does not have, but that headers and libstdc++ of later systems use: see old_glibc.py. */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

struct stat;

/* Since 2.32. False: the reference counts of libstdc++ are always atomic. */
char __libc_single_threaded = 0;

/* Since 2.33; before, headers called these functions. The number is that of the structure's layout. */
#ifdef __x86_64__
enum { layout = 1 };
#else
enum { layout = 0 };
#endif
int __xstat(int version, const char* path, struct stat* result);
int __lxstat(int version, const char* path, struct stat* result);
int __fxstat(int version, int descriptor, struct stat* result);
int __fxstatat(int version, int folder, const char* path, struct stat* result, int flags);

int stat(const char* path, struct stat* result)
{
  return __xstat(layout, path, result);
}

int lstat(const char* path, struct stat* result)
{
  return __lxstat(layout, path, result);
}

int fstat(int descriptor, struct stat* result)
{
  return __fxstat(layout, descriptor, result);
}

int fstatat(int folder, const char* path, struct stat* result, int flags)
{
  return __fxstatat(layout, folder, path, result, flags);
}

/* On 64-bit systems the same. */
int fstat64(int descriptor, struct stat* result)
{
  return __fxstat(layout, descriptor, result);
}

int stat64(const char* path, struct stat* result)
{
  return __xstat(layout, path, result);
}

/* Since 2.30. */
int pthread_cond_clockwait(
  pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const struct timespec* until)
{
  struct timespec now;
  struct timespec real;
  if (clock_gettime(clock, &now) != 0 || clock_gettime(CLOCK_REALTIME, &real) != 0)
  {
    return EINVAL;
  }
  real.tv_sec += until->tv_sec - now.tv_sec;
  real.tv_nsec += until->tv_nsec - now.tv_nsec;
  if (real.tv_nsec < 0)
  {
    real.tv_nsec += 1000000000;
    --real.tv_sec;
  }
  else if (real.tv_nsec >= 1000000000)
  {
    real.tv_nsec -= 1000000000;
    ++real.tv_sec;
  }
  return pthread_cond_timedwait(condition, mutex, &real);
}

/* Since 2.36. */
unsigned arc4random(void)
{
  unsigned number;
  if (getentropy(&number, sizeof number) != 0)
  {
    abort();
  }
  return number;
}

/* Since 2.38: the functions of C23, which also read binary numbers. Text files here have none. */
long __isoc23_strtol(const char* text, char** end, int base)
{
  return strtol(text, end, base);
}

unsigned long __isoc23_strtoul(const char* text, char** end, int base)
{
  return strtoul(text, end, base);
}

long long __isoc23_strtoll(const char* text, char** end, int base)
{
  return strtoll(text, end, base);
}

unsigned long long __isoc23_strtoull(const char* text, char** end, int base)
{
  return strtoull(text, end, base);
}
