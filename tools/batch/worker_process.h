#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "batch/record.h"
#include "batch/request.h"

namespace zskel::batch {

using Clock = std::chrono::steady_clock;

/// One place in a pool: a process, or none yet, and the item that it has.
class Worker {
  public:
    explicit Worker(const std::function<void(int socket)>& launch) : launch_(launch) {}
    ~Worker() { stop(); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    bool is_busy() const { return request_.has_value(); }
    int socket() const { return socket_; }  ///< -1: no process
    const std::optional<Clock::time_point>& deadline() const { return deadline_; }

    /// Starts a process if there is none, and hands it the request. @throws Error.
    void give(const Request& request, std::optional<Clock::duration> timeout);

    /// Takes what the process has sent; the record, if its item has ended in whatever way. An item
    /// that a fresh process might do is given to one instead, once.
    std::optional<Record> receive();

    /// The record of an item whose time is over; the process is killed.
    Record time_out(double seconds);

    /// Ends the process at once. Removes the temporary file of the item that it had, and forgets
    /// the item.
    void stop();

  private:
    void start();
    bool send(const std::string& message);
    void hand(const Request& request);
    bool read_socket();
    std::optional<Record> take_record();
    Record ended(const std::string& reason, int exit_code, std::string text);
    Record crashed();
    bool deserves_second_try(const Record& record) const;

    const std::function<void(int)>& launch_;
    pid_t pid_ = -1;
    int socket_ = -1;
    std::string received_;
    std::size_t items_done_ = 0;
    bool is_second_try_ = false;
    std::optional<Request> request_;
    Record begun_;  // what is known of the item while it is worked on
    Clock::time_point start_;
    std::optional<Clock::time_point> deadline_;
    std::optional<Clock::duration> timeout_;
};

}  // namespace zskel::batch
