// SPDX-License-Identifier: MIT
// durable_file: replaces a small file so that a crash at any instant leaves the old one or the new one, whole.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Writes a new file beside it (of a symbolic link: beside what it names), forces it to the disk, and renames it. No
/// other file is touched. Throws OutputError; the old file is then unchanged. Cost: two waits for the disk.
void replace_durably(const std::string& name, std::string_view text);

/// For a process that is about to end while other threads run: waits a while for one that replaces a file, so that it
/// leaves nothing beside it. From then on a call of replace_durably() waits for the end of the process.
void end_replacing() noexcept;

} // namespace splinefeed::host
