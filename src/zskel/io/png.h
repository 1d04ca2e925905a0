#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace zskel {

/// An 8-bit sRGB picture: rows from the top down, `channels` bytes a pixel.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 3;                  ///< 3 (RGB) or 4 (RGBA)
    std::vector<std::uint8_t> pixels;  ///< width * height * channels

    const std::uint8_t* at(int column, int row) const {
        return pixels.data() + (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(column)) *
                                   static_cast<std::size_t>(channels);
    }
};

/// A picture of one colour.
Image make_image(int width, int height, int channels, std::uint8_t value);

/// The bytes of a PNG with the text chunks Title and Software; nothing in it depends on the time.
std::string encode_png(const Image& image, const std::string& title);

/// Writes them to a file; "-" is standard output.
/// @throws IoError naming the path.
void write_png(const std::string& path, const Image& image, const std::string& title);

/// Reads an 8-bit RGB or RGBA PNG. @throws InputError naming the path.
Image read_png(const std::string& path);

}  // namespace zskel
