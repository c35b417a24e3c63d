// SPDX-License-Identifier: MIT
//
// Where the file system offers O_TMPFILE, the temporary has no name until commit(): not even a killed process leaves
// anything behind. Elsewhere it is a hidden file, which only a kill can leave.
#include "host_sim/base/output_file.hpp"

#include "host_sim/base/file_claims.hpp"

#include <cassert>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr mode_t new_file_mode = 0666; // the user's umask narrows it

/// Temporaries that have a name. Locked while one gets its name, and until it has taken its target's place.
struct Named {
    std::mutex mutex;
    std::vector<std::string> paths;
};

Named& named() {
    static Named all;
    return all;
}

std::string folder_of(const std::string& target) {
    const std::filesystem::path folder = std::filesystem::path(target).parent_path();
    return folder.empty() ? "." : folder.string();
}

// The n-th candidate for the name of a temporary beside the target.
std::string temporary_name(const std::string& target, int n) {
    const std::string file = std::filesystem::path(target).filename().string();
    return fmt::format("{}/.{}.{}-{}.tmp", folder_of(target), file, getpid(), n);
}

const char* remedy(int error) {
    switch (error) {
    case ENOENT:
    case ENOTDIR: return "name a file in a directory that exists";
    case EISDIR: return "name a file, not a directory";
    case EACCES:
    case EPERM:
    case EROFS: return "name a file in a directory that you may write to";
    case ENOSPC:
    case EDQUOT: return "make room or name a file on another disk";
    case EPIPE: return "keep the reader running to the end";
    default: return "name a file that can be written";
    }
}

} // namespace

std::atomic<std::uint64_t> OutputFile::writes_{0};

void OutputFile::discard_all() noexcept {
    named().mutex.lock(); // for good
    for (const std::string& path : named().paths) {
        unlink(path.c_str());
    }
}

void OutputFile::fail(const char* action, int error) const {
    throw OutputError("{}: {}: {}; {}", path_ == "-" ? "standard output" : path_, action,
                      std::generic_category().message(error), remedy(error));
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)), target_(path_) {
    buffer_.reserve(large + large / 4);
    if (path_ == "-") {
        FileClaims::writes(path_);
        descriptor_ = STDOUT_FILENO;
        return;
    }
    open();
}

void OutputFile::open() {
    if (path_.empty()) {
        fail("cannot create a file without a name", ENOENT);
    }
    struct stat status {};
    const bool exists = stat(path_.c_str(), &status) == 0;
    if ((exists && S_ISDIR(status.st_mode)) || path_.back() == '/') {
        fail("cannot create", EISDIR);
    }
    FileClaims::writes(path_);
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC); // replacing a device or a pipe would destroy it
        if (descriptor_ < 0) {
            fail("cannot write", errno);
        }
        return;
    }
    if (exists) {
        if (access(path_.c_str(), W_OK) != 0) {
            fail("cannot replace", errno);
        }
        std::error_code error;
        const std::filesystem::path real = std::filesystem::canonical(path_, error);
        if (!error) {
            target_ = real.string(); // a symbolic link stays one
        }
    }
    open_temporary();
    if (exists) {
        static_cast<void>(fchmod(descriptor_, status.st_mode & 07777)); // best effort
    }
}

void OutputFile::open_temporary() {
    replaces_ = true;
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) { // by which name_temporary() gives it a name
        descriptor_ = ::open(folder_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, new_file_mode);
        if (descriptor_ >= 0) {
            return;
        }
    }
#endif
    const std::lock_guard lock(named().mutex);
    for (int n = 0;; ++n) {
        temporary_ = temporary_name(target_, n);
        descriptor_ = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, new_file_mode);
        if (descriptor_ >= 0) {
            named().paths.push_back(temporary_);
            return;
        }
        if (errno != EEXIST) {
            const int error = errno;
            temporary_.clear();
            fail("cannot create", error);
        }
    }
}

OutputFile::~OutputFile() {
    discard();
}

void OutputFile::discard() noexcept {
    if (descriptor_ >= 0 && descriptor_ != STDOUT_FILENO) {
        close(descriptor_);
    }
    descriptor_ = -1;
    if (!temporary_.empty()) {
        const std::lock_guard lock(named().mutex);
        unlink(temporary_.c_str());
        forget_temporary();
    }
}

void OutputFile::forget_temporary() noexcept {
    std::erase(named().paths, temporary_);
    temporary_.clear();
}

void OutputFile::flush() {
    assert(descriptor_ >= 0 && "no output after commit()");
    std::string_view rest = buffer_;
    while (!rest.empty()) {
        const ssize_t written = write(descriptor_, rest.data(), rest.size());
        if (written >= 0) {
            writes_.fetch_add(1, std::memory_order_relaxed);
            rest.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            fail("cannot write", errno);
        }
    }
    buffer_.clear();
}

// Gives a nameless temporary a name. Locked.
void OutputFile::name_temporary() {
    const std::string nameless = fmt::format("/proc/self/fd/{}", descriptor_);
    for (int n = 0;; ++n) {
        const std::string name = temporary_name(target_, n);
        if (linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
            temporary_ = name;
            named().paths.push_back(name);
            return;
        }
        if (errno != EEXIST) {
            fail("cannot create", errno);
        }
    }
}

void OutputFile::commit() {
    flush();
    if (path_ == "-") {
        descriptor_ = -1;
        return;
    }
    const std::lock_guard lock(named().mutex);
    if (replaces_ && temporary_.empty()) {
        name_temporary();
    }
    // Some file systems report a full disk only here.
    if (close(std::exchange(descriptor_, -1)) != 0) {
        fail("cannot write", errno);
    }
    if (replaces_) {
        if (FileClaims::is_input(target_)) {
            throw OutputError(path_ + ": an input was put there meanwhile; give the output a name of its own");
        }
        if (rename(temporary_.c_str(), target_.c_str()) != 0) {
            fail("cannot replace", errno);
        }
        forget_temporary();
    }
}

} // namespace splinefeed::host
