// Bodies of a parallel loop that write to one place: ThreadSanitizer must say so, or it would say
// nothing of a race of ours either.
#include <cstdio>

#include "zskel/core/parallel.h"

int main() {
    long sum = 0;
    zskel::parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (int k = 0; k < 1000; ++k) sum += static_cast<long>(i);
        }
    });
    std::printf("%ld\n", sum);
}
