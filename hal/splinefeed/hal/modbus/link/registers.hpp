// SPDX-License-Identifier: MIT
// RegisterWriter, RegisterReader: numbers in 16-bit Modbus registers, most significant register first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed::hal::modbus {

/// Write and read consecutive numbers of one to three registers, as in the map splinefeed-pvt.
/// @pre the span is large enough: callers size blocks by the map
class RegisterWriter {
public:
    explicit RegisterWriter(std::span<std::uint16_t> registers) noexcept : registers_(registers) {}

    void put16(std::uint32_t value) noexcept { registers_[at_++] = static_cast<std::uint16_t>(value & 0xFFFFU); }
    void put32(std::uint32_t value) noexcept {
        put16(value >> 16U);
        put16(value);
    }
    /// Two's complement. @pre -2^47 <= value < 2^47
    void put48(std::int64_t value) noexcept {
        const auto bits = static_cast<std::uint64_t>(value);
        put16(static_cast<std::uint32_t>((bits >> 32U) & 0xFFFFU));
        put32(static_cast<std::uint32_t>(bits & 0xFFFFFFFFU));
    }
    /// These numbers, in as many registers as their types have; std::int64_t in three.
    template <class... Numbers>
    void pass(const Numbers&... numbers) noexcept {
        (put(numbers), ...);
    }

    [[nodiscard]] std::size_t size() const noexcept { return at_; }

private:
    template <class Number>
    void put(Number number) noexcept {
        if constexpr (sizeof(Number) == 2) {
            put16(static_cast<std::uint16_t>(number));
        } else if constexpr (sizeof(Number) == 4) {
            put32(static_cast<std::uint32_t>(number));
        } else {
            put48(number);
        }
    }

    std::span<std::uint16_t> registers_;
    std::size_t at_ = 0;
};

class RegisterReader {
public:
    explicit RegisterReader(std::span<const std::uint16_t> registers) noexcept : registers_(registers) {}

    [[nodiscard]] std::uint16_t take16() noexcept { return registers_[at_++]; }
    [[nodiscard]] std::uint32_t take32() noexcept {
        const std::uint32_t high = take16();
        return high << 16U | take16();
    }
    [[nodiscard]] std::int64_t take48() noexcept {
        const std::uint64_t high = take16();
        const std::uint64_t bits = high << 32U | take32();
        constexpr std::uint64_t sign = std::uint64_t{1} << 47U;
        return static_cast<std::int64_t>(bits ^ sign) - static_cast<std::int64_t>(sign);
    }

    /// What RegisterWriter::pass() has written of numbers of these types.
    template <class... Numbers>
    void pass(Numbers&... numbers) noexcept {
        ((numbers = next<Numbers>()), ...);
    }

private:
    template <class Number>
    [[nodiscard]] Number next() noexcept {
        if constexpr (sizeof(Number) == 2) {
            return static_cast<Number>(take16());
        } else if constexpr (sizeof(Number) == 4) {
            return static_cast<Number>(take32());
        } else {
            return take48();
        }
    }

    std::span<const std::uint16_t> registers_;
    std::size_t at_ = 0;
};

} // namespace splinefeed::hal::modbus
