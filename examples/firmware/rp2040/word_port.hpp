// SPDX-License-Identifier: MIT
// WordPort: the RP2040's PIO executes the words of WordLines, fed by DMA. Registers: "RP2040 Datasheet", 3 and 2.5.
#pragma once

#include "rp2040/registers.hpp"
#include "word_lines.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace rp2040 {

/// Each of four DMA channels has the words of a batch of ticks, and triggers the next one: one is executed, others
/// wait, and one is free for the next batch.
class WordPort {
public:
    static constexpr std::uint32_t most_words = 256; ///< of a batch

    /// @param pins  that the words switch   @param levels  that they have until then
    void start(std::uint32_t pins, std::uint32_t levels) noexcept {
        constexpr std::uint32_t out_pins = 0x6000; // out pins, 32
        constexpr std::uint32_t out_x = 0x6020;    // out x, 32
        constexpr std::uint32_t loop = 0x0042;     // 2: jmp x-- 2
        reg(PIO0_INSTR_MEM0) = out_pins;
        reg(PIO0_INSTR_MEM0 + 4) = out_x;
        reg(PIO0_INSTR_MEM0 + 8) = loop;
        reg(PIO0_SM0_CLKDIV) = 1U << 16;
        reg(PIO0_SM0_EXECCTRL) = 2U << 12;                        // wraps from 2 to 0
        reg(PIO0_SM0_SHIFTCTRL) = 1U << 30 | 1U << 19 | 1U << 17; // the FIFOs joined, to the right, autopull of 32 bits
        reg(PIO0_SM0_PINCTRL) = 32U << 20;                        // all pins, from 0
        execute(levels, out_pins);
        constexpr std::uint32_t out_directions = 0x6080; // out pindirs, 32
        execute(pins, out_directions);
        pins_ = pins;
        for (std::uint32_t channel = 0; channel < channels; ++channel) {
            reg(dma(channel, DMA_WRITE_ADDR)) = PIO0_TXF0;
        }
        end_ = batch_[0].data();
        reg(PIO0_CTRL) = 1;
    }

    /// Whether there is room for a batch.
    [[nodiscard]] bool has_room() noexcept {
        while (waiting_ > 0 && !is_busy(before(waiting_))) {
            --waiting_;
        }
        return waiting_ < channels;
    }

    /// @pre has_room() for its batch; at least 3 cycles
    void operator()(firmware::LineWord word) noexcept {
        constexpr std::uint32_t own = 3; // a cycle each of: out, out, the jump that ends the loop
        *end_++ = {word.levels, word.cycles - own};
    }

    /// Hands the batch over.
    void send() noexcept {
        const auto words = static_cast<std::uint32_t>(end_ - batch_[next_].data());
        if (words == 0) {
            return;
        }
        std::atomic_signal_fence(std::memory_order_release); // the words are in memory before the DMA is told of them
        reg(dma(next_, DMA_READ_ADDR)) = address_of(next_);
        reg(dma(next_, DMA_TRANS_COUNT)) = 2 * words;
        reg(dma(next_, DMA_AL1_CTRL)) = control(next_);
        size_[next_] = words;
        if (waiting_ > 0) {
            reg(dma(before(1), DMA_AL1_CTRL)) = control(next_);
        }
        static_cast<void>(has_room()); // one that ended before it was told of its successor has not triggered it
        if (waiting_ == 0) {
            reg(DMA_MULTI_CHAN_TRIGGER) = 1U << next_; // no effect on one that is busy
        }
        ++waiting_;
        next_ = (next_ + 1) % channels;
        end_ = batch_[next_].data();
    }

    /// As WordLines::cut asks for it.
    template <class Seen>
    std::uint32_t cut(std::uint32_t levels, Seen&& seen) noexcept {
        reg(PIO0_CTRL) = 0;
        for (int cycles = 0; cycles < 16; ++cycles) { // until the FIFO is full, or the transfers have ended
            __asm__ volatile("nop");
        }
        static_cast<void>(has_room());
        const std::uint32_t kept = reg(PIO0_DBG_PADOUT) & pins_;
        // Registers that are not executed: those in the FIFO, and what the oldest transfer and those behind it have
        // left.
        const std::uint32_t oldest = before(waiting_);
        std::uint32_t back = reg(PIO0_FLEVEL) & 0xfU;
        std::uint32_t channel = oldest;
        std::uint32_t taken = waiting_ == 0 ? 0 : (reg(dma(oldest, DMA_READ_ADDR)) - address_of(oldest)) / 4;
        while (back > taken) { // they are of transfers before it
            back -= taken;
            channel = (channel + channels - 1) % channels;
            taken = 2 * size_[channel];
        }
        std::uint32_t word = (taken - back) / 2;
        // The levels of a word that is begun may still wait to be shown.
        if ((taken - back) % 2 == 1 && batch_[channel][word].levels == kept) {
            ++word;
        }
        std::uint32_t before_them = kept;
        const auto forget = [&](std::uint32_t channel_of, std::uint32_t from, std::uint32_t size) {
            for (std::uint32_t i = from; i < size; ++i) {
                seen(before_them, batch_[channel_of][i].levels);
                before_them = batch_[channel_of][i].levels;
            }
        };
        for (; channel != next_; channel = (channel + 1) % channels, word = 0) {
            forget(channel, word, size_[channel]);
        }
        forget(next_, word, static_cast<std::uint32_t>(end_ - batch_[next_].data()));
        seen(before_them, levels);
        restart();
        return kept;
    }

private:
    static constexpr std::uint32_t channels = 4;

    [[nodiscard]] static constexpr std::uint32_t control(std::uint32_t chained) noexcept {
        // Quiet, paced by the FIFO of the state machine, from one address to the next, words, high priority, on.
        return 1U << 21 | 0U << 15 | chained << 11 | 1U << 4 | 2U << 2 | 1U << 1 | 1U;
    }
    [[nodiscard]] static bool is_busy(std::uint32_t channel) noexcept {
        return (reg(dma(channel, DMA_AL1_CTRL)) & 1U << 24) != 0;
    }
    /// The channel so many batches before the next one.
    [[nodiscard]] std::uint32_t before(std::uint32_t batches) const noexcept {
        return (next_ + channels - batches) % channels;
    }
    [[nodiscard]] std::uint32_t address_of(std::uint32_t channel) const noexcept {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(batch_[channel].data()));
    }
    /// One instruction that shifts 32 bits out.
    static void execute(std::uint32_t bits, std::uint32_t instruction) noexcept {
        constexpr std::uint32_t pull = 0x80a0; // pull block
        reg(PIO0_TXF0) = bits;
        reg(PIO0_SM0_INSTR) = pull;
        reg(PIO0_SM0_INSTR) = instruction;
    }
    void restart() noexcept {
        constexpr std::uint32_t all = (1U << channels) - 1U;
        for (std::uint32_t channel = 0; channel < channels; ++channel) {
            reg(dma(channel, DMA_AL1_CTRL)) = control(channel) & ~1U; // none triggers another one
        }
        reg(DMA_CHAN_ABORT) = all;
        while ((reg(DMA_CHAN_ABORT) & all) != 0) {
        }
        constexpr std::uint32_t joined = 1U << 30;
        reg(PIO0_SM0_SHIFTCTRL) = reg(PIO0_SM0_SHIFTCTRL) ^ joined; // empties the FIFO
        reg(PIO0_SM0_SHIFTCTRL) = reg(PIO0_SM0_SHIFTCTRL) ^ joined;
        constexpr std::uint32_t to_begin = 0; // jmp 0
        reg(PIO0_SM0_INSTR) = to_begin;
        reg(PIO0_CTRL) = 1U << 4 | 1; // restarted: the shift register is empty, too
        waiting_ = 0;
        end_ = batch_[next_].data();
    }

    std::array<std::array<firmware::LineWord, most_words>, channels> batch_{};
    std::array<std::uint32_t, channels> size_{}; // of its batch
    firmware::LineWord* end_ = nullptr;          // of the batch that is made
    std::uint32_t waiting_ = 0;                  // batches that may not have ended
    std::uint32_t next_ = 0;                     // channel of the next batch
    std::uint32_t pins_ = 0;
};

} // namespace rp2040
