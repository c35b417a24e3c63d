// SPDX-License-Identifier: MIT
// The sections of a profile that say what a drive does: states, commands, motion, watchdog, init, identity, stays_on.
#include "host_sim/config/profile_keys.hpp"
#include "host_sim/config/profile_sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

// Masks are of the low 32 bits at most.
WholeRange mask_range(const RegisterField& field) {
    return {0, (std::int64_t{1} << std::min<unsigned>(field.width_bits, 32)) - 1};
}

/// A key that is of a field with this role.
void require_written(const TomlChecker& check, const toml::node& node, const DriveProfile& profile, FieldRole role,
                     std::string_view key) {
    const RegisterField* const field = profile.field_of(role);
    if (field == nullptr || !field->writable()) {
        check.fail(node, "{} needs a field that is written, with role = \"{}\"", key,
                   field_role_names[static_cast<std::size_t>(role) - 1]);
    }
}

/// The mask of a table, all bits where it has none. @param range  of the field
std::uint32_t mask_of(const TomlChecker& check, const toml::table& table, const WholeRange& range) {
    const toml::node* const mask = table.get("mask");
    return static_cast<std::uint32_t>(mask != nullptr ? check.whole(*mask, "mask", {1, range.high}) : range.high);
}

FieldTest read_test(const TomlChecker& check, const toml::table& table, const DriveProfile& profile,
                    std::string_view where) {
    FieldTest test;
    test.field = named_field(check, check.required(table, "field", where, "the name of a field"), "field", profile,
                             FieldUse::read);
    const WholeRange range = mask_range(profile.fields[test.field]);
    test.mask = mask_of(check, table, range);
    const toml::node& value = check.required(table, "value", where, "what the bits of the mask must be");
    test.value = static_cast<std::uint32_t>(check.whole(value, "value", range));
    if ((test.value & ~test.mask) != 0) {
        check.fail(value, "value 0x{:X} has bits outside the mask 0x{:X}; it can never be", test.value, test.mask);
    }
    return test;
}

std::optional<FieldTest> optional_test(const TomlChecker& check, const toml::table& motion, std::string_view key,
                                       const DriveProfile& profile) {
    const toml::node* const node = motion.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("{} in [motion]", key);
    const toml::table* const table = node->as_table();
    if (table == nullptr) {
        check.fail(*node, "{} must be like {{field = \"status\", mask = 0x0400, value = 0x0400}}", key);
    }
    check.require_known(*table, test_table, where);
    return read_test(check, *table, profile, where);
}

CommandStep read_step(const TomlChecker& check, const toml::node& node, const DriveProfile& profile,
                      std::string_view command) {
    const std::string where = fmt::format("a step of {}", command);
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        check.fail(node, "{} must be like {{field = \"control\", value = 0x000F}}", where);
    }
    check.require_known(*table, step_table, where);
    CommandStep step;
    step.field = named_field(check, check.required(*table, "field", where, "the name of a field"), "field", profile,
                             FieldUse::write);
    const RegisterField& field = profile.fields[step.field];
    if (field.flash) {
        check.fail(*table, "field {} wears its flash with every write; no command may do so", in_quotes(field.name));
    }
    const WholeRange range = mask_range(field);
    step.mask = mask_of(check, *table, range);
    check.take(*table, step_table, "kind", step.kind);
    const toml::node* const value = table->get("value");
    if (step.kind == StepKind::toggle) {
        if (value != nullptr) {
            check.fail(*value, "a toggle inverts the bits of its mask and has no value; leave value out");
        }
    } else {
        step.value = static_cast<std::uint32_t>(
            check.whole(check.required(*table, "value", where, "what the bits of the mask become"), "value", range));
        if ((step.value & ~step.mask) != 0) {
            check.fail(*value, "value 0x{:X} has bits outside the mask 0x{:X}; widen the mask", step.value, step.mask);
        }
    }
    check.take(*table, step_table, "duration_ms", step.duration_ms);
    if (step.kind == StepKind::pulse && step.duration_ms == 0) {
        check.fail(*table, "{} is a pulse and must have a duration_ms of 1 or more", where);
    }
    return step;
}

} // namespace

void read_states(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    if (const toml::node* node = root.get("states")) {
        profile.cia402 = check.value<int>(*node, profile_table.row("states")) == 0;
    }
    for (const toml::table* table : check.tables(root, "state")) {
        check.require_known(*table, state_table);
        if (profile.cia402) {
            check.fail(*table, "states = \"cia402\" knows its states; leave [[state]] out");
        }
        const toml::node& name = check.required(*table, "name", "[[state]]", "one of the drive's states");
        const auto state = static_cast<DriveState>(check.value<int>(name, state_table.row("name")) + 1);
        profile.states.push_back({state, read_test(check, *table, profile, "[[state]]")});
    }
}

void read_commands(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "command")) {
        check.require_known(*table, command_table);
        const toml::node& name = check.required(*table, "name", "[[command]]", "what it does");
        const auto index = check.value<std::size_t>(name, command_table.row("name"));
        std::vector<CommandStep>& steps = profile.commands[index];
        if (!steps.empty()) {
            check.fail(name, "there are two commands '{}'; write one", command_names[index]);
        }
        constexpr std::string_view form = "a list like [{field = \"control\", value = 0x000F}]";
        const toml::node& list = check.required(*table, "steps", "[[command]]", form);
        for (const toml::node& entry : check.array(list, "steps", form)) {
            steps.push_back(read_step(check, entry, profile, command_names[index]));
        }
        if (steps.empty()) {
            check.fail(list, "command '{}' has no steps; give it one, or leave it out", command_names[index]);
        }
    }
}

void read_motion(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const toml::table* const part = check.part(root, motion_table, "motion");
    if (part == nullptr) {
        return;
    }
    const toml::table& table = *part;
    const RegisterField* const mode = profile.field_of(FieldRole::mode);
    for (const std::string_view key : {"stream_mode", "homing_mode"}) {
        if (const toml::node* value = table.get(key)) {
            require_written(check, *value, profile, FieldRole::mode, key);
            (key == "stream_mode" ? profile.stream_mode : profile.homing_mode) =
                check.whole(*value, key, {mode->lowest, mode->highest});
        }
    }
    check.take(table, motion_table, "change_on_the_fly", profile.change_on_the_fly);
    check.take_ms(table, motion_table, "period_ms", profile.period_us);
    profile.done = optional_test(check, table, "done", profile);
    profile.homed = optional_test(check, table, "homed", profile);
    if (const toml::node* window = table.get("following_error_window_counts")) {
        profile.following_error_window_counts =
            check.value<std::int64_t>(*window, motion_table.row("following_error_window_counts"));
        require_written(check, *window, profile, FieldRole::following_error_window, "following_error_window_counts");
    }
}

void read_watchdog(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const toml::table* const part = check.part(root, watchdog_table, "watchdog");
    if (part == nullptr) {
        return;
    }
    const toml::table& table = *part;
    if (const toml::node* timeout = table.get("timeout_ms")) {
        profile.watchdog_timeout_ms = check.value<std::uint32_t>(*timeout, watchdog_table.row("timeout_ms"));
        require_written(check, *timeout, profile, FieldRole::watchdog, "timeout_ms");
    }
    check.take(table, watchdog_table, "reaction", profile.watchdog_reaction);
}

void read_init(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "init")) {
        check.require_known(*table, init_table);
        DriveProfile::InitialValue initial;
        initial.field = named_field(check, check.required(*table, "field", "[[init]]", "the name of a field"), "field",
                                    profile, FieldUse::write);
        const RegisterField& field = profile.fields[initial.field];
        if (field.flash && !field.readable()) {
            check.fail(*table,
                       "field {} wears its flash and cannot be read, so nobody knows whether it must "
                       "be written; leave it out",
                       in_quotes(field.name));
        }
        initial.value = check.whole(check.required(*table, "value", "[[init]]", "what the register gets"), "value",
                                    {field.lowest, field.highest});
        profile.init.push_back(initial);
    }
}

void read_checks(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const auto read = [&](std::string_view key, const FileTable& keys, std::string_view when,
                          std::vector<DriveProfile::SetupCheck>& checks) {
        for (const toml::table* table : check.tables(root, key)) {
            check.require_known(*table, keys);
            checks.push_back({read_test(check, *table, profile, keys.where),
                              check.text(check.required(*table, "sentence", keys.where, when), "sentence")});
        }
    };
    read("identity", identity_table, "what to tell where it does not hold", profile.identity);
    read("stays_on", stays_on_table, "what keeps the motor on, and what to set", profile.stays_on);
}

} // namespace splinefeed::host
