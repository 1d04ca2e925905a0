#pragma once

#include <sys/types.h>

#include <functional>

namespace zskel::batch {

/// Starts a process that dies with this one and leaves alone what a terminal or a cluster sends to
/// all processes of a group, which is for this one to act on; it leaves no core file.
/// @param work  what it does; it should not return. @throws Error.
pid_t start_child(const std::function<void()>& work);

/// Waits for its end. @return its status, as waitpid gives it.
int reap(pid_t child);

}  // namespace zskel::batch
