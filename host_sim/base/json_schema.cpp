// SPDX-License-Identifier: MIT
#include "host_sim/base/json_schema.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

/// A number without a fraction as JSON has whole numbers.
Json json_number(double value) {
    return std::trunc(value) == value ? Json(whole_bound(value)) : Json(value);
}

Json with_range(Json schema, const FileKey& row, const char* least, const char* most) {
    if (std::isfinite(row.low)) {
        schema[least] = json_number(row.low);
    }
    if (std::isfinite(row.high)) {
        schema[most] = json_number(row.high);
    }
    return schema;
}

Json text_of(const FileKey& row) {
    Json schema = with_range({{"type", "string"}}, row, "minLength", "maxLength");
    schema["minLength"] = 1;
    return schema;
}

Json choice_of(const FileKey& row) {
    return {{"enum", std::vector<std::string>(row.names.begin(), row.names.end())}};
}

Json list_of(Json item, const FileKey& row) {
    return with_range({{"type", "array"}, {"items", std::move(item)}}, row, "minItems", "maxItems");
}

Json value_of(const FileKey& row) {
    switch (row.kind) {
    case KeyKind::text: return text_of(row);
    case KeyKind::flag: return {{"type", "boolean"}};
    case KeyKind::whole: return with_range({{"type", "integer"}}, row, "minimum", "maximum");
    case KeyKind::number: return with_range({{"type", "number"}}, row, "minimum", "maximum");
    case KeyKind::choice: return choice_of(row);
    case KeyKind::texts: return list_of({{"type", "string"}, {"minLength", 1}}, row);
    case KeyKind::choices: return list_of(choice_of(row), row);
    case KeyKind::table: return schema_of(*row.inside);
    case KeyKind::tables: return list_of(schema_of(*row.inside), row);
    case KeyKind::by_axis:
        return {{"type", "object"},
                {"patternProperties", {{"^[xyzabcXYZABC]$", schema_of(*row.inside)}}},
                {"additionalProperties", false}};
    case KeyKind::line:
        return {{"anyOf", Json::array({value_of(row.inside->row("name")), value_of(row.inside->row("offset")),
                                       schema_of(*row.inside)})}};
    case KeyKind::form: break;
    }
    return Json::parse(row.form);
}

} // namespace

Json described(const FileKey& row, Json value) {
    Json schema{
        {"description", row.unit.empty() ? std::string(row.sentence) : fmt::format("[{}] {}", row.unit, row.sentence)}};
    if (row.nullable) {
        schema["anyOf"] = Json::array({std::move(value), Json{{"type", "null"}}});
    } else {
        schema.update(value);
    }
    return schema;
}

Json schema_of(const FileKey& row) {
    return described(row, value_of(row));
}

Json schema_of(const FileTable& table) {
    Json schema{{"type", "object"}};
    Json properties = Json::object();
    Json required = Json::array();
    for (const FileKey& row : table.keys) {
        properties[std::string(row.key)] = schema_of(row);
        if (row.required) {
            required.push_back(std::string(row.key));
        }
    }
    schema["properties"] = std::move(properties);
    if (!required.empty()) {
        schema["required"] = std::move(required);
    }
    schema["additionalProperties"] = false;
    if (!table.rules.empty()) {
        schema.update(Json::parse(table.rules));
    }
    return schema;
}

} // namespace splinefeed::host
