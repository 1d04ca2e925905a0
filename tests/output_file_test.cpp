#include "zskel/io/output_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "zskel/core/error.h"

using namespace zskel;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("zskel_output_test_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string at(const char* name) const { return (path / name).string(); }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(path), fs::directory_iterator{}));
    }
};

std::string content(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("write_output_text: the file is whole, and nothing else is left") {
    const Folder folder;
    write_output_text(folder.at("a.json"), "first");
    write_output_text(folder.at("a.json"), "second");
    CHECK(content(folder.at("a.json")) == "second");
    CHECK(folder.files() == 1);
}

TEST_CASE("write_output_file: a failure half-way leaves the old file and no other") {
    const Folder folder;
    write_output_text(folder.at("a.json"), "old");
    CHECK_THROWS_AS(write_output_file(folder.at("a.json"),
                                      [](const std::string& temporary) {
                                          std::ofstream(temporary) << "half";
                                          throw InputError("stop");
                                      }),
                    InputError);
    CHECK(content(folder.at("a.json")) == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE(
    "write_output_file: the temporary file keeps the extension and is removed on a signal's "
    "behalf") {
    const Folder folder;
    CHECK_THROWS_AS(write_output_file(folder.at("map.exr"),
                                      [&](const std::string& temporary) {
                                          CHECK(fs::path(temporary).extension() == ".exr");
                                          std::ofstream(temporary) << "half";
                                          CHECK(folder.files() == 1);
                                          remove_unfinished_files();
                                          CHECK(folder.files() == 0);
                                      }),
                    IoError);
    CHECK(folder.files() == 0);
}

TEST_CASE("write_output_text: a folder that is not there is an error that names the path") {
    CHECK_THROWS_WITH_AS(write_output_text("/nonexistent/zskel/a.json", "x"),
                         doctest::Contains("/nonexistent/zskel/a.json"), IoError);
}

TEST_CASE("write_output_text: a pipe is written to, never replaced; a link stays a link") {
    const Folder folder;
    REQUIRE(::mkfifo(folder.at("pipe").c_str(), 0600) == 0);
    std::string read;
    std::thread reader([&] { read = content(folder.at("pipe")); });
    write_output_text(folder.at("pipe"), "through");
    reader.join();
    CHECK(read == "through");
    CHECK(fs::is_fifo(folder.at("pipe")));
    write_output_text(folder.at("a.json"), "old");
    fs::create_symlink("a.json", folder.at("link.json"));
    write_output_text(folder.at("link.json"), "new");
    CHECK(fs::is_symlink(folder.at("link.json")));
    CHECK(content(folder.at("a.json")) == "new");
}
