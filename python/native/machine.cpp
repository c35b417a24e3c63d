// SPDX-License-Identifier: MIT
// A machine file, or a text like one.
#include "python/native/binding.hpp"

#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/config/toml_setting.hpp"
#include "host_sim/run/run_machine.hpp"

#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"

#include <sstream>

namespace splinefeed::python {

namespace {

Machine share(host::MachineDescription machine) {
    static_cast<void>(
        host::plan_figures(host::ScalarKind::fixed, machine)); // what does not go together is refused here
    return std::make_shared<const host::MachineDescription>(std::move(machine));
}

/// Numbers by their keys; those of axes one for each. A limit that the machine does not have is NaN.
py::dict limits_of(const host::MachineDescription& machine) {
    py::dict out;
    const auto shown = [](double value, WithoutKey without) {
        return without == WithoutKey::none && value == 0.0 ? std::nan("") : value;
    };
    for (const auto& number : path_numbers) {
        out[number.key] = shown(machine.settings.*number.value, number.without);
    }
    out[sample_period.key] = machine.settings.*sample_period.value;
    for (const auto& number : axis_numbers) {
        std::vector<double> values;
        for (const unsigned k : indices(machine.settings.axes)) {
            values.push_back(shown(machine.settings.axis[k].*number.value, number.without));
        }
        out[number.key] = values;
    }
    return out;
}

} // namespace

void bind_machine(py::module_& module) {
    py::class_<host::MachineDescription, std::shared_ptr<host::MachineDescription>>(module, "Machine")
        .def_property_readonly("name", [](const host::MachineDescription& machine) { return machine.name; })
        .def_property_readonly("axes",
                               [](const host::MachineDescription& machine) {
                                   return std::vector<std::string>(machine.axis_name.begin(),
                                                                   machine.axis_name.begin() + machine.settings.axes);
                               })
        .def_property_readonly("limits", limits_of);
    module.def("default_machine", [] { return share(host::default_machine()); });
    module.def("parse_machine",
               [](const std::string& text, const std::string& name) { return share(host::parse_machine(text, name)); });
    module.def("read_machine", [](const std::string& path, const std::vector<std::string>& settings) {
        require_path("the machine", path);
        const std::string text = host::read_text_file(path, host::largest_machine_file);
        static_cast<void>(host::parse_machine(text, path, settings)); // what is wrong has its line, or its setting
        const std::string changed = settings.empty() ? text : host::with_settings(text, path, settings);
        return py::make_tuple(share(host::parse_machine(changed, path)), changed);
    });
    module.def("machine_json", [](const std::string& text) {
        std::ostringstream out;
        out << toml::json_formatter(host::parse_toml(text, "machine"));
        return out.str();
    });
    py::list path_keys;
    for (const auto& number : path_numbers) {
        path_keys.append(number.key);
    }
    for (const auto& tolerance : host::path_tolerance_keys) {
        path_keys.append(tolerance.key);
    }
    module.attr("path_keys") = path_keys;
}

} // namespace splinefeed::python
