// SPDX-License-Identifier: MIT
// FileClaims: records which files one call of the tool reads and writes, so that no output overwrites an input or
// another output.
#pragma once

#include <string>

namespace splinefeed::host {

/// While an object exists, inputs and outputs are recorded when they are opened. Files are compared by device and
/// inode, not by name: a symbolic link, a hard link and another spelling are the same file. Pipes, terminals and
/// devices are not recorded, because nothing can be lost there. Without an object nothing is recorded. For any thread.
/// Cost: a system call and a comparison with every recorded file.
class FileClaims {
public:
    /// @pre no other object exists
    FileClaims();
    FileClaims(const FileClaims&) = delete;
    FileClaims& operator=(const FileClaims&) = delete;
    ~FileClaims();

    /// Records an input that was just opened. Throws InputError if it is also an output.
    static void reads(int descriptor, const std::string& name);
    /// Records the path of an output, which need not exist yet; "-" is standard output. Throws OutputError if it is an
    /// input or another output.
    static void writes(const std::string& path);
    /// As writes(), for a file that is read before it is replaced, by the same name.
    static void keeps(const std::string& path);
    /// Whether an input has appeared at this path since. Call it before the output replaces the file.
    [[nodiscard]] static bool is_input(const std::string& path) noexcept;

private:
    static void claim_output(const std::string& path, bool state);
};

} // namespace splinefeed::host
