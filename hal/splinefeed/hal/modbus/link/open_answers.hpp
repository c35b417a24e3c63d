// SPDX-License-Identifier: MIT
// OpenAnswers: requests on a serial line that were not answered in time: their answers may still come.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <array>

namespace splinefeed::hal::modbus {

/// What an answer on a serial line tells of its request: unit and function, and to a writing a little more.
enum class RequestKind : std::uint8_t {
    reading,
    single_write,
    write,
    exchange, ///< who asks has a number of its own in the answer
};

/// An answer on a serial line does not say to which request it belongs. So a unit that owes an answer of a kind gets no
/// other request of that kind before the answer cannot come any more. That is `latest_us` after the time-out, or once
/// the unit has answered a request of another kind that was made since then, because it answers in order. The same
/// writing again need not wait: it is done, whichever of its answers comes. An answer that is later still is taken for
/// that of the next request: drives do not take that long. For one thread; all instants are of one clock [us].
class OpenAnswers {
public:
    static constexpr std::uint64_t latest_us = 300'000; ///< an answer comes so long after the time-out, at most

    /// @param content  differs where what is written differs, or where
    void missed(int unit, RequestKind kind, std::uint64_t content, std::uint64_t now_us) noexcept {
        if (kind != RequestKind::exchange) {
            of(unit)[index(kind)] = {now_us + latest_us, content};
        }
    }
    void answered(int unit, RequestKind kind) noexcept {
        for (std::size_t i = 0; i < kinds; ++i) {
            if (i != index(kind)) {
                of(unit)[i] = {};
            }
        }
    }
    /// From when on the request may be made.
    [[nodiscard]] std::uint64_t until_us(int unit, RequestKind kind, std::uint64_t content) const noexcept {
        if (kind == RequestKind::exchange) {
            return 0;
        }
        const Open& open = open_[static_cast<std::size_t>(unit)][index(kind)];
        return kind != RequestKind::reading && open.content == content ? 0 : open.until_us;
    }
    /// Whether the unit may still answer an earlier request.
    [[nodiscard]] bool owes(int unit, std::uint64_t now_us) const noexcept {
        for (const Open& open : open_[static_cast<std::size_t>(unit)]) {
            if (now_us < open.until_us) {
                return true;
            }
        }
        return false;
    }

private:
    static constexpr std::size_t kinds = 3; // but exchanges
    struct Open {
        std::uint64_t until_us = 0;
        std::uint64_t content = 0;
    };

    [[nodiscard]] static constexpr std::size_t index(RequestKind kind) noexcept {
        return static_cast<std::size_t>(kind);
    }
    [[nodiscard]] std::array<Open, kinds>& of(int unit) noexcept { return open_[static_cast<std::size_t>(unit)]; }

    std::array<std::array<Open, kinds>, most_unit + 1> open_{};
};

/// A number that differs where address or values differ.
template <class Values>
[[nodiscard]] constexpr std::uint64_t content_of(int address, const Values& values) noexcept {
    constexpr std::uint64_t prime = 1099511628211U; // FNV-1a
    std::uint64_t out = 14695981039346656037U ^ static_cast<std::uint64_t>(address);
    for (const auto value : values) {
        out = (out * prime) ^ static_cast<std::uint64_t>(value);
    }
    return out * prime;
}

} // namespace splinefeed::hal::modbus
