// SPDX-License-Identifier: MIT
// durable_file: replaces a small file so that a crash at any instant leaves the old one or the new one, whole.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Writes a new file beside it (of a symbolic link: beside what it names), forces it to the disk, and renames it. No
/// other file is touched. Throws OutputError, also where the name is that of something else than a file; what is there
/// is then unchanged. Cost: two waits for the disk.
void replace_durably(const std::string& name, std::string_view text);

/// Why replace_durably() refuses a name whatever the text: a directory, pipe or device has it. Empty: it does not.
[[nodiscard]] std::string why_irreplaceable(const std::string& name);

/// The file that replace_durably() replaces: where the name is that of a symbolic link, what that names. It need not be
/// there yet. Throws OutputError where links go in a circle.
[[nodiscard]] std::string replaced_file(const std::string& name);

/// Removes a file that replace_durably() made where none was; a symbolic link to it stays. Throws OutputError.
void remove_replaced(const std::string& name);

/// For a process that is about to end while other threads run: waits a while for one that replaces a file, so that it
/// leaves nothing beside it. From then on a call of replace_durably() waits for the end of the process.
void end_replacing() noexcept;

} // namespace splinefeed::host
