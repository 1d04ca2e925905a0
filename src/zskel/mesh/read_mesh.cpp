#include "zskel/mesh/read_mesh.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>

#include "zskel/core/error.h"
#include "zskel/core/input_file.h"
#include "zskel/mesh/formats.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

constexpr std::string_view kForms = "OBJ, OFF, PLY, STL, BPT or JSON (surfaces)";
constexpr std::array<std::string_view, 5> kOffExtensions = {".off", ".coff", ".noff", ".cnoff",
                                                            ".stoff"};
/// First words by which an OBJ file without its extension is told.
constexpr std::array<std::string_view, 8> kObjWords = {"v", "vt", "vn",     "o",
                                                       "g", "s",  "mtllib", "usemtl"};

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::optional<MeshFormat> format_of_extension(const std::string& path) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension == ".obj") return MeshFormat::Obj;
    if (extension == ".ply") return MeshFormat::Ply;
    if (extension == ".stl") return MeshFormat::Stl;
    if (extension == ".bpt") return MeshFormat::Bpt;
    if (extension == ".json") return MeshFormat::SurfaceJson;
    if (std::find(kOffExtensions.begin(), kOffExtensions.end(), extension) != kOffExtensions.end())
        return MeshFormat::Off;
    return std::nullopt;
}

MeshFormat format_of_content(std::string_view bytes, const std::string& name) {
    TextCursor text(bytes, name, {.hash_comments = true, .joined_lines = false});
    const std::string_view word = text.to_content() ? text.word() : std::string_view{};
    if (word == "ply") return MeshFormat::Ply;
    if (is_binary_stl(bytes) || word == "solid") return MeshFormat::Stl;
    if (word.size() >= 3 && word.size() <= 7 && word.substr(word.size() - 3) == "OFF") {
        return MeshFormat::Off;
    }
    if (std::find(kObjWords.begin(), kObjWords.end(), word) != kObjWords.end())
        return MeshFormat::Obj;
    if (word.starts_with('{')) return MeshFormat::SurfaceJson;
    if (!word.empty() &&
        std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return MeshFormat::Bpt;
    if (word.empty()) throw InputError(fmt::format("{}: there is nothing in it", name));
    throw InputError(
        fmt::format("{}: neither the name nor the content, which begins with {}, is that "
                    "of {}",
                    name, quoted(word), kForms));
}

}  // namespace

Mesh read_mesh(const std::string& path, const ReadOptions& options) try {
    const FileBytes bytes = read_input_file(path, fmt::format("an {} file", kForms));
    std::optional<MeshFormat> format = format_of_extension(path);
    if (!format) format = format_of_content(bytes.text(), path);
    return parse_mesh(std::as_bytes(std::span(bytes.text())), *format, path, options);
} catch (const std::bad_alloc&) {
    throw MemoryError(fmt::format("{}: the model takes more memory than may be had", path));
} catch (const std::length_error&) {
    throw MemoryError(fmt::format("{}: the model takes more memory than there can be", path));
}

Mesh parse_mesh(std::span<const std::byte> bytes, MeshFormat format, const std::string& name,
                const ReadOptions& options) {
    if (bytes.empty())
        throw InputError(fmt::format("{}: the file is empty; expected a model", name));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Mesh mesh;
    switch (format) {
        case MeshFormat::Obj:
            mesh = read_obj(text, name, options);
            break;
        case MeshFormat::Off:
            mesh = read_off(text, name, options);
            break;
        case MeshFormat::Ply:
            mesh = read_ply(text, name, options);
            break;
        case MeshFormat::Stl:
            mesh = read_stl(text, name, options);
            break;
        case MeshFormat::Bpt:
            mesh = read_bpt(text, name, options);
            break;
        case MeshFormat::SurfaceJson:
            mesh = read_surfaces(text, name, options);
            break;
    }
    mesh.hash = XXH3_64bits(bytes.data(), bytes.size());
    return mesh;
}

}  // namespace zskel
