// SPDX-License-Identifier: MIT
// SenderDoor without Boost: there is none.
#include "host_sim/serve/sender_door.hpp"

namespace splinefeed::host {

bool has_sender_door() noexcept {
    return false;
}

std::unique_ptr<SenderDoor> make_sender_door(const SenderDoor::Events& /*events*/) {
    return nullptr;
}

} // namespace splinefeed::host
