// SPDX-License-Identifier: MIT
#include "host_sim/config/io_modules.hpp"

#include "host_sim/config/machine_keys.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

IoModules::IoModules(const TomlChecker& check, const toml::table& root, std::vector<IoModule>& modules)
    : check_(check), modules_(modules) {
    check_.attempt([&] {
        for (const toml::table* const table : check_.tables(root, "module")) {
            IoModule module;
            module.name = (*table)["name"].value_or(std::string()); // what names a wrong module is not wrong itself
            check_.attempt([&] {
                module = read(*table);
                require_own_place(*table, module);
            });
            modules_.push_back(std::move(module));
        }
    });
}

IoModule IoModules::read(const toml::table& table) const {
    check_.require_known(table, module_table);
    IoModule module;
    module.name = check_.text(check_.required(table, "name", "[[module]]", "a name"), "name");
    const toml::node& address = check_.required(table, "address", "[[module]]", "modbus-tcp://HOST:PORT?unit=1");
    try {
        module.address = parse_drive_address(check_.text(address, "address"));
    } catch (const AddressError& error) {
        check_.fail(address, "address: {}", error.what());
    }
    check_.take(table, module_table, "response_timeout_ms", module.answer_ms);
    return module;
}

// Modules of one wire are units of it, and hear the same rate.
void IoModules::require_own_place(const toml::table& table, const IoModule& module) const {
    const hal::modbus::LinkAddress& link = module.address.link;
    for (const IoModule& other : modules_) {
        hal::modbus::LinkAddress same_unit = other.address.link;
        if (other.name == module.name) {
            check_.fail(table, "this is the second module {}; give each a name of its own", in_quotes(module.name));
        }
        if (!same_unit.same_wire(link)) {
            continue;
        }
        if (same_unit.unit == link.unit) {
            check_.fail(table,
                        "module {} has the address of module {}; give it another unit, or name one "
                        "of both alone",
                        in_quotes(module.name), in_quotes(other.name));
        }
        same_unit.unit = link.unit;
        if (same_unit != link) {
            check_.fail(table,
                        "module {} is on the line of module {}, with another baud, parity or stop; "
                        "a line has one of each",
                        in_quotes(module.name), in_quotes(other.name));
        }
    }
}

bool IoModules::is_named(const toml::table& table, std::string_view where) const {
    const toml::node* named = nullptr;
    for (const std::string_view key : {"module", "coil", "input"}) {
        named = named == nullptr ? table.get(key) : named;
    }
    if (named != nullptr && (table.contains("line") || table.contains("bias"))) {
        check_.fail(*named, "{} names a line and a module; leave one out", where);
    }
    return named != nullptr;
}

std::size_t IoModules::module_of(const toml::table& table, const std::string& where) const {
    const toml::node& node = check_.required(table, "module", where, "the name of a [[module]]");
    const std::string name = check_.text(node, "module");
    for (std::size_t i = 0; i < modules_.size(); ++i) {
        if (modules_[i].name == name) {
            return i;
        }
    }
    check_.fail(node, "{} names module {}, and there is no [[module]] with name = \"{}\"; add it", where,
                in_quotes(name), name);
}

int IoModules::address(const toml::table& table, std::string_view key, const std::string& where) const {
    const toml::node& node =
        check_.required(table, key, where, fmt::format("the number of the {} in its module, from 0", key));
    return static_cast<int>(check_.whole(node, key, TomlChecker::whole_range(coil_key)));
}

SwitchedCoil IoModules::coil(const toml::table& table, const std::string& where, bool on_level) {
    const SwitchedCoil coil{module_of(table, where), address(table, "coil", where), on_level};
    const auto [before, unused] = used_.emplace(std::tuple(coil.module, coil.address), where);
    if (!unused) {
        check_.fail(*table.get("coil"),
                    "{} is coil {} of module {}, which is {} already; each needs a "
                    "coil of its own",
                    where, coil.address, in_quotes(modules_[coil.module].name), before->second);
    }
    return coil;
}

SensedBit IoModules::bit(const toml::table& table, const std::string& where, bool active_level) const {
    using hal::modbus::BitTable;
    const toml::node* const coil = table.get("coil");
    if (coil != nullptr && table.contains("input")) {
        check_.fail(*coil, "{} names an input and a coil; leave one out", where);
    }
    return {module_of(table, where), coil != nullptr ? BitTable::coils : BitTable::inputs,
            address(table, coil != nullptr ? "coil" : "input", where), active_level};
}

} // namespace splinefeed::host
