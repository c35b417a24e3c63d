// SPDX-License-Identifier: MIT
#include "host_sim/base/memory_file.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

namespace splinefeed::host {

MemoryFile::MemoryFile(std::string_view text) : descriptor_(memfd_create("splinefeed", MFD_CLOEXEC)) {
    int error = descriptor_ < 0 ? errno : 0;
    while (error == 0 && !text.empty()) {
        const ssize_t written = write(descriptor_, text.data(), text.size());
        error = written < 0 && errno != EINTR ? errno : 0;
        text.remove_prefix(static_cast<std::size_t>(written > 0 ? written : 0));
    }
    if (error != 0) {
        if (descriptor_ >= 0) {
            close(descriptor_);
        }
        throw std::system_error(error, std::generic_category(), "a text in memory");
    }
}

MemoryFile::~MemoryFile() {
    close(descriptor_);
}

std::string MemoryFile::path() const {
    return fmt::format("/proc/self/fd/{}", descriptor_);
}

} // namespace splinefeed::host
