// SPDX-License-Identifier: MIT
// OutputFile: an output that is written whole or not at all.
//
// A regular file grows in a nameless (or hidden) temporary in the target's directory and replaces the target in one
// step in commit(). Until then, and for ever if commit() is not reached, an existing target stays as it is.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace splinefeed::host {

/// An output could not be written. what() is one line: `PATH: what is wrong, what would be right`.
class OutputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Use: OutputFile file(path); file.append(...); file.commit();
/// Path "-" is standard output. It, and an existing target that is no regular file (a pipe, a device), cannot be taken
/// back: what has left the buffer is written.
/// Memory: one buffer of 256 KiB. Cost of append: a copy.
class OutputFile {
public:
    /// Throws OutputError where nothing can be created, and where the file is an input or another output (FileClaims).
    explicit OutputFile(std::string path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Without commit(): removes what was written.
    ~OutputFile();

    /// Throws OutputError where the file cannot grow. @pre not committed
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

    /// Puts the complete file in its place. Throws OutputError; then the target is untouched.
    void commit();

    [[nodiscard]] const std::string& path() const noexcept { return path_; }

    /// For a process that is about to end while threads still write: removes what every file without commit() has left,
    /// and lets no commit() put anything in its place any more: one that is called waits for the end.
    static void discard_all() noexcept;
    /// Calls of the system that took something, of all files: it stands still where writing is blocked.
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

    std::string path_;      // as given, for messages
    std::string target_;    // path_ with symbolic links followed
    std::string temporary_; // empty: none, or it has no name
    std::string buffer_;
    int descriptor_ = -1;
    bool replaces_ = false; // a temporary takes the target's place; else the target itself is open
};

} // namespace splinefeed::host
