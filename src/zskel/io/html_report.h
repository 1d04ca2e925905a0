#pragma once

#include <string>

#include "zskel/extract.h"
#include "zskel/io/skeleton_json.h"
#include "zskel/rebuild/visibility_maps.h"

namespace zskel {

/// A page that tells all of a skeleton, in one file that needs no network: model and skeleton to
/// turn about, branches, radii and lengths, what each node sees, warnings, and how it was made.
/// @param maps  of the result's nodes.
/// @throws UsageError when the library was built without three.js, which the page draws with;
/// InputError when the maps are not those of the nodes.
std::string html_report(const ExtractResult& result, const Provenance& provenance,
                        const VisibilityMaps& maps);

/// Whether the library was built with three.js.
bool has_html_report();

}  // namespace zskel
