// SPDX-License-Identifier: MIT
//
// What a reader says of input that it refuses.
#pragma once

#include "host_sim/base/input_error.hpp"

#include <string>

namespace splinefeed_test {

template <class Error = splinefeed::host::InputError, class Read>
std::string refusal_of(Read&& read) {
    try {
        read();
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace splinefeed_test
