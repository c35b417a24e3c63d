// SPDX-License-Identifier: MIT
#include "host_sim/program/source_line.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/plain_text.hpp"
#include "host_sim/base/text_file.hpp"

#include <algorithm>
#include <ios>

namespace splinefeed::host {

LineReader::LineReader(const std::string& path, const std::string& name)
    : input_(path, name), name_(name), file_(is_regular_file(path == "-" ? "/dev/stdin" : path)) {}

bool LineReader::next(SourceLine& out) {
    using Traits = std::streambuf::traits_type;
    out.text.clear();
    out.number = ++lines_;
    out.whole = true;
    try {
        for (;;) {
            if (Traits::eq_int_type(input_.sgetc(), Traits::eof())) {
                out.whole = file_ || out.text.empty();
                if (stopped_) {
                    return false;
                }
                out.text = plain_line(out.text, name_, lines_, true);
                return !out.text.empty();
            }
            const std::string_view here = input_.arrived();
            const std::size_t end = here.find('\n');
            const std::string_view part = here.substr(0, end);
            if (out.text.size() + part.size() > longest_line) {
                throw InputError(name_, lines_, "the line is longer than {} bytes; is it a text file?", longest_line);
            }
            out.text += part;
            input_.skip(std::min(part.size() + 1, here.size()));
            if (end != std::string_view::npos) {
                out.text = plain_line(out.text, name_, lines_, false);
                return true;
            }
        }
    } catch (const std::ios_base::failure&) {
        throw InputError(name_, lines_, "cannot be read; it must be a file or a pipe");
    }
}

} // namespace splinefeed::host
