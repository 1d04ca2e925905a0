#include "scoring/extractor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX's
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "zskel/core/error.h"

namespace zskel::scoring {
namespace {

namespace fs = std::filesystem;

// Runs a program to its end; what it says goes into a file. Its wait status comes back.
int run_program(const std::vector<std::string>& words, const std::string& log) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t child = 0;
    const int error =
        ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw Error(ExitCode::Internal, fmt::format("{}: {}", words[0], std::strerror(error)));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw Error(ExitCode::Internal, std::strerror(errno));
    }
    return status;
}

std::string last_line(const std::string& path) {
    std::ifstream file(path);
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty()) last = line;
    }
    return last;
}

}  // namespace

void Extractor::run(const std::string& model, const std::string& output) const {
    std::vector<std::string> words{program, "-q", "extract", model, "-o", output};
    words.insert(words.end(), options.begin(), options.end());
    const std::string log = output + ".log";
    const int status = run_program(words, log);
    const std::string said = last_line(log);
    fs::remove(log);
    if (WIFSIGNALED(status)) {
        throw Error(ExitCode::Internal, fmt::format("stopped by signal {}", WTERMSIG(status)));
    }
    if (WEXITSTATUS(status) != 0) {
        throw Error(ExitCode::Internal, fmt::format("exit {}{}{}", WEXITSTATUS(status),
                                                    said.empty() ? "" : ": ", said));
    }
}

ScratchFolder::ScratchFolder()
    : path_((fs::temp_directory_path() / "zskel-score-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
        throw IoError(fmt::format("{}: cannot be made: {}", path_, std::strerror(errno)));
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace zskel::scoring
