// SPDX-License-Identifier: MIT
//
// Two sectors of a flash in RAM, whose power fails where a test says so.
#pragma once

#include "support/catch.hpp"

#include "splinefeed/controller/setting_log.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace splinefeed::test {

class RamFlash final : public LogFlash {
public:
    static constexpr std::size_t never = SIZE_MAX;
    static constexpr std::size_t erase_steps = 16; // as many places where an erase may be cut

    explicit RamFlash(std::size_t sector) { sectors_.fill(std::vector<std::uint8_t>(sector, 0xFF)); }

    std::size_t cut_after = never; // steps that are done: a byte that is programmed, a part of an erase
    std::size_t steps = 0;         // since the power is on
    int erases = 0;
    std::function<void()> on_write = [] {
    };
    std::mt19937 random{1};   // what a cut leaves
    std::size_t worn = never; // from here on bytes of sector 0 cannot be programmed

    void power_on() {
        cut_after = never;
        steps = 0;
    }
    [[nodiscard]] bool is_cut() const { return steps > cut_after; }
    [[nodiscard]] std::vector<std::uint8_t>& content(unsigned sector) { return sectors_[sector]; }

    [[nodiscard]] std::span<const std::uint8_t> bytes(unsigned sector) const noexcept override {
        return sectors_[sector];
    }
    void program(unsigned sector, std::size_t at, std::span<const std::uint8_t> data) noexcept override {
        on_write();
        std::vector<std::uint8_t>& bytes = sectors_[sector];
        CHECK(at + data.size() <= bytes.size());
        CHECK(at % word == 0);
        CHECK(data.size() % word == 0);
        CHECK(at / page == (at + data.size() - 1) / page);
        const std::size_t left = cut_after - std::min(steps, cut_after);
        const bool was_cut = is_cut();
        steps += data.size();
        if (was_cut) {
            return;
        }
        const bool scatters = is_cut() && random() % 2 == 0; // a page is programmed all at once
        for (std::size_t i = 0; i < data.size(); ++i) {
            CHECK(bytes[at + i] == 0xFF); // only forwards, into what is erased
            const bool torn = is_cut() && (scatters || i == left);
            const bool never_begun = is_cut() && !scatters && i > left;
            const auto kept = static_cast<std::uint8_t>(torn ? random() : never_begun ? 0xFFU : 0U);
            bytes[at + i] &= static_cast<std::uint8_t>(data[i] | kept | (sector == 0 && at + i >= worn ? 0xFFU : 0U));
        }
    }
    void erase(unsigned sector) noexcept override {
        on_write();
        const bool was_cut = is_cut();
        steps += erase_steps;
        if (was_cut) {
            return;
        }
        ++erases;
        const unsigned how = static_cast<unsigned>(random() % 3);
        std::vector<std::uint8_t>& bytes = sectors_[sector];
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const auto other = static_cast<std::uint8_t>(random());
            bytes[i] = !is_cut()    ? 0xFF
                       : how == 0   ? other
                       : how == 1   ? static_cast<std::uint8_t>(bytes[i] | other)
                       : i % 2 == 0 ? std::uint8_t{0xFF}
                                    : bytes[i];
        }
    }

private:
    std::array<std::vector<std::uint8_t>, 2> sectors_;
};

} // namespace splinefeed::test
