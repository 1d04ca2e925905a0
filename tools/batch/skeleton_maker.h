#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "batch/record.h"
#include "batch/request.h"
#include "zskel/extract.h"
#include "zskel/io/skeleton_formats.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/visibility/choose.h"

namespace zskel::batch {

/// What is done to every item.
struct Task {
    ExtractOptions extract;
    BackendOptions backend;
    ReadOptions reading;
    std::optional<SkeletonFormat> format;  ///< none: by the output's extension
    bool tubes = false;
    bool strict = false;  ///< a skeleton that fails its self-check is a failure
    std::string command;  ///< as typed
};

/// Makes one skeleton after the other and keeps what they share open: the backend, its GL context
/// or its connection to the process that has one, and the context for thumbnails.
class SkeletonMaker {
  public:
    /// @param gpu_address  of the process that does the GL work of a batch; empty: this one does.
    SkeletonMaker(Task task, std::string gpu_address);
    ~SkeletonMaker();

    /// Does the item, unless what is known of it still holds. Nothing is thrown: a failure is in
    /// the record.
    /// @param begun  told the record with key and backend, before the work that may take long.
    Record make(const Request& request, const std::function<void(const Record&)>& begun);

  private:
    void work(const Request& request, const std::function<void(const Record&)>& begun,
              Record& record);
    Backend& backend_for(const BackendOptions& options);
    std::string resolved_backend(const std::string& model);
    void add_thumbnail(const ExtractResult& result, Record& record);
    void fail(const Error& error, Record& record);

    std::unique_ptr<Backend> open(const BackendOptions& options, const Choice& choice) const;

    Task task_;
    std::string gpu_address_;
    bool is_alone_ = false;  // the item at hand leaves that process alone
    std::array<std::unique_ptr<Backend>, 2> backends_;  // by GL: the second
    std::unique_ptr<gl::Context> picture_context_;
    std::string no_picture_;
};

}  // namespace zskel::batch
