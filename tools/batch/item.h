#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace zskel::batch {

/// One model to work on, as a manifest names it.
struct Entry {
    std::string model;
    std::string output;                         ///< empty: by the template
    std::map<std::string, std::string> fields;  ///< the manifest's other columns
};

/// One model and where its skeleton goes.
struct Item {
    std::size_t index = 0;  ///< in the whole manifest, from 0
    std::string model;
    std::string output;
};

}  // namespace zskel::batch
