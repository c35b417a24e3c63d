// SPDX-License-Identifier: MIT
#include "host_sim/base/durable_file.hpp"

#include "host_sim/base/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace splinefeed::host {

namespace {

[[noreturn]] void fail(const std::string& path, int error) {
    throw OutputError(fmt::format("{}: cannot be written: {}", path, std::generic_category().message(error)));
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

/// The file itself, where the name is that of a symbolic link; it need not be there yet.
std::string file_of(const std::string& name) {
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

} // namespace

// A symbolic link stays one, and the file keeps its permissions.
void replace_durably(const std::string& name, std::string_view text) {
    const std::string path = file_of(name);
    struct stat old {};
    const bool exists = ::stat(path.c_str(), &old) == 0;
    const std::string aside = path + ".new";
    const int file = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        fail(path, errno);
    }
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
        fail(path, errno);
    }
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        static_cast<void>(::fsync(folder)); // not every file system has it; the file is whole in any case
        ::close(folder);
    }
}

} // namespace splinefeed::host
