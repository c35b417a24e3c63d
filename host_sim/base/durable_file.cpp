// SPDX-License-Identifier: MIT
#include "host_sim/base/durable_file.hpp"

#include "host_sim/base/output_file.hpp"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <sys/random.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace splinefeed::host {

namespace {

[[noreturn]] void fail(const std::string& path, int error) {
    throw OutputError("{}: cannot be written: {}", path, std::generic_category().message(error));
}

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR) {
            return false;
        }
        text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0U);
    }
    return true;
}

/// A new file beside the path. A name that cannot be known before, and O_EXCL: nobody can have put a link or a file of
/// theirs there.
struct AsideFile {
    std::string name;
    int descriptor;
};

AsideFile make_aside(const std::string& path) {
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries; ++i) {
        std::uint64_t number = 0;
        if (::getrandom(&number, sizeof number, 0) != sizeof number) {
            fail(path, errno);
        }
        std::string name = fmt::format("{}.{:016x}.tmp", path, number);
        const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            return {std::move(name), descriptor};
        }
        if (errno != EEXIST) {
            break;
        }
    }
    fail(path, errno);
}

std::string refusal_of(const struct stat& status) {
    return S_ISREG(status.st_mode) ? std::string()
                                   : fmt::format("is a {}, which cannot be replaced; name a file, or one that is not "
                                                 "there yet",
                                                 S_ISDIR(status.st_mode)    ? "directory"
                                                 : S_ISFIFO(status.st_mode) ? "pipe"
                                                                            : "device");
}

std::timed_mutex replacing;

} // namespace

std::string replaced_file(const std::string& name) {
    constexpr int most_links = 40; // as the kernel has it
    std::filesystem::path path = name;
    std::error_code no_link;
    for (int i = 0; i < most_links; ++i) {
        const std::filesystem::path target = std::filesystem::read_symlink(path, no_link);
        if (no_link) {
            return path.string();
        }
        path = path.parent_path() / target;
    }
    fail(name, ELOOP);
}

void end_replacing() noexcept {
    constexpr std::chrono::seconds most{2}; // a disk that hangs must not keep the process
    static_cast<void>(replacing.try_lock_for(most));
}

std::string why_irreplaceable(const std::string& name) {
    struct stat status {};
    return ::stat(name.c_str(), &status) == 0 ? refusal_of(status) : std::string();
}

void remove_replaced(const std::string& name) {
    const std::lock_guard lock(replacing);
    const std::string path = replaced_file(name);
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::unlink(path.c_str()) != 0) {
        fail(path, errno);
    }
}

// A symbolic link stays one, and the file keeps its permissions.
void replace_durably(const std::string& name, std::string_view text) {
    const std::lock_guard lock(replacing);
    const std::string path = replaced_file(name);
    struct stat old {};
    const bool exists = ::stat(path.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode)) { // the new name would take its place, also that of /dev/null
        throw OutputError("{}: {}", path, refusal_of(old));
    }
    const auto [aside, file] = make_aside(path);
    if (exists) {
        static_cast<void>(::fchmod(file, old.st_mode & 07777)); // best effort
    }
    const bool written = write_all(file, text) && ::fsync(file) == 0;
    const int error = errno;
    ::close(file);
    if (!written) {
        ::unlink(aside.c_str());
        fail(path, error);
    }
    if (std::rename(aside.c_str(), path.c_str()) != 0) {
        const int why = errno;
        ::unlink(aside.c_str());
        fail(path, why);
    }
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        static_cast<void>(::fsync(folder)); // not every file system has it; the file is whole in any case
        ::close(folder);
    }
}

} // namespace splinefeed::host
