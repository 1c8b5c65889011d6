/* Expectations of tests in C: those that fail are printed and counted. */
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <swell.h>

static int faults = 0;

#define EXPECT(condition)                                                            \
  do {                                                                               \
    if (!(condition)) {                                                              \
      ++faults;                                                                      \
      printf("%s:%d: not so: %s (last error: %s)\n", __FILE__, __LINE__, #condition, \
             swell_last_error());                                                    \
    }                                                                                \
  } while (false)
