// SPDX-License-Identifier: MIT
// What a fuzzer judges by: it ends where something does not hold.
#pragma once

#include "host_sim/base/input_error.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace splinefeed_test {

inline void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

/// What is wrong with the bytes as a file is said in one line. @param read  reads them, and judges what they are
template <class Read>
int read_or_refuse(const std::uint8_t* data, std::size_t size, Read&& read) {
    try {
        read(std::string_view(reinterpret_cast<const char*>(data), size));
    } catch (const splinefeed::host::InputError& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
    return 0;
}

} // namespace splinefeed_test
