// SPDX-License-Identifier: MIT
#include "host_sim/report/packed_column.hpp"

#include <string_view>

namespace splinefeed::host {

namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Takes bytes, gives base64.
class Base64 {
public:
    explicit Base64(std::size_t bytes) { text_.reserve(bytes * 4 / 3 + 4); }

    void add(std::uint8_t byte) {
        bits_ = bits_ << 8U | byte;
        for (count_ += 8; count_ >= 6;) {
            count_ -= 6;
            text_ += digits[bits_ >> count_ & 63U];
        }
    }
    /// In groups of seven bits, the lowest first.
    void add_number(std::uint64_t rest) {
        for (; rest >= 128; rest >>= 7U) {
            add(static_cast<std::uint8_t>(rest | 128U));
        }
        add(static_cast<std::uint8_t>(rest));
    }
    [[nodiscard]] std::string finish() && {
        if (count_ > 0) {
            text_ += digits[bits_ << (6U - count_) & 63U];
        }
        text_.append((4 - text_.size() % 4) % 4, '=');
        return std::move(text_);
    }

private:
    std::string text_;
    std::uint32_t bits_ = 0; // the lowest count_ wait
    unsigned count_ = 0;
};

} // namespace

std::string packed_column(const std::vector<std::int64_t>& values) {
    Base64 out(values.size() + values.size() / 2);
    std::int64_t before = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::int64_t step = values[i] - before;
        before = values[i];
        out.add_number(static_cast<std::uint64_t>(step) << 1U ^ static_cast<std::uint64_t>(step >> 63));
        if (step == 0) {
            const std::size_t first = i;
            while (i + 1 < values.size() && values[i + 1] == before) {
                ++i;
            }
            out.add_number(i - first);
        }
    }
    return std::move(out).finish();
}

} // namespace splinefeed::host
