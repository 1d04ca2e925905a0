// Any bytes as the journal that an earlier batch left. A file that is no journal is left as it is;
// one that is goes on growing, and what is added to it is found again.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "batch/journal.h"
#include "fuzz.h"
#include "zskel/core/log.h"

using namespace zskel;
using namespace zskel::batch;

namespace {

// A file in memory.
class JournalFile {
  public:
    explicit JournalFile(std::string_view bytes) {
        fuzz::require(file_ >= 0, "there is memory for a file");
        fuzz::require(
            ::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
            "a file in memory takes bytes");
    }
    ~JournalFile() { ::close(file_); }
    JournalFile(const JournalFile&) = delete;
    JournalFile& operator=(const JournalFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }
    std::string bytes() const {
        std::string out(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
        const ssize_t count = ::pread(file_, out.data(), out.size(), 0);
        fuzz::require(count == static_cast<ssize_t>(out.size()), "a file in memory is read");
        return out;
    }

  private:
    int file_ = ::memfd_create("journal", MFD_CLOEXEC);
};

Record new_record() {
    Record record;
    record.model = "new.obj";
    record.output = "new.json";
    record.text = "added";
    return record;
}

void check(const JournalFile& file, std::string_view before) {
    std::size_t strange = 0;
    {
        Journal journal(file.path());
        strange = journal.strange_lines();
        journal.append(new_record());
    }
    const std::string kept(before.substr(0, before.rfind('\n') + 1));
    fuzz::require(file.bytes() == kept + to_line(new_record()) + "\n",
                  "whole lines are kept, a torn one is dropped, the new one is last");
    const Journal again(file.path());
    const Record* const found = again.find(new_record().output);
    fuzz::require(found != nullptr && found->text == "added", "what was added is found");
    fuzz::require(again.strange_lines() == strange, "strange lines stay as many");
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    set_log(LogLevel::Off, LogFormat::Text);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes = fuzz::text_of(data, size);
    const JournalFile file(bytes);
    fuzz::answer([&] {
        try {
            check(file, bytes);
        } catch (const UsageError&) {
            fuzz::require(file.bytes() == bytes, "what is no journal is left as it is");
            throw;
        }
    });
    return 0;
}
