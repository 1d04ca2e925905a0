#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "batch/record.h"

namespace zskel::batch {

/// A file of records, a line each, that grows at its end and bears being killed at any moment: a
/// line goes out in one write, and a last line that is torn is dropped when the file is opened
/// again. Of the records of one output the last counts.
class Journal {
  public:
    /// Opens or makes the file and reads what is in it. Other processes are kept out until this one
    /// ends.
    /// @throws UsageError when another process has it open; IoError.
    explicit Journal(const std::string& path);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// What is known of an output; nullptr: nothing.
    const Record* find(const std::string& output) const;

    /// Adds a line; a line that cannot be written whole is taken back. @throws IoError.
    void append(const Record& record);

    /// Returns when all of it is on the disk. @throws IoError.
    void flush();

    /// Lines that were no records and were passed over, the torn last one not among them.
    std::size_t strange_lines() const { return strange_lines_; }

  private:
    Journal(const std::string& path, int file);
    void lock();
    void read();
    void take_lines(const std::string& text);

    std::string path_;
    int file_;
    std::size_t size_ = 0;
    std::size_t strange_lines_ = 0;
    std::unordered_map<std::string, Record> last_;
};

}  // namespace zskel::batch
