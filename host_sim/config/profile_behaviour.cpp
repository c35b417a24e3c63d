// SPDX-License-Identifier: MIT
// The sections of a profile that say what a drive does: states, commands, motion, watchdog, init, identity.
#include "host_sim/config/profile_sections.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::array<std::string_view, drive_states> state_names{
    "unknown", "not_ready", "disabled", "enabled", "moving", "homing", "halted", "quick_stop", "fault"};
constexpr std::array<std::string_view, drive_commands> command_names{"enable",  "disable", "fault_reset", "start_move",
                                                                     "halt",    "resume",  "quick_stop",  "home",
                                                                     "forward", "reverse", "stop"};
constexpr std::array<std::string_view, 4> kind_names{"level", "edge", "pulse", "toggle"};
constexpr std::array<std::string_view, 5> reaction_names{"none", "stop", "quick_stop", "disable", "fault"};

// Masks are of the low 32 bits at most.
WholeRange mask_range(const RegisterField& field) {
    return {0, field.width_bits == 16 ? 0xFFFF : 0xFFFFFFFF};
}

FieldTest read_test(const TomlChecker& check, const toml::table& table, const DriveProfile& profile,
                    std::string_view where) {
    FieldTest test;
    test.field = named_field(check, check.required(table, "field", where, "the name of a field"), "field", profile,
                             FieldUse::read);
    const WholeRange range = mask_range(profile.fields[test.field]);
    test.mask = static_cast<std::uint32_t>(range.high);
    check.take(table, "mask", {1, range.high}, test.mask);
    const toml::node& value = check.required(table, "value", where, "what the bits of the mask must be");
    test.value = static_cast<std::uint32_t>(check.whole(value, "value", range));
    if ((test.value & ~test.mask) != 0) {
        check.fail(value, fmt::format("value 0x{:X} has bits outside the mask 0x{:X}; it can never be", test.value,
                                      test.mask));
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
        check.fail(*node, fmt::format("{} must be like {{field = \"status\", mask = 0x0400, value = 0x0400}}", key));
    }
    check.require_known(*table, {"field", "mask", "value"}, where);
    return read_test(check, *table, profile, where);
}

CommandStep read_step(const TomlChecker& check, const toml::node& node, const DriveProfile& profile,
                      std::string_view command) {
    constexpr std::uint32_t longest_ms = 60000;
    const std::string where = fmt::format("a step of {}", command);
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        check.fail(node, fmt::format("{} must be like {{field = \"control\", value = 0x000F}}", where));
    }
    check.require_known(*table, {"field", "mask", "value", "kind", "duration_ms"}, where);
    CommandStep step;
    step.field = named_field(check, check.required(*table, "field", where, "the name of a field"), "field", profile,
                             FieldUse::write);
    const RegisterField& field = profile.fields[step.field];
    if (field.flash) {
        check.fail(*table, fmt::format("field {} wears its flash with every write; no command may do so",
                                       in_quotes(field.name)));
    }
    const WholeRange range = mask_range(field);
    step.mask = static_cast<std::uint32_t>(range.high);
    check.take(*table, "mask", {1, range.high}, step.mask);
    if (const toml::node* kind = table->get("kind")) {
        step.kind = static_cast<StepKind>(check.choice(*kind, "kind", kind_names));
    }
    const toml::node* const value = table->get("value");
    if (step.kind == StepKind::toggle) {
        if (value != nullptr) {
            check.fail(*value, "a toggle inverts the bits of its mask and has no value; leave value out");
        }
    } else {
        step.value = static_cast<std::uint32_t>(
            check.whole(check.required(*table, "value", where, "what the bits of the mask become"), "value", range));
        if ((step.value & ~step.mask) != 0) {
            check.fail(*value, fmt::format("value 0x{:X} has bits outside the mask 0x{:X}; widen the mask", step.value,
                                           step.mask));
        }
    }
    check.take(*table, "duration_ms", {0, longest_ms}, step.duration_ms);
    if (step.kind == StepKind::pulse && step.duration_ms == 0) {
        check.fail(*table, fmt::format("{} is a pulse and must have a duration_ms of 1 or more", where));
    }
    return step;
}

} // namespace

void read_states(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    if (const toml::node* node = root.get("states")) {
        constexpr std::array<std::string_view, 2> machines{"cia402", "masks"};
        profile.cia402 = check.choice(*node, "states", machines) == 0;
    }
    for (const toml::table* table : check.tables(root, "state")) {
        check.require_known(*table, {"name", "field", "mask", "value"}, "[[state]]");
        if (profile.cia402) {
            check.fail(*table, "states = \"cia402\" knows its states; leave [[state]] out");
        }
        const toml::node& name = check.required(*table, "name", "[[state]]", "one of the drive's states");
        const auto state = static_cast<DriveState>(check.choice(name, "name", std::span(state_names).subspan(1)) + 1);
        profile.states.push_back({state, read_test(check, *table, profile, "[[state]]")});
    }
}

void read_commands(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "command")) {
        check.require_known(*table, {"name", "steps"}, "[[command]]");
        const toml::node& name = check.required(*table, "name", "[[command]]", "what it does");
        const std::size_t index = check.choice(name, "name", command_names);
        std::vector<CommandStep>& steps = profile.commands[index];
        if (!steps.empty()) {
            check.fail(name, fmt::format("there are two commands '{}'; write one", command_names[index]));
        }
        constexpr std::string_view form = "a list like [{field = \"control\", value = 0x000F}]";
        const toml::node& list = check.required(*table, "steps", "[[command]]", form);
        for (const toml::node& entry : check.array(list, "steps", form)) {
            steps.push_back(read_step(check, entry, profile, command_names[index]));
        }
        if (steps.empty()) {
            check.fail(list,
                       fmt::format("command '{}' has no steps; give it one, or leave it out", command_names[index]));
        }
    }
}

void read_motion(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const toml::node* const node = root.get("motion");
    if (node == nullptr) {
        return;
    }
    constexpr double longest_period_ms = 1000.0;
    constexpr std::int64_t most_window_counts = 0x7FFFFFFF;
    const toml::table& table = check.table(*node, "motion");
    check.require_known(table,
                        {"stream_mode", "homing_mode", "change_on_the_fly", "period_ms", "done", "homed",
                         "following_error_window_counts"},
                        "[motion]");
    const RegisterField* const mode = profile.field_of(FieldRole::mode);
    for (const std::string_view key : {"stream_mode", "homing_mode"}) {
        if (const toml::node* value = table.get(key)) {
            if (mode == nullptr || !mode->writable()) {
                check.fail(*value, fmt::format("{} needs a field that is written, with role = \"mode\"", key));
            }
            (key == "stream_mode" ? profile.stream_mode : profile.homing_mode) =
                check.whole(*value, key, {mode->lowest, mode->highest});
        }
    }
    check.take_flag(table, "change_on_the_fly", profile.change_on_the_fly);
    check.take_ms(table, "period_ms", longest_period_ms, profile.period_us);
    profile.done = optional_test(check, table, "done", profile);
    profile.homed = optional_test(check, table, "homed", profile);
    if (const toml::node* window = table.get("following_error_window_counts")) {
        profile.following_error_window_counts =
            check.whole(*window, "following_error_window_counts", {1, most_window_counts});
        const RegisterField* const field = profile.field_of(FieldRole::following_error_window);
        if (field == nullptr || !field->writable()) {
            check.fail(*window, "following_error_window_counts needs a field that is written, with role = "
                                "\"following_error_window\"");
        }
    }
}

void read_watchdog(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const toml::node* const node = root.get("watchdog");
    if (node == nullptr) {
        return;
    }
    constexpr std::int64_t longest = 60000;
    const toml::table& table = check.table(*node, "watchdog");
    check.require_known(table, {"timeout_ms", "reaction"}, "[watchdog]");
    if (const toml::node* timeout = table.get("timeout_ms")) {
        profile.watchdog_timeout_ms = static_cast<std::uint32_t>(check.whole(*timeout, "timeout_ms", {1, longest}));
        const RegisterField* const field = profile.field_of(FieldRole::watchdog);
        if (field == nullptr || !field->writable()) {
            check.fail(*timeout, "timeout_ms needs a field that is written, with role = \"watchdog\"");
        }
    }
    if (const toml::node* reaction = table.get("reaction")) {
        profile.watchdog_reaction = static_cast<WatchdogReaction>(check.choice(*reaction, "reaction", reaction_names));
    }
}

void read_init(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "init")) {
        check.require_known(*table, {"field", "value"}, "[[init]]");
        DriveProfile::InitialValue initial;
        initial.field = named_field(check, check.required(*table, "field", "[[init]]", "the name of a field"), "field",
                                    profile, FieldUse::write);
        const RegisterField& field = profile.fields[initial.field];
        if (field.flash && !field.readable()) {
            check.fail(*table,
                       fmt::format("field {} wears its flash and cannot be read, so nobody knows whether it must "
                                   "be written; leave it out",
                                   in_quotes(field.name)));
        }
        initial.value = check.whole(check.required(*table, "value", "[[init]]", "what the register gets"), "value",
                                    {field.lowest, field.highest});
        profile.init.push_back(initial);
    }
}

void read_identity(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "identity")) {
        check.require_known(*table, {"field", "mask", "value", "sentence"}, "[[identity]]");
        profile.identity.push_back(
            {read_test(check, *table, profile, "[[identity]]"),
             check.text(check.required(*table, "sentence", "[[identity]]", "what to tell where it does not hold"),
                        "sentence")});
    }
}

} // namespace splinefeed::host
