// SPDX-License-Identifier: MIT
// SubprogramFiles: subprograms that are files of their own, beside the program and in folders that the user states.
#pragma once

#include "host_sim/program/source_line.hpp"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Nothing outside the folders is read, whatever a name or a symbolic link says.
class SubprogramFiles {
public:
    static constexpr std::size_t most_bytes = std::size_t{64} << 20U; ///< of all files together
    static constexpr std::size_t longest_name = 200;

    struct File {
        std::string name;              ///< for messages
        std::vector<SourceLine> lines; ///< each names the file
    };

    /// @param folders  in the order of search; an empty text is the folder that the process works in
    explicit SubprogramFiles(std::vector<std::string> folders) : folders_(std::move(folders)) {}

    /// The first file of these names, folder by folder. None: there is none, or a name has other characters than
    /// letters, digits, - and _ before its suffix. Throws InputError in the name of a file that is none, that leads out
    /// of the folders, cannot be read, or is too large. The lines are valid as long as this object.
    /// @param most_lines  that it may have
    [[nodiscard]] std::optional<File> read(const std::vector<std::string>& names, std::size_t most_lines);
    /// Where read() has looked, for a sentence.
    [[nodiscard]] std::string searched(const std::vector<std::string>& names) const;

private:
    [[nodiscard]] File read_file(const std::string& path, const std::string& name, std::size_t most_lines);
    [[nodiscard]] std::string inside(const std::string& path) const;

    std::vector<std::string> folders_;
    std::deque<std::string> names_; // of the files whose lines are there
    std::size_t bytes_ = 0;         // read so far
};

} // namespace splinefeed::host
