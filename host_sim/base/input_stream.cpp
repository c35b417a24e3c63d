// SPDX-License-Identifier: MIT
#include "host_sim/base/input_stream.hpp"

#include "host_sim/base/file_claims.hpp"
#include "host_sim/base/input_error.hpp"

#include <cerrno>
#include <ios>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace splinefeed::host {

InputStream::InputStream(const std::string& path, const std::string& name) {
    descriptor_ = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ >= 0) {
        stop_ = eventfd(0, EFD_CLOEXEC);
    }
    if (stop_ < 0) {
        const int error = errno;
        close_all();
        throw InputError(name, 0, "cannot be opened: {}", std::generic_category().message(error));
    }
    try {
        FileClaims::reads(descriptor_, name);
    } catch (...) {
        close_all();
        throw;
    }
}

InputStream::~InputStream() {
    close_all();
}

void InputStream::close_all() const noexcept {
    if (descriptor_ > STDIN_FILENO) {
        close(descriptor_);
    }
    if (stop_ >= 0) {
        close(stop_);
    }
}

void InputStream::stop() const noexcept {
    const std::uint64_t once = 1;
    [[maybe_unused]] const ssize_t written = write(stop_, &once, sizeof once);
}

std::streambuf::int_type InputStream::underflow() {
    for (;;) {
        std::array<pollfd, 2> events{{{descriptor_, POLLIN, 0}, {stop_, POLLIN, 0}}};
        if (poll(events.data(), events.size(), -1) < 0) {
            if (errno == EINTR) {
                continue;
            }
            throw std::ios_base::failure("poll", std::error_code(errno, std::generic_category()));
        }
        if (events[1].revents != 0) {
            return traits_type::eof();
        }
        const ssize_t count = read(descriptor_, buffer_.data(), buffer_.size());
        if (count > 0) {
            setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
            return traits_type::to_int_type(buffer_.front());
        }
        if (count == 0) {
            return traits_type::eof();
        }
        if (errno != EINTR && errno != EAGAIN) {
            throw std::ios_base::failure("read", std::error_code(errno, std::generic_category()));
        }
    }
}

} // namespace splinefeed::host
