// SPDX-License-Identifier: MIT
#include "host_sim/config/profile_file.hpp"

#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/profile_keys.hpp"
#include "host_sim/config/profile_sections.hpp"

#include <array>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

std::string name_of_profile(const TomlChecker& check, const toml::table& root) {
    const toml::node& node = check.required(root, "name", "the profile", "a text like \"maker-mode\"");
    std::string name = check.text(node, "name");
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos) {
        check.fail(node, "name is {}; it must be of small letters, digits and -", in_quotes(name));
    }
    return name;
}

void require_role(const TomlChecker& check, const DriveProfile& profile, FieldRole role, std::string_view name,
                  bool written) {
    const RegisterField* const field = profile.field_of(role);
    if (field == nullptr || (written ? !field->writable() : !field->readable())) {
        check.fail_file("stream = \"{}\" needs a field that is {}, with role = \"{}\"",
                        stream_names[static_cast<std::size_t>(profile.stream)], written ? "written" : "read", name);
    }
}

// A VFD: the speed is written and read back, and the commands set levels, so repeating one changes nothing.
void require_speed(const TomlChecker& check, const DriveProfile& profile) {
    require_role(check, profile, FieldRole::target_velocity, "target_velocity", true);
    require_role(check, profile, FieldRole::actual_velocity, "actual_velocity", false);
    constexpr std::array<std::pair<DriveCommand, std::string_view>, 3> spindle{
        {{DriveCommand::forward, "forward"}, {DriveCommand::stop, "stop"}, {DriveCommand::reverse, "reverse"}}};
    for (const auto& [command, name] : spindle) {
        const std::vector<CommandStep>& steps = profile.steps_of(command);
        if (steps.empty() && command != DriveCommand::reverse) {
            check.fail_file(
                "stream = \"speed\" needs the command {0}; write [[command]] with name = \"{0}\" and its steps", name);
        }
        for (const CommandStep& step : steps) {
            if (step.kind != StepKind::level) {
                check.fail_file("a step of {} must be of kind \"level\" with stream = \"speed\"", name);
            }
        }
    }
}

// What the way of streaming cannot do without.
void require_complete(const TomlChecker& check, const DriveProfile& profile) {
    if (profile.stream == StreamWay::pvt) {
        if (!profile.link.has(16)) {
            check.fail_file("stream = \"pvt\" needs function 16 in `functions` of [link]: segments are written by it");
        }
        return;
    }
    if (profile.stream == StreamWay::speed) {
        require_speed(check, profile);
        return;
    }
    require_role(check, profile, FieldRole::status, "status", false);
    require_role(check, profile, FieldRole::actual_position, "actual_position", false);
    require_role(check, profile, FieldRole::target_position, "target_position", true);
    if (profile.cia402) {
        require_role(check, profile, FieldRole::control, "control", true);
    } else if (profile.states.empty()) {
        check.fail_file("there is no state; write states = \"cia402\", or [[state]] for each that the drive tells");
    }
    constexpr std::array<std::pair<DriveCommand, std::string_view>, 4> needed{
        {{DriveCommand::enable, "enable"},
         {DriveCommand::disable, "disable"},
         {DriveCommand::fault_reset, "fault_reset"},
         {DriveCommand::quick_stop, "quick_stop"}}};
    for (const auto& [command, name] : needed) {
        if (profile.steps_of(command).empty()) {
            check.fail_file("there is no command {0}; write [[command]] with name = \"{0}\" and its steps", name);
        }
    }
    if (profile.stream == StreamWay::blocks) {
        require_role(check, profile, FieldRole::profile_velocity, "profile_velocity", true);
        if (profile.steps_of(DriveCommand::start_move).empty()) {
            check.fail_file("stream = \"blocks\" needs the command start_move: how a block is started");
        }
        if (!profile.change_on_the_fly) {
            check.fail_file(
                "stream = \"blocks\" needs change_on_the_fly = true in [motion]: a drive that finishes each "
                "block at rest cannot follow a path");
        }
    }
}

// What nobody would heed.
void refuse_unused(const TomlChecker& check, const toml::table& root, StreamWay stream) {
    constexpr std::string_view of_axes[] = {"group", "watchdog", "init", "identity", "stays_on"};
    for (const std::string_view key : of_axes) {
        if (const toml::node* node = root.get(key); node != nullptr && stream == StreamWay::speed) {
            check.fail(*node, "{} is for drives that move an axis; with stream = \"speed\" leave it out", key);
        }
    }
}

DriveProfile profile_of(const toml::table& root, const std::string& file) {
    const TomlChecker check(file, "docs/reference/profiles.md");
    check.require_known(root, profile_table);
    DriveProfile profile;
    profile.name = name_of_profile(check, root);
    profile.drive = check.text(check.required(root, "drive", "the profile", "a text: makes and models"), "drive");
    profile.sources = check.texts(
        check.required(root, "sources", "the profile", "a list of texts: where its registers and values come from"),
        "sources", false);
    profile.not_verified = check.texts(
        check.required(root, "not_verified", "the profile", "a list of texts: what was not tried on hardware"),
        "not_verified", true);
    profile.stream = static_cast<StreamWay>(
        check.choice(check.required(root, "stream", "the profile", "\"pvt\", \"cyclic\", \"blocks\" or \"speed\""),
                     "stream", stream_names));
    check.take(root, profile_table, "axes", profile.axes);
    if (profile.axes > 1 && profile.stream != StreamWay::pvt) {
        check.fail(*root.get("axes"), "axes beyond 1 are for stream = \"pvt\" alone; leave axes out");
    }
    refuse_unused(check, root, profile.stream);
    read_link(check, root, profile);
    read_fields(check, root, profile);
    read_groups(check, root, profile);
    read_states(check, root, profile);
    read_commands(check, root, profile);
    read_motion(check, root, profile);
    read_watchdog(check, root, profile);
    read_init(check, root, profile);
    read_checks(check, root, profile);
    require_complete(check, profile);
    return profile;
}

} // namespace

DriveProfile parse_profile(std::string_view text, const std::string& file) {
    return profile_of(parse_toml(text, file), file);
}

DriveProfile read_profile_file(const std::string& path) {
    constexpr std::size_t largest = std::size_t{1} << 20;
    return parse_profile(read_text_file(path, largest), path);
}

} // namespace splinefeed::host
