#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/gl/api.h"
#include "zskel/gl/context.h"
#include "zskel/gl/program.h"
#include "zskel/io/picture.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/backend.h"

using namespace zskel;

namespace {

std::unique_ptr<gl::Context> any_context() {
    std::vector<gl::FailedAttempt> failed;
    return gl::open_context({}, failed);
}

}  // namespace

TEST_CASE(
    "diagnose_contexts: every candidate either works with what it says of itself, or has a "
    "reason") {
    const auto all = gl::diagnose_contexts({});
    CHECK_FALSE(all.empty());
    for (const gl::Diagnosis& found : all) {
        if (found.usable) {
            CHECK_FALSE(found.info.renderer.empty());
            CHECK(found.info.max_layers >= 256);
        } else {
            CHECK_FALSE(found.reason.empty());
        }
    }
}

TEST_CASE("open_context: EGL and OSMesa live side by side, and close in any order") {
    std::vector<gl::FailedAttempt> failed;
    gl::ContextRequest only_osmesa{.hardware = false, .software = false};
    auto first = gl::open_context(only_osmesa, failed);
    auto second = any_context();
    REQUIRE(second != nullptr);
    if (first != nullptr) CHECK(first->info().kind == gl::ContextKind::Osmesa);
    first.reset();
    int major = 0;
    second->run("asking", [&](const gl::Api& gl) { gl.GetIntegerv(GL_MAJOR_VERSION, &major); });
    CHECK(major >= 4);
}

TEST_CASE("open_context: a hardware device that is not there is not replaced by another") {
    std::vector<gl::FailedAttempt> failed;
    gl::ContextRequest request;
    request.gpu = 99;
    CHECK(gl::open_context(request, failed) == nullptr);
    CHECK_FALSE(failed.empty());
    BackendOptions options;
    options.gpu = 99;
    CHECK_THROWS_AS(open_backend(options), GlError);
}

TEST_CASE(
    "Context: a failed pass throws with its stage and the error's name, and the next one is fine") {
    const auto context = any_context();
    CHECK_THROWS_WITH_AS(context->run("a bad pass", [](const gl::Api& gl) { gl.Enable(0x1); }),
                         doctest::Contains("a bad pass failed with GL_INVALID_ENUM"), GlError);
    CHECK_NOTHROW(context->run("a good pass", [](const gl::Api& gl) { gl.Finish(); }));
}

TEST_CASE("Context: out of memory is an error with its stage, and what fits is drawn after it") {
    const auto context = any_context();
    // Some drivers look for memory when it is first wanted.
    const auto terabytes = [](const gl::Api& gl) {
        constexpr GLsizeiptr kBytes = GLsizeiptr{1} << 45;
        GLuint buffer = 0;
        gl.CreateBuffers(1, &buffer);
        gl.NamedBufferStorage(buffer, kBytes, nullptr, GL_MAP_READ_BIT);
        gl.MapNamedBufferRange(buffer, 0, kBytes, GL_MAP_READ_BIT);
        gl.DeleteBuffers(1, &buffer);
    };
    if (context->info().kind == gl::ContextKind::EglHardware) {
        MESSAGE("drivers of GPUs promise any size (an H200's does)");
        return;
    }
    CHECK_THROWS_WITH_AS(context->run("a vast buffer", terabytes),
                         doctest::Contains("a vast buffer failed with GL_OUT_OF_MEMORY"), GlError);
    const PreparedSurface ball = prepare_surface(test::sphere(1.0, 2));
    const Image image = draw_skeleton(*context, ball.surface, {}, {64, 48, std::nullopt});
    CHECK(*image.at(32, 24) < 250);
    CHECK(*image.at(0, 0) == 255);
}

TEST_CASE("Context: a lost one says so from then on, and a new one works") {
    const auto context = any_context();
    const auto reset_gpu = [](const gl::Api& gl) {
        const_cast<gl::Api&>(gl).GetGraphicsResetStatus = []() -> GLenum {
            return GL_INNOCENT_CONTEXT_RESET;
        };
    };
    CHECK_THROWS_WITH_AS(context->run("a reset", reset_gpu),
                         doctest::Contains("was lost: the GPU was reset for what another"),
                         GlError);
    bool has_run = false;
    CHECK_THROWS_WITH_AS(context->run("the next", [&](const gl::Api&) { has_run = true; }),
                         doctest::Contains("the next: the context was lost before"), GlError);
    CHECK_FALSE(has_run);
    CHECK_NOTHROW(any_context()->run("anew", [](const gl::Api& gl) { gl.Finish(); }));
}

TEST_CASE("Context: what the work throws comes back, from any thread") {
    const auto context = any_context();
    CHECK_THROWS_AS(context->run("throwing", [](const gl::Api&) { throw InputError("mine"); }),
                    InputError);
    std::thread([&] {
        CHECK_NOTHROW(context->run("elsewhere", [](const gl::Api& gl) { gl.Finish(); }));
    }).join();
}

TEST_CASE("build_program: an error names the shader file and holds the driver's log") {
    const auto context = any_context();
    const auto build = [](const gl::Api& gl) {
        gl::build_program(
            gl, {{GL_VERTEX_SHADER, "broken.vert", "#version 450 core\nvoid main() { nothing; }"}});
    };
    CHECK_THROWS_WITH_AS(context->run("building", build), doctest::Contains("broken.vert"),
                         GlError);
}
