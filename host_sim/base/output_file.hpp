// SPDX-License-Identifier: MIT
// OutputFile: an output that is written completely or not at all.
//
// A regular file is first written to a nameless (or hidden) temporary file in the target's directory; commit() replaces
// the target with it in one step. Before that, and if commit() is never called, an existing target stays unchanged.
#pragma once

#include "host_sim/base/input_error.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace splinefeed::host {

/// An output could not be written. what() is one line: `PATH: what is wrong, what would be right`.
struct OutputError : TextError {
    using TextError::TextError;
};

/// Use: OutputFile file(path); file.append(...); file.commit();
/// Path "-" is standard output. Standard output, and an existing target that is not a regular file (a pipe, a device),
/// cannot be undone: data that has left the buffer is written. Memory: one buffer of 256 KiB. Cost of append: a copy.
class OutputFile {
public:
    /// Throws OutputError if the file cannot be created, or is an input or another output (FileClaims).
    explicit OutputFile(std::string path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Without commit(): removes the temporary file.
    ~OutputFile();

    /// Throws OutputError if the data cannot be written. @pre not committed
    void append(std::string_view text) {
        buffer_.append(text);
        flush_if_large();
    }

    /// As append(fmt::format(...)), without the temporary string.
    template <class... T>
    void format(fmt::format_string<T...> format, T&&... values) {
        fmt::format_to(std::back_inserter(buffer_), format, std::forward<T>(values)...);
        flush_if_large();
    }

    /// Puts the complete file in its place. Throws OutputError; the target is then unchanged.
    void commit();

    [[nodiscard]] const std::string& path() const noexcept { return path_; }

    /// For a process that is about to end while threads still write: removes the temporary files of all objects without
    /// commit(). From then on a commit() replaces nothing; its call waits for the end of the process.
    static void discard_all() noexcept;
    /// Number of successful system calls that wrote data, over all files: it does not change while writing is blocked.
    [[nodiscard]] static std::uint64_t writes() noexcept { return writes_.load(std::memory_order_relaxed); }

private:
    static constexpr std::size_t large = std::size_t{1} << 18;

    void flush_if_large() {
        if (buffer_.size() >= large) {
            flush();
        }
    }
    void open();
    void open_temporary();
    void flush();
    void name_temporary();
    void discard() noexcept;
    void forget_temporary() noexcept;
    [[noreturn]] void fail(const char* action, int error) const;

    static std::atomic<std::uint64_t> writes_;

    std::string path_;      // as given, used in messages
    std::string target_;    // path_ with symbolic links followed
    std::string temporary_; // empty: none, or it has no name
    std::string buffer_;
    int descriptor_ = -1;
    bool replaces_ = false; // a temporary file replaces the target; otherwise the target itself is open
};

} // namespace splinefeed::host
