// SPDX-License-Identifier: MIT
#include "host_sim/drive/command_states.hpp"

#include <algorithm>
#include <initializer_list>

namespace splinefeed::host {

using hal::modbus::PvtCommand;
using hal::modbus::PvtState;

bool fits(PvtCommand command, PvtState state) noexcept {
    const auto in = [state](std::initializer_list<PvtState> states) {
        return std::find(states.begin(), states.end(), state) != states.end();
    };
    switch (command) {
    case PvtCommand::none:
    case PvtCommand::quick_stop: return true;
    case PvtCommand::enable: return in({PvtState::disabled, PvtState::standing});
    case PvtCommand::disable: return in({PvtState::disabled, PvtState::standing, PvtState::held});
    case PvtCommand::begin: return in({PvtState::standing, PvtState::held});
    case PvtCommand::start:
    case PvtCommand::home:
    case PvtCommand::preset_position: return in({PvtState::standing});
    case PvtCommand::hold:
    case PvtCommand::end: return in({PvtState::running, PvtState::stopping, PvtState::held});
    case PvtCommand::resume: return in({PvtState::held});
    case PvtCommand::fault_reset: return in({PvtState::fault, PvtState::disabled});
    }
    return false;
}

} // namespace splinefeed::host
