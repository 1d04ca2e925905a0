#include "zskel/io/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "zskel/core/assert.h"
#include "zskel/core/error.h"
#include "zskel/io/output_file.h"

namespace zskel {
namespace {

// Encoding goes to memory, where nothing of libpng's own can fail; files are written by
// write_output_text.
[[noreturn]] void on_error(png_structp /*png*/, png_const_charp text) {
    throw IoError(fmt::format("encoding a PNG: {}", text));
}
void on_warning(png_structp /*png*/, png_const_charp /*text*/) {}
void on_write(png_structp png, png_bytep data, std::size_t bytes) {
    static_cast<std::string*>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char*>(data), bytes);
}
void on_flush(png_structp /*png*/) {}

struct Writer {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
    png_infop info = png_create_info_struct(png);
    Writer() = default;
    ~Writer() { png_destroy_write_struct(&png, &info); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
};

}  // namespace

Image make_image(int width, int height, int channels, std::uint8_t value) {
    Image image{width, height, channels, {}};
    image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(channels),
                        value);
    return image;
}

std::string encode_png(const Image& image, const std::string& title) {
    ZSKEL_ASSERT(image.channels == 3 || image.channels == 4, "RGB or RGBA");
    std::string bytes;
    const Writer writer;
    png_set_write_fn(writer.png, &bytes, on_write, on_flush);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), 8,
                 image.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    std::string keys[] = {"Title", "Software"};
    std::string values[] = {title, "zskel " ZSKEL_VERSION};
    png_text text[2] = {};
    for (int i = 0; i < 2; ++i) {
        text[i].compression = PNG_TEXT_COMPRESSION_NONE;
        text[i].key = keys[i].data();
        text[i].text = values[i].data();
        text[i].text_length = values[i].size();
    }
    png_set_text(writer.png, writer.info, text, 2);
    png_write_info(writer.png, writer.info);
    for (int row = 0; row < image.height; ++row) png_write_row(writer.png, image.at(0, row));
    png_write_end(writer.png, nullptr);
    return bytes;
}

void write_png(const std::string& path, const Image& image, const std::string& title) {
    write_output_text(path, encode_png(image, title));
}

Image read_png(const std::string& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    const auto fail = [&] { throw InputError(fmt::format("{}: {}", path, header.message)); };
    if (png_image_begin_read_from_file(&header, path.c_str()) == 0) fail();
    header.format = (header.format & PNG_FORMAT_FLAG_ALPHA) != 0 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    Image image = make_image(static_cast<int>(header.width), static_cast<int>(header.height),
                             static_cast<int>(PNG_IMAGE_SAMPLE_CHANNELS(header.format)), 0);
    if (png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) == 0) fail();
    return image;
}

}  // namespace zskel
