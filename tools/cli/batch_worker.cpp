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
    int role = 0;
    text >> role >> orders.socket >> orders.memory_mb >> orders.threads >> orders.gpu_address;
    orders.role = static_cast<WorkerRole>(role);
    return orders;
}

void become_worker(const WorkerOrders& orders) {
    ::fcntl(orders.socket, F_SETFD, 0);
    ::setenv(kVariable,
             fmt::format("{} {} {} {} {}", static_cast<int>(orders.role), orders.socket,
                         orders.memory_mb, orders.threads, orders.gpu_address)
                 .c_str(),
             1);
    std::vector<std::string> arguments = own_arguments();
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    ::execv("/proc/self/exe", pointers.data());
    ::_exit(127);
}

}  // namespace zskel::cli
