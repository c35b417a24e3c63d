// SPDX-License-Identifier: MIT
// InputStream: a file or a pipe, read in blocks as data arrives; another thread can stop the reading.
#pragma once

#include <array>
#include <streambuf>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// A read error is thrown as std::ios_base::failure, as by std::filebuf.
class InputStream final : public std::streambuf {
public:
    /// Opens the file; "-" is standard input. Throws InputError if it cannot be opened, or is also an output.
    /// @param name  for messages
    InputStream(const std::string& path, const std::string& name);
    InputStream(const InputStream&) = delete;
    InputStream& operator=(const InputStream&) = delete;
    ~InputStream() override;

    /// What has arrived and was not read yet.
    [[nodiscard]] std::string_view arrived() const noexcept {
        return {gptr(), static_cast<std::size_t>(egptr() - gptr())};
    }
    /// Leaves out the next bytes. @pre at most arrived().size()
    void skip(std::size_t bytes) noexcept { gbump(static_cast<int>(bytes)); }

    /// For any thread: a read that waits, and every later read, returns end of file.
    void stop() const noexcept;

protected:
    int_type underflow() override;

private:
    void close_all() const noexcept;

    int descriptor_ = -1;
    int stop_ = -1; // an eventfd
    std::array<char, std::size_t{1} << 16> buffer_{};
};

} // namespace splinefeed::host
