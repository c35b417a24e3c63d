// SPDX-License-Identifier: MIT
// abandon: ends the process while other threads are blocked in a read or write.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// Removes the outputs that are not committed, writes the sentence to standard error if that does not block, and ends
/// the process with this exit status. For any thread. The first call decides; other calls wait for the end.
[[noreturn]] void abandon(std::string_view sentence, int status) noexcept;

} // namespace splinefeed::host
