// Which source Auto takes.
#include "zskel/visibility/choose.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/shapes.h"
#include "zskel/extract.h"

using namespace zskel;
namespace fs = std::filesystem;

TEST_CASE("choose: a GPU is known by its device file") {
    const fs::path dev = fs::temp_directory_path() / "zskel_choose_test";
    for (const char* file : {"nvidia0", "nvidiactl", "dxg", "dri/renderD128"}) {
        fs::remove_all(dev);
        CHECK(!has_gpu_device(dev));
        fs::create_directories((dev / file).parent_path());
        std::ofstream(dev / file) << "";
        CHECK(has_gpu_device(dev));
    }
    fs::remove_all(dev);
}

TEST_CASE("choose: one small mesh stays on the CPU, large work goes to a GPU, if there is one") {
    const Workload small{2000, 5000};
    const Workload large{128000, 3000000};
    CHECK(!choose_source(small, 8, 2, true).is_gpu);
    CHECK(choose_source(large, 16, 2, true).is_gpu);
    CHECK(!choose_source(large, 16, 2, false).is_gpu);
    CHECK(!choose_source(large, 64, 2, true).is_gpu);  // not reduced there
    CHECK(!choose_source({}, 16, 2, true).is_gpu);
    // The prediction decides, and more threads are for the CPU.
    for (const int threads : {1, 2, 16, 256}) {
        const bool pays = predicted_gpu_seconds(large) < predicted_cpu_seconds(large, 16, threads);
        CHECK(choose_source(large, 16, threads, true).is_gpu == pays);
    }
    CHECK(predicted_cpu_seconds(large, 16, 4) < predicted_cpu_seconds(large, 16, 2));
    CHECK(!choose_source(small, 8, 2, true).reason.empty());
    // One of many that use the same context.
    CHECK(choose_source({2000, 5000, 0.01}, 8, 2, true).is_gpu);
}

TEST_CASE("backend auto: takes the CPU here, says why, and loads no driver") {
    const Mesh mesh = test::cube();
    BackendOptions options = backend_options_for(mesh, {}, {});
    CHECK(options.face_px == 10);
    CHECK(options.work.faces == 12);
    CHECK(options.work.evaluations > 0);
    ExtractOptions paper;
    paper.method = Method::Paper;
    CHECK(backend_options_for(mesh, paper, {}).face_px == 16);
    options.face_px = 4;
    CHECK(backend_options_for(mesh, {}, options).face_px == 4);
    const auto backend = open_backend(options);
    CHECK(backend->info().name == "cpu");  // whatever there is: this is too little work for a GPU
    CHECK(!backend->info().reason.empty());
    std::ifstream maps("/proc/self/maps");
    const std::string loaded(std::istreambuf_iterator<char>(maps), {});
    REQUIRE(!loaded.empty());
    for (const char* library : {"libEGL", "libOSMesa", "libLLVM", "libnvidia", "libGL"}) {
        CAPTURE(library);
        CHECK(loaded.find(library) == std::string::npos);
    }
}
