// SPDX-License-Identifier: MIT
#include "host_sim/config/state_file.hpp"

#include "host_sim/base/durable_file.hpp"
#include "host_sim/base/file_claims.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/json_text.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/decimal_number.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_file = 1U << 16U;
constexpr double largest_mm = 1048576.0;
constexpr int state_version = 2;

Json numbers(const PerAxis<Decimal>& values, std::size_t axes) {
    Json json = Json::array();
    for (std::size_t k = 0; k < axes; ++k) {
        json.push_back(number_of(values[k]));
    }
    return json;
}

class StateReader {
public:
    StateReader(const nlohmann::json& json, std::string file, std::size_t axes)
        : json_(json), file_(std::move(file)), axes_(axes) {}

    [[noreturn]] void fail(std::string_view key) const {
        throw InputError(file_, 0,
                         "\"{}\" is missing or wrong; a state file is written by --state, and not by hand. "
                         "Remove it to begin with offsets of 0",
                         key);
    }
    [[nodiscard]] double value(const nlohmann::json& json, const char* key) const {
        if (!json.is_number() || !(std::fabs(json.get<double>()) <= largest_mm)) {
            fail(key);
        }
        return json.get<double>();
    }
    [[nodiscard]] const nlohmann::json& member(const nlohmann::json& json, const char* key) const {
        const auto found = json.is_object() ? json.find(key) : json.end();
        if (!json.is_object() || found == json.end()) {
            fail(key);
        }
        return *found;
    }
    [[nodiscard]] const nlohmann::json& list(const nlohmann::json& json, const char* key, std::size_t size) const {
        const nlohmann::json& found = member(json, key);
        if (!found.is_array() || found.size() != size) {
            fail(key);
        }
        return found;
    }
    [[nodiscard]] PerAxis<Decimal> point(const nlohmann::json& json, const char* key) const {
        const nlohmann::json& found = list(json, key, axes_);
        PerAxis<Decimal> out{};
        for (std::size_t k = 0; k < axes_; ++k) {
            out[k] = decimal_of(value(found[k], key));
        }
        return out;
    }
    [[nodiscard]] std::string text(const char* key) const {
        const nlohmann::json& found = member(json_, key);
        if (!found.is_string()) {
            fail(key);
        }
        return found.get<std::string>();
    }
    [[nodiscard]] int whole(const char* key, int low, int high) const {
        const nlohmann::json& found = member(json_, key);
        if (!found.is_number_integer() || found.get<std::int64_t>() < low || found.get<std::int64_t>() > high) {
            fail(key);
        }
        return found.get<int>();
    }

    [[nodiscard]] MachineState state() const {
        MachineState out;
        static_cast<void>(whole("version", state_version, state_version));
        const nlohmann::json& position = list(json_, "position_mm", axes_);
        for (std::size_t k = 0; k < axes_; ++k) {
            if (!position[k].is_null()) {
                out.position_mm[k] = value(position[k], "position_mm");
            } else if (out.unknown_why.empty()) {
                const nlohmann::json& why = member(json_, "position_unknown");
                out.unknown_why = why.is_string() ? why.get<std::string>() : std::string();
            }
        }
        const nlohmann::json& systems = list(json_, "work_systems", work_systems);
        for (std::size_t i = 0; i < systems.size(); ++i) {
            out.offsets.systems[i].origin = point(systems[i], "origin_mm");
            out.offsets.systems[i].rotation_deg = decimal_of(value(member(systems[i], "rotation_deg"), "rotation_deg"));
        }
        out.offsets.active = whole("active", 0, work_systems - 1);
        out.offsets.g92 = point(json_, "g92_mm");
        const nlohmann::json& applies = member(json_, "g92_applies");
        if (!applies.is_boolean()) {
            fail("g92_applies");
        }
        out.offsets.g92_applies = applies.get<bool>();
        out.offsets.tool = point(json_, "tool_mm");
        out.offsets.g28 = point(json_, "g28_mm");
        out.offsets.g30 = point(json_, "g30_mm");
        out.offsets.tool_number = whole("tool_number", 0, 1'000'000);
        return out;
    }

private:
    const nlohmann::json& json_;
    std::string file_;
    std::size_t axes_;
};

// What cannot be told is an error: to begin with 0 would be a guess.
bool is_there(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::none) {
        throw InputError(path, 0, "cannot be read: {}; name a file that can be", error.message());
    }
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!std::filesystem::exists(status) && !folder.empty() && !std::filesystem::is_directory(folder, error)) {
        throw InputError(path, 0, "there is no such folder; name a file in a folder that exists");
    }
    if (const std::string why = why_irreplaceable(path); !why.empty()) {
        throw InputError(path, 0, why);
    }
    return std::filesystem::exists(status);
}

// By its folder and its name there: the file itself is another one after each write.
std::string resource_of(const std::string& path) {
    static_cast<void>(is_there(path));
    const std::filesystem::path file = replaced_file(path);
    std::error_code none;
    const std::filesystem::path folder =
        std::filesystem::weakly_canonical(file.has_parent_path() ? file.parent_path() : ".", none);
    return "state:" + (folder / file.filename()).string();
}

std::string named(const std::string& machine, const std::string& target) {
    return fmt::format("{} on --target {}", in_quotes(machine), target);
}

} // namespace

std::optional<MachineState> read_state_file(const std::string& path, const std::vector<std::string>& axes) {
    if (!is_there(path)) {
        FileClaims::keeps(path); // no other output may be the state that comes to be
        return std::nullopt;
    }
    FileClaims::keeps(path);
    const nlohmann::json json = parse_json(read_text_file(path, largest_file), path);
    const StateReader reader(json, path, axes.size());
    if (reader.member(json, "axes") != nlohmann::json(axes)) {
        throw InputError(path, 0, "it is the state of a machine with other axes; give each machine its own file");
    }
    return reader.state();
}

StateFile::StateFile(std::string path, StateOwner owner)
    : path_(std::move(path)), owner_(std::move(owner)), claim_(resource_of(path_)) {
    if (!claim_.holder().empty()) {
        throw InputError(path_, 0, "{} keeps its state there; end that first, or name another file", claim_.holder());
    }
    FileClaims::keeps(path_);
    if (!is_there(path_)) {
        return;
    }
    const nlohmann::json json = parse_json(read_text_file(path_, largest_file), path_);
    const StateReader reader(json, path_, owner_.axes.size());
    static_cast<void>(reader.whole("version", state_version, state_version));
    const std::string machine = reader.text("machine");
    const std::string target = reader.text("target");
    if (machine != owner_.machine || target != owner_.target) {
        throw InputError(path_, 0, "it is the state of {}, not of {}; give each its own file", named(machine, target),
                         named(owner_.machine, owner_.target));
    }
}

void write_state_file(const std::string& path, const StateOwner& owner, const MachineState& state) {
    const std::vector<std::string>& axes = owner.axes;
    Json json;
    json["version"] = state_version;
    json["machine"] = owner.machine;
    json["target"] = owner.target;
    json["axes"] = axes;
    json["position_mm"] = Json::array();
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const std::optional<double>& mm = state.position_mm[k];
        json["position_mm"].push_back(mm ? Json(*mm) : Json(nullptr));
    }
    if (std::find(json["position_mm"].begin(), json["position_mm"].end(), nullptr) != json["position_mm"].end()) {
        json["position_unknown"] = state.unknown_why;
    }
    json["work_systems"] = Json::array();
    for (const WorkSystem& system : state.offsets.systems) {
        json["work_systems"].push_back(
            Json{{"origin_mm", numbers(system.origin, axes.size())}, {"rotation_deg", number_of(system.rotation_deg)}});
    }
    json["active"] = state.offsets.active;
    json["g92_mm"] = numbers(state.offsets.g92, axes.size());
    json["g92_applies"] = state.offsets.g92_applies;
    json["tool_mm"] = numbers(state.offsets.tool, axes.size());
    json["g28_mm"] = numbers(state.offsets.g28, axes.size());
    json["g30_mm"] = numbers(state.offsets.g30, axes.size());
    json["tool_number"] = state.offsets.tool_number;
    replace_durably(path, json.dump(2) + "\n");
}

} // namespace splinefeed::host
