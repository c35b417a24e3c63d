// SPDX-License-Identifier: MIT
#include "host_sim/cli/help_pages.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

namespace splinefeed::host {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* /*command*/) { return true; });
}

/// "-m", "--machine"; a positional argument has none.
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) {
        names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        names.push_back("--" + name);
    }
    return names;
}

/// The words that a description begins with, "check, move or here: ...": what may stand behind the option. Empty where
/// it has none.
std::string offered(const CLI::Option& option) {
    static const std::regex words("([a-z0-9-]+(?:(?:, | or )[a-z0-9-]+)+)(?:[:;]| \\(|$).*");
    const std::string& text = option.get_description();
    std::smatch found;
    return std::regex_match(text, found, words) ? std::regex_replace(found.str(1), std::regex(", | or "), " ") : "";
}

/// A text as a line of a man page, which would take \ and - for its own, and a line with . or ' for an order.
std::string escaped(std::string_view text) {
    std::string out = text.substr(0, 1) == "." || text.substr(0, 1) == "'" ? "\\&" : "";
    for (const char c : text) {
        out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return out;
}

std::string upper(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::toupper(c); });
    return out;
}

void write_options(std::string& out, const CLI::App& app) {
    std::vector<std::string> groups;
    for (const CLI::Option* option : app.get_options()) {
        if (std::ranges::find(groups, option->get_group()) == groups.end()) {
            groups.push_back(option->get_group());
        }
    }
    out += ".SH OPTIONS\n";
    for (const std::string& group : groups) {
        out += group == "Options" ? std::string() : fmt::format(".SS {}\n", escaped(group));
        for (const CLI::Option* option : app.get_options()) {
            if (option->get_group() != group) {
                continue;
            }
            std::vector<std::string> names = names_of(*option);
            if (names.empty()) {
                names.push_back(option->get_name(true));
            }
            for (std::string& name : names) {
                name = fmt::format("\\fB{}\\fR", escaped(name));
            }
            out += fmt::format(".TP\n{}\n{}\n", fmt::join(names, ", "), escaped(option->get_description()));
        }
    }
}

void write_footer(std::string& out, const CLI::App& app) {
    std::istringstream lines(app.get_footer());
    out += ".SH NOTES\n";
    for (std::string line; std::getline(lines, line);) {
        out += escaped(line) + "\n.br\n";
    }
}

} // namespace

std::string man_page(const CLI::App& app, std::string_view command) {
    const std::string name = app.get_name();
    const std::vector<const CLI::App*> commands = commands_of(app);
    const auto found = std::ranges::find_if(commands, [&](const CLI::App* one) { return one->get_name() == command; });
    if (found == commands.end() && command != name) {
        std::vector<std::string> names{name};
        for (const CLI::App* one : commands) {
            names.push_back(one->get_name());
        }
        throw UsageError("--man {}{}", in_quotes(command),
                         suggestion(command, std::vector<std::string_view>(names.begin(), names.end())));
    }
    const CLI::App& of = found == commands.end() ? app : **found;
    const std::string page = &of == &app ? name : fmt::format("{}-{}", name, command);
    std::string out =
        fmt::format(".TH {} 1 \"\" \"splinefeed " SPLINEFEED_VERSION "\" \"User Commands\"\n.SH NAME\n{} \\- {}\n"
                    ".SH SYNOPSIS\n.B {}\n[\\fIOPTIONS\\fR]{}\n",
                    upper(page), page, escaped(of.get_description()), &of == &app ? name : name + " " + of.get_name(),
                    &of == &app ? " \\fICOMMAND\\fR ..." : "");
    for (const CLI::Option* option : of.get_options([](const CLI::Option* one) { return one->get_positional(); })) {
        out += fmt::format("\\fI{}\\fR\n", option->get_name(true));
    }
    std::vector<std::string> others;
    if (&of == &app) {
        out += ".SH COMMANDS\n";
        for (const CLI::App* one : commands) {
            out += fmt::format(".TP\n\\fB{}\\fR\n{}\n", one->get_name(), escaped(one->get_description()));
            others.push_back(fmt::format("\\fB{}-{}\\fR(1)", name, one->get_name()));
        }
    } else {
        others.push_back(fmt::format("\\fB{}\\fR(1)", name));
    }
    write_options(out, of);
    write_footer(out, of);
    return out + fmt::format(".SH SEE ALSO\n{}\n", fmt::join(others, ", "));
}

std::string bash_completion(const CLI::App& app) {
    std::string names;
    std::string cases;
    std::map<std::string, std::string> offers; // behind an option, or behind a command that takes a word
    for (const CLI::App* command : commands_of(app)) {
        std::vector<std::string> options;
        for (const CLI::Option* option : command->get_options()) {
            const std::vector<std::string> some = names_of(*option);
            options.insert(options.end(), some.begin(), some.end());
            if (const std::string words = offered(*option); !words.empty()) {
                offers[some.empty() ? command->get_name() : some.front()] = words;
            }
        }
        names += (names.empty() ? "" : " ") + command->get_name();
        cases += fmt::format("        {}) options=\"{}\" ;;\n", command->get_name(), fmt::join(options, " "));
    }
    std::string words;
    for (const auto& [before, some] : offers) {
        words += fmt::format("            {}) options=\"{}\" ;;\n", before, some);
    }
    return fmt::format("# The completion of bash for {0}: source <({0} --completion)\n"
                       "_{0}() {{\n"
                       "    local word=${{COMP_WORDS[COMP_CWORD]}} options=\"--help --version\"\n"
                       "    case ${{COMP_WORDS[1]}} in\n{2}    esac\n"
                       "    if ((COMP_CWORD == 1)) && [[ $word != -* ]]; then options=\"{1}\"; fi\n"
                       "    if [[ $word != -* ]]; then\n"
                       "        case ${{COMP_WORDS[COMP_CWORD - 1]}} in\n{3}"
                       "            *) ((COMP_CWORD == 1)) || options=\"\" ;;\n"
                       "        esac\n"
                       "    fi\n"
                       "    if [[ $options ]]; then\n"
                       "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
                       "    else\n"
                       "        mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
                       "    fi\n"
                       "}}\n"
                       "complete -o filenames -F _{0} {0}\n",
                       app.get_name(), names, cases, words);
}

} // namespace splinefeed::host
