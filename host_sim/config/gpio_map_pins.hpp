// SPDX-License-Identifier: MIT
// GpioMapPins: the lines of a map file or a machine file, each used once, grouped by chip.
#pragma once

#include "host_sim/base/toml_checker.hpp"

#include "splinefeed/hal/gpio/pin_map.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace splinefeed::host {

/// Fills the list of chips of a PinMap, or of ProgramPins. Its members throw InputError, with the line of the error.
class GpioMapPins {
public:
    /// What a line may be given as, for messages.
    static constexpr std::string_view what =
        "a line's name like \"X_STEP\", its offset like 4, or { offset = 4, name = \"X_STEP\" }";

    /// @param chip  chip of lines for which the file names none; empty: each has to name one
    GpioMapPins(const TomlChecker& check, std::string chip, std::vector<hal::gpio::ChipPins>& chips)
        : check_(check), default_chip_(std::move(chip)), chips_(chips) {}

    /// @param node  a name, an offset, or a table with chip, offset and name
    /// @param key  key of the node, for messages
    hal::gpio::PinBit output(const toml::node& node, std::string_view key, bool safe_level);
    /// Inputs may share a line if all name it in the same way and have the same bias.
    hal::gpio::PinBit input(const toml::node& node, std::string_view key, hal::gpio::Bias bias);

    /// The whole path of a chip, or its label.
    [[nodiscard]] static std::string chip_path(const TomlChecker& check, const toml::node& node);

private:
    struct Wanted {
        std::string chip;
        hal::gpio::PinName line;
    };
    struct Input {
        Wanted wanted;
        hal::gpio::Bias bias;
        hal::gpio::PinBit bit;
    };

    [[nodiscard]] std::string name(const toml::node& node, std::string_view key) const;
    [[nodiscard]] unsigned offset(const toml::node& node, std::string_view key) const;
    [[nodiscard]] Wanted wanted(const toml::node& node, std::string_view key) const;
    [[nodiscard]] Wanted wanted_line(const toml::node& node, std::string_view key) const;
    void require_unused(const toml::node& node, std::string_view key, const Wanted& line);
    std::size_t chip_index(const std::string& chip);
    template <class Request>
    hal::gpio::PinBit add(const toml::node& node, std::size_t chip, std::vector<Request>& requests,
                          const Request& request) const;

    const TomlChecker& check_;
    std::string default_chip_;
    std::vector<hal::gpio::ChipPins>& chips_;
    std::map<std::pair<std::string, std::string>, std::string> used_; ///< key that uses each chip and line
    std::vector<Input> inputs_;
};

} // namespace splinefeed::host
