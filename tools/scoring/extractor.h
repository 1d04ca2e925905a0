#pragma once

#include <string>
#include <vector>

namespace zskel::scoring {

/// The program whose skeletons are scored, so that another build can be; a crash of it is a row of
/// the table, not the end of it.
struct Extractor {
    std::string program;
    std::vector<std::string> options;  ///< after `extract MODEL -o OUTPUT`

    /// Writes the skeleton of a model. @throws Error with the program's own words when it fails.
    void run(const std::string& model, const std::string& output) const;
};

/// A folder for skeletons on their way; gone with the object.
class ScratchFolder {
  public:
    /// @throws IoError when none can be made.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace zskel::scoring
