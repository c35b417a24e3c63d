// SPDX-License-Identifier: MIT
// SourceLine: a line of a program's text. LineReader: the lines of a file or a pipe, as the bytes arrive.
#pragma once

#include "host_sim/base/input_stream.hpp"
#include "host_sim/program/row_source.hpp"

#include <cstdint>
#include <string>

namespace splinefeed::host {

struct SourceLine {
    std::string text;         ///< without its end
    std::uint64_t number = 0; ///< from 1
};

using SourceLines = RowSource<SourceLine>;

/// Memory: one line. Lines end with \n or \r\n; the last one may end with the file. A mark of UTF-8
/// at the beginning is left out.
class LineReader final : public SourceLines {
public:
    static constexpr std::size_t longest_line = 65536; ///< bytes, comments included

    /// Throws InputError if it cannot be opened.
    /// @param name  for messages
    LineReader(const std::string& path, const std::string& name) : input_(path, name), name_(name) {}

    bool next(SourceLine& out) override;
    void stop() noexcept override { input_.stop(); }

private:
    void leave_out_mark(std::string& text) const;

    InputStream input_;
    std::string name_;
    std::uint64_t lines_ = 0;
};

} // namespace splinefeed::host
