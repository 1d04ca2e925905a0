#pragma once

#include <string>

#include "zskel/extract.h"

namespace zskel {

/// What made a skeleton; goes into its file.
struct Provenance {
    std::string model;             ///< path as given
    std::uint64_t model_hash = 0;  ///< XXH3-64 of the file's bytes
    std::string command;           ///< as typed; empty for library callers
    ExtractOptions options;
    BackendOptions backend_options;
    BackendInfo backend;
};

struct JsonParts {
    bool seeds = false;  ///< adds every seed's start, end, state, steps and node
    bool paths = false;  ///< and its path, where it was kept
    std::string maps;    ///< the file of the nodes' visibility maps, as seen from the skeleton's
                         ///< folder; empty: none was written
};

/// The skeleton as JSON (`"format": "zskel-skeleton"`, `"version": 1`), positions in the model's
/// coordinates. `write_skeleton` gives the same of a graph alone, without how it was made.
std::string skeleton_json(const ExtractResult& result, const Provenance& provenance,
                          const JsonParts& parts);

/// The options of that file alone, on one line: two that are equal ask for the same skeleton.
std::string options_text(const Provenance& provenance);

}  // namespace zskel
