#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "batch/socket_io.h"
#include "zskel/visibility/backend.h"

namespace zskel::batch {

/// What a worker asks of the GPU's process. Each but Release is answered, in its order.
enum class Ask : std::uint32_t {
    Ping,     ///< nothing; answered by nothing
    Open,     ///< nothing; answered by a BackendInfo
    Prepare,  ///< counts of vertices and of triangles, positions, triangles, their normals
    Look,     ///< eyes; answered by records
    Render,   ///< eyes; answered by distances and ids of whole maps
    Release,  ///< forgets the solid
};

/// What answers: an Ask's own number, or that it went wrong and a text that says why.
inline constexpr std::uint32_t kWentWrong = 0xFFFFFFFFU;

/// Before every message. Both ends are one program on one machine.
struct Head {
    std::uint32_t what = 0;   ///< Ask, or kWentWrong
    std::uint32_t solid = 0;  ///< the worker's own number of it
    std::uint64_t bytes = 0;  ///< that follow
};

/// Sends a message of several parts. @return false when the other end is gone.
bool send_message(int socket, std::uint32_t what, std::uint32_t solid,
                  std::initializer_list<Bytes> parts);

std::string to_text(const BackendInfo& info);
BackendInfo backend_info_of(const std::string& text);

}  // namespace zskel::batch
