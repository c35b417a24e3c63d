// SPDX-License-Identifier: MIT
// FanucWords: G52, G54.1, G154, G10, G68, G69, G50, G51, G50.1 and G51.1 as Fanuc's and Haas' controls have them.
#pragma once

#include "splinefeed/s0_program/words/coordinate_turn.hpp"
#include "splinefeed/s0_program/words/fanuc_block.hpp"
#include "splinefeed/s0_program/words/fanuc_fault.hpp"

#include <span>

namespace splinefeed {

/// machine = turned(program + G52 + G92) + origin ..., where the program has been mirrored, scaled and turned before.
/// What Fanuc's and Haas' controls do differently, or by a setting, is refused: coordinates_unsuited, and fault().
/// Cost: adapt() reads a block's letters; a program without these words has a few comparisons for each block.
class FanucWords final : public WordExtension {
public:
    /// @param further  origins of G54.1 P1, P2 ... and G154 P1, P2 ..., which are the same; at most 99 are used. It
    /// must outlive this
    explicit FanucWords(std::span<WorkSystem> further) noexcept : further_(further) {}

    void take(std::int32_t tenths, const Block& block, CodeInfo& info) noexcept override;
    BlockStatus adapt(Block& block, const ModalState& modal, const AxisLetters& letters,
                      const ProgramPlace& place) noexcept override;
    bool apply(WorkOffsets& offsets) noexcept override;
    void take_back() noexcept override;
    void end_program() noexcept override;
    [[nodiscard]] const WorkSystem* system() const noexcept override;
    void turn(PerAxis<Decimal>& point, bool back) const noexcept override;
    [[nodiscard]] bool turn_arc(Decimal& radius, Decimal& sweep_deg) const noexcept override;

    /// Of the last block that was refused by coordinates_unsuited.
    [[nodiscard]] FanucFault fault() const noexcept { return fault_; }
    /// Whether G52, G68, G51 or G51.1 is in effect: controls do not agree on what they call a place then.
    [[nodiscard]] bool moves_program() const noexcept;

private:
    /// G words of a block.
    enum Word : unsigned {
        further_word = 1,
        local_word = 2,
        rotate_word = 4,
        end_rotate_word = 8,
        scale_word = 16,
        end_scale_word = 32,
        mirror_word = 64,
        end_mirror_word = 128,
    };

    struct State {
        CoordinateTurn turn{};
        PerAxis<Decimal> local{}; // G52
        std::int32_t further = 0; // number of the system of G54.1 and G154; 0: none
        // Bit k: a turn has changed the place on axis k, and no word has stated it since; and the turn has ended.
        std::uint32_t unstated = 0;
        std::uint32_t lost = 0;
    };
    /// An origin that G10 writes.
    struct Origin {
        bool is_further = false;
        std::int32_t number = 0; // 0: none is written
        WorkSystem value{};
    };

    BlockStatus wrong(const FanucBlock& in, FanucFault fault, char letter) noexcept;
    BlockStatus wrong(const FanucBlock& in, FanucFault fault, CodeGroup group) noexcept;
    BlockStatus read_words(const FanucBlock& in) noexcept;
    BlockStatus check_turned(const FanucBlock& in) noexcept;
    BlockStatus read_system(const FanucBlock& in) noexcept;
    BlockStatus read_origin(const FanucBlock& in) noexcept;
    BlockStatus read_local(const FanucBlock& in) noexcept;
    BlockStatus read_ends(const FanucBlock& in) noexcept;
    BlockStatus read_rotation(const FanucBlock& in) noexcept;
    BlockStatus read_scale(const FanucBlock& in) noexcept;
    BlockStatus begin_mirror(const FanucBlock& in) noexcept;
    BlockStatus check_motion(const FanucBlock& in) noexcept;
    void turned(const FanucBlock& in, bool ends) noexcept;
    static void leave(const FanucBlock& in) noexcept;
    BlockStatus finish(const FanucBlock& in, CodeGroup group, std::uint32_t letters) noexcept;

    std::span<WorkSystem> further_;
    State state_{};
    State next_{};   // behind the block
    State before_{}; // to go back to
    Origin origin_{};
    WorkSystem old_origin_{};
    bool stores_ = false; // the block leaves another state
    bool moves_ = false;  // and other coordinates
    bool applied_ = false;
    unsigned words_ = 0; // of the block that is read
    FanucFault fault_ = FanucFault::none;
};

} // namespace splinefeed
