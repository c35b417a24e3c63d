// SPDX-License-Identifier: MIT
// IoModules: the tables [[module]] of a machine file, and the bits of these modules that other tables name.
#pragma once

#include "host_sim/base/toml_checker.hpp"
#include "host_sim/config/program_pins.hpp"

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace splinefeed::host {

/// Fills the list of modules of ProgramPins. Its members throw InputError, with the line of the error.
class IoModules {
public:
    /// Reads all [[module]] of the file.
    IoModules(const TomlChecker& check, const toml::table& root, std::vector<IoModule>& modules);

    /// Whether a table names a bit of a module, and not a line. Throws if it names parts of both.
    [[nodiscard]] bool is_named(const toml::table& table, std::string_view where) const;
    /// The coil of a table with `module` and `coil`, which nothing else switches. @param where  the table, for messages
    [[nodiscard]] SwitchedCoil coil(const toml::table& table, const std::string& where, bool on_level);
    /// The bit of a table with `module`, and `input` or `coil`.
    [[nodiscard]] SensedBit bit(const toml::table& table, const std::string& where, bool active_level) const;

private:
    [[nodiscard]] IoModule read(const toml::table& table) const;
    void require_own_place(const toml::table& table, const IoModule& module) const;
    [[nodiscard]] std::size_t module_of(const toml::table& table, const std::string& where) const;
    [[nodiscard]] int address(const toml::table& table, std::string_view key, const std::string& where) const;

    const TomlChecker& check_;
    std::vector<IoModule>& modules_;
    std::map<std::tuple<std::size_t, int>, std::string> used_; ///< table that switches each coil of a module
};

} // namespace splinefeed::host
