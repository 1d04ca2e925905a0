#include "zskel/io/png.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "zskel/core/error.h"

using namespace zskel;

namespace {

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)).string();
}

std::string bytes_of(const std::string& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return all.str();
}

}  // namespace

TEST_CASE("write_png: RGB and RGBA come back exactly") {
    for (const int channels : {3, 4}) {
        Image image = make_image(13, 7, channels, 0);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            image.pixels[i] = static_cast<std::uint8_t>(i * 37 + 11);
        }
        const std::string path = temporary("_back.png");
        write_png(path, image, "a title");
        const Image back = read_png(path);
        CHECK(back.width == 13);
        CHECK(back.height == 7);
        CHECK(back.channels == channels);
        CHECK(back.pixels == image.pixels);
        const std::string bytes = bytes_of(path);
        CHECK(bytes.find("a title") != std::string::npos);
        CHECK(bytes.find("zskel ") != std::string::npos);
        write_png(path, image, "a title");
        CHECK(bytes_of(path) == bytes);
        std::filesystem::remove(path);
    }
}

TEST_CASE("write_png: a folder that is not there is an IoError that names it") {
    try {
        write_png("/no/such/folder/x.png", make_image(2, 2, 3, 0), "");
        FAIL("nothing was thrown");
    } catch (const IoError& error) {
        CHECK(std::string(error.what()).find("/no/such/folder/x.png") != std::string::npos);
    }
}

TEST_CASE("read_png: what is no PNG is an InputError") {
    const std::string path = temporary("_no.png");
    std::ofstream(path) << "not a picture";
    CHECK_THROWS_AS(read_png(path), InputError);
    std::filesystem::remove(path);
}
