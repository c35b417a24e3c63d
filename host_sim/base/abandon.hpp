// SPDX-License-Identifier: MIT
// abandon: ends the process while other threads are blocked in reading or writing.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// Removes what is not committed of output files, writes the sentence to standard error if it is taken at once, and
/// ends the process with this exit status. From any thread; the first call wins, others wait for the end.
[[noreturn]] void abandon(std::string_view sentence, int status) noexcept;

} // namespace splinefeed::host
