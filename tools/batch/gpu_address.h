#pragma once

#include <string>

namespace zskel::batch {

/// A socket that listens, closed on exec; nobody else has the address and no file stands for it.
/// @throws Error.
int listen_at(const std::string& address);

/// @throws GlError when nobody listens there.
int connect_to(const std::string& address);

}  // namespace zskel::batch
