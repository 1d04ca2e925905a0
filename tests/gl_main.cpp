// Tests that need a GL context: skipped (exit 77) without one, unless ZSKEL_REQUIRE_GL=1 makes that
// a failure.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "zskel/gl/context.h"

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]).starts_with("--list")) return context.run();
    }
    std::vector<zskel::gl::FailedAttempt> failed;
    if (zskel::gl::open_context({}, failed) == nullptr) {
        for (const auto& attempt : failed) {
            std::fprintf(stderr, "%s: %s\n", attempt.candidate.c_str(), attempt.reason.c_str());
        }
        const char* required = std::getenv("ZSKEL_REQUIRE_GL");
        return required != nullptr && std::string_view(required) == "1" ? 1 : 77;
    }
    return context.run();
}
