// SPDX-License-Identifier: MIT
// InputStream: a file or a pipe that is read in blocks of what has arrived, and that another thread can stop reading.
#pragma once

#include <array>
#include <streambuf>
#include <string>

namespace splinefeed::host {

/// A failure of reading is thrown as std::ios_base::failure, as std::filebuf does.
class InputStream final : public std::streambuf {
public:
    /// Opens the file; "-" is standard input. Throws InputError where it cannot be opened or is an output as well.
    /// @param name  for messages
    InputStream(const std::string& path, const std::string& name);
    InputStream(const InputStream&) = delete;
    InputStream& operator=(const InputStream&) = delete;
    ~InputStream() override;

    /// From any thread: reading that waits, or is to come, finds the end of the file.
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
