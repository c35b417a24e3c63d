// SPDX-License-Identifier: MIT
// SourceLine: a line of a program's text. LineReader: the lines of a file or a pipe, as the bytes arrive.
#pragma once

#include "host_sim/base/input_stream.hpp"
#include "host_sim/program/row_source.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct SourceLine {
    std::string text;                  ///< without its end
    std::uint64_t number = 0;          ///< from 1
    bool whole = true;                 ///< false: a pipe ended within it, so the rest of it may be missing
    const std::string* file = nullptr; ///< that it is of, if that is not the program's own
};

/// Why a line that is not whole was refused.
inline constexpr std::string_view cut_line =
    "the input ends within this line, so it was not executed; a line that is whole has a line end";

using SourceLines = RowSource<SourceLine>;

/// Memory: one line. What lines are: plain_text; the last one may end with the file. After stop() there is no further
/// line, and none that is cut off.
class LineReader final : public SourceLines {
public:
    static constexpr std::size_t longest_line = 65536; ///< bytes, comments included

    /// Throws InputError if it cannot be opened.
    /// @param name  for messages
    LineReader(const std::string& path, const std::string& name);

    bool next(SourceLine& out) override;
    void stop() noexcept override {
        stopped_ = true;
        input_.stop();
    }

private:
    InputStream input_;
    std::string name_;
    std::uint64_t lines_ = 0;
    bool file_ = false; // its last line is whole without a line end
    std::atomic<bool> stopped_{false};
};

} // namespace splinefeed::host
