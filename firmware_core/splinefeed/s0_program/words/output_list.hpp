// SPDX-License-Identifier: MIT
// OutputList: which outputs and inputs a machine has for its programs.
#pragma once

#include "splinefeed/s0_program/words/program_event.hpp"

namespace splinefeed {

class OutputList {
public:
    /// @param kind  of an event of M7, M8, or M62 to M68; input_wait: of M66   @param number  their P or E
    [[nodiscard]] virtual bool has_output(EventKind kind, std::int32_t number) const noexcept = 0;

protected:
    OutputList() = default;
    OutputList(const OutputList&) = default;
    OutputList& operator=(const OutputList&) = default;
    ~OutputList() = default;
};

} // namespace splinefeed
