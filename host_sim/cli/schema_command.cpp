// SPDX-License-Identifier: MIT
#include "host_sim/cli/schema_command.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/json_schema.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/config/gpio_map_keys.hpp"
#include "host_sim/config/machine_keys.hpp"
#include "host_sim/config/profile_keys.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/program/event_file.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

struct Schema {
    std::string_view title;
    Json (*make)();
};
// As schema_names() has them.
constexpr std::array<std::string_view, 5> names{"machine", "profile", "map", "events", "summary"};
constexpr std::array<Schema, 5> schemas{
    {{"A machine file of splinefeed",
      [] {
          return schema_of(machine_table);
      }},
     {"A drive profile of splinefeed",
      [] {
          return schema_of(profile_table);
      }},
     {"A map file of splinefeed: lines of GPIO chips",
      [] {
          return schema_of(map_table);
      }},
     {"The rows of an events file of splinefeed, with the names of its columns",
      [] {
          return Json{{"type", "array"}, {"items", schema_of(operator_event_table)}};
      }},
     {"What splinefeed run --summary json prints", [] {
          return summary_schema();
      }}}};

} // namespace

std::span<const std::string_view> schema_names() {
    return names;
}

std::string json_schema(std::string_view name) {
    const auto* const found = std::ranges::find(names, name);
    if (found == names.end()) {
        throw UsageError("there is no schema {}{}", in_quotes(name), suggestion(name, names));
    }
    const Schema& schema = schemas[static_cast<std::size_t>(found - names.begin())];
    Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", schema.title}};
    json.update(schema.make());
    return json.dump(2) + "\n";
}

} // namespace splinefeed::host
