// SPDX-License-Identifier: MIT
// FileClaims: which files one call of the tool reads and writes: no file is both, and no two outputs are one file.
#pragma once

#include <string>

namespace splinefeed::host {

/// While there is one, inputs and outputs are noted as they are opened, by what they are (device and inode), not by
/// name: a symbolic link, a hard link and another spelling are the same file. Pipes, terminals and devices are not
/// noted: nothing is lost there. Without one nothing is noted.
/// For any thread. Cost: a call of the system and a look at every file noted so far.
class FileClaims {
public:
    /// @pre there is no other one
    FileClaims();
    FileClaims(const FileClaims&) = delete;
    FileClaims& operator=(const FileClaims&) = delete;
    ~FileClaims();

    /// An input that has just been opened. Throws InputError where it is an output, too.
    static void reads(int descriptor, const std::string& name);
    /// Where an output is to be put, which may not exist yet; "-" is standard output. Throws OutputError where it is an
    /// input or another output.
    static void writes(const std::string& path);
    /// Whether an input has been put at the path since. Before the output takes its place.
    [[nodiscard]] static bool is_input(const std::string& path) noexcept;
};

} // namespace splinefeed::host
