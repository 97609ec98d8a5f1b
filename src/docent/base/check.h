#pragma once

#include <cstdio>
#include <cstdlib>

/// Ends the process when a promise that this program made to itself is broken. Never for outside input, never on a
/// safety path.
#define DOCENT_CHECK(condition)                                                            \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "%s:%d: broken promise: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)
