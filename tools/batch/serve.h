#pragma once

#include "batch/skeleton_maker.h"

namespace zskel::batch {

/// What a worker is: answers the requests on the socket, one after the other, until its other end
/// is closed.
/// @param memory_mb  that the process may take at most; 0: no bound.
void serve(int socket, const Task& task, double memory_mb);

}  // namespace zskel::batch
