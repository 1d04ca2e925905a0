#pragma once

#include <string>

#include "batch/skeleton_maker.h"

namespace zskel::batch {

/// What a worker is: answers the requests on the socket, one after the other, until its other end
/// is closed.
/// @param gpu_address  see SkeletonMaker.
/// @param memory_mb    that the process may take at most; 0: no bound.
void serve(int socket, const Task& task, const std::string& gpu_address, double memory_mb);

}  // namespace zskel::batch
