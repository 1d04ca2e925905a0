#pragma once

#include <cstdio>
#include <cstdlib>

/// Stops the program when a promise inside the code is broken; on in Debug and sanitizer builds
/// only.
#ifdef ZSKEL_CHECKED
#define ZSKEL_ASSERT(cond, why)                                                             \
    do {                                                                                    \
        if (!(cond)) {                                                                      \
            std::fprintf(stderr, "%s:%d: broken promise: %s\n", __FILE__, __LINE__, (why)); \
            std::abort();                                                                   \
        }                                                                                   \
    } while (false)
#else
#define ZSKEL_ASSERT(cond, why) static_cast<void>(0)
#endif
