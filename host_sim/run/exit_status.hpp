// SPDX-License-Identifier: MIT
// exit_status: how a job ends for whoever started the process.
#pragma once

#include <functional>

namespace splinefeed::host {

/// What the job returns. Exceptions are told on standard error, and become 2 where the input or the usage is wrong or
/// an output cannot be written, else 1.
[[nodiscard]] int exit_status(const std::function<int()>& job);

} // namespace splinefeed::host
