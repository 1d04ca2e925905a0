#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zskel/match/signature.h"

namespace zskel {

struct NamedSignature {
    std::string name;
    Signature signature;
};

/// Signatures of many shapes as a file of bytes, little-endian throughout: "zskelidx", then,
/// 32-bit, version (1), stations of a shape, values of a profile, number of shapes; of each shape
/// the size of its name (32-bit), the name, and of each station the node (32-bit), both profiles
/// and the radius (32-bit floats).
std::string write_signatures(const std::vector<NamedSignature>& shapes);

/// @throws InputError that names the file and the byte: sizes are checked against the file's before
/// anything of that size is taken, values for being finite and not below 0.
std::vector<NamedSignature> read_signatures(std::string_view bytes, const std::string& name);

}  // namespace zskel
