#pragma once

#include <cstddef>
#include <span>

namespace zskel::batch {

using Bytes = std::span<const std::byte>;

/// Sends all of it. @return false when the other end is gone, or takes nothing for as long as the
/// socket waits.
bool send_all(int socket, Bytes bytes);

/// Waits for so many bytes. @return false when the other end is gone.
bool receive_exactly(int socket, std::span<std::byte> bytes);

}  // namespace zskel::batch
