#include "batch_worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace zskel::cli {
namespace {

// The orders travel in the environment, beside the line.
constexpr const char* kVariable = "ZSKEL_BATCH_WORKER";

std::vector<std::string> own_arguments() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
    return arguments;
}

}  // namespace

bool is_batch_worker() {
    return std::getenv(kVariable) != nullptr;
}

WorkerOrders worker_orders() {
    std::istringstream text(std::getenv(kVariable));
    WorkerOrders orders;
    text >> orders.socket >> orders.memory_mb >> orders.threads;
    return orders;
}

void become_worker(int socket, const WorkerOrders& orders) {
    ::fcntl(socket, F_SETFD, 0);
    ::setenv(kVariable, fmt::format("{} {} {}", socket, orders.memory_mb, orders.threads).c_str(),
             1);
    std::vector<std::string> arguments = own_arguments();
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    ::execv("/proc/self/exe", pointers.data());
    ::_exit(127);
}

}  // namespace zskel::cli
