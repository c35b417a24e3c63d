// SPDX-License-Identifier: MIT
//
// Inputs are never overwritten, whatever the alias; what can be lost nowhere stays usable; every reader has a bound.
#include "support/catch.hpp"
#include "tool.hpp"

#include <nlohmann/json.hpp>
#include <vector>

using splinefeed::test::axis_text;
using splinefeed::test::Call;
using splinefeed::test::contains;
using splinefeed::test::Tool;

namespace {

const std::string program = "0,0,0\n1,1,0\n2,0,0\n";
const std::string machine = splinefeed::test::path_text(100) + axis_text("x") + axis_text("y") + axis_text("z");
const std::string events = "0.01,override,0.5\n";
const std::string inputs = "p.csv m.toml e.csv";

void write_inputs(const Tool& tool) {
    tool.write("p.csv", program);
    tool.write("m.toml", machine);
    tool.write("e.csv", events);
}

bool untouched(const Tool& tool) {
    return tool.read("p.csv") == program && tool.read("m.toml") == machine && tool.read("e.csv") == events;
}

bool one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
}

/// Refused, in one line that names the output.
void require_refused(const Call& call, const std::string& names) {
    CAPTURE(call.output, call.error);
    REQUIRE(call.status == 2);
    REQUIRE(call.output.empty());
    REQUIRE(one_line(call.error));
    REQUIRE(contains(call.error, names));
}

} // namespace

TEST_CASE("an output that is an input is refused, by whatever name") {
    const Tool tool;
    write_inputs(tool);
    REQUIRE(tool("run p.csv -m m.toml --events e.csv --quiet").status == 0);
    REQUIRE(tool.shell("ln -s p.csv l_p.csv && ln -s m.toml l_m.toml && ln -s e.csv l_e.csv && ln -s \"$PWD\" d && "
                       "ln p.csv h_p.csv && ln m.toml h_m.toml && ln e.csv h_e.csv")
                .status == 0);
    const std::string all = "run p.csv -m m.toml --events e.csv --quiet ";
    for (const char* const input : {"p.csv", "m.toml", "e.csv"}) {
        for (const char* const alias : {"", "./", "d/", "l_", "h_"}) {
            const std::string name = std::string(alias) + input;
            CAPTURE(name);
            const Call call = tool(all + "--trace " + name);
            require_refused(call, name);
            REQUIRE(contains(call.error, "give the output a name of its own"));
            REQUIRE(untouched(tool));
        }
    }
    for (const char* const option : {"--segments", "--edges", "--curve-out"}) {
        CAPTURE(option);
        require_refused(tool(all + option + " l_p.csv"), "l_p.csv: it is the input p.csv as well");
        require_refused(tool("plan p.csv --quiet " + std::string(option) + " p.csv"), "p.csv");
        REQUIRE(untouched(tool));
    }
    require_refused(tool("run p.csv --quiet --trace t.csv --segments h_p.csv"), "h_p.csv");
    REQUIRE(untouched(tool));
    REQUIRE(tool.holds_only(inputs + " l_p.csv l_m.toml l_e.csv d h_p.csv h_m.toml h_e.csv"));
}

TEST_CASE("other commands do not overwrite what they read either") {
    const Tool tool;
    write_inputs(tool);
    require_refused(tool("curve p.csv -o ./p.csv"), "p.csv");
    REQUIRE(tool("curve p.csv -o c.json").status == 0);
    const std::string curve = tool.read("c.json");
    require_refused(tool("curve c.json -o ./c.json"), "c.json");
    require_refused(tool("plan c.json --quiet --curve-out c.json"), "c.json");
    CHECK(tool.read("c.json") == curve);
    const std::string dome = R"({"method": "bspline_surface", "input": {"grid": [[[0,0,0],[0,9,1],[0,18,0]],
        [[9,0,1],[9,9,2],[9,18,1]],[[18,0,0],[18,9,1],[18,18,0]]], "degree_u": 2, "degree_v": 2}})";
    tool.write("dome.json", dome);
    require_refused(tool("surface dome.json --along u --lines 3 -o ./dome.json"), "dome.json");
    CHECK(tool.read("dome.json") == dome);
    CHECK(untouched(tool));
}

TEST_CASE("two outputs are two files") {
    const Tool tool;
    write_inputs(tool);
    require_refused(tool("run p.csv --quiet --trace a.csv --segments ./a.csv"), "./a.csv: it is the same file as");
    tool.write("a.csv", "before");
    REQUIRE(tool.shell("ln -s a.csv b.csv").status == 0);
    require_refused(tool("run p.csv --quiet --trace a.csv --segments b.csv"), "b.csv: it is the same file as");
    CHECK(tool.read("a.csv") == "before");
    CHECK(tool("run p.csv --quiet --trace a.csv --segments c.csv").status == 0);
    CHECK(contains(tool.read("a.csv"), "t,x,y,z"));
    CHECK(tool.holds_only(inputs + " a.csv b.csv c.csv"));
}

TEST_CASE("standard input and output are files, too, where they were redirected") {
    const Tool tool;
    write_inputs(tool);
    require_refused(tool("plan - --quiet --trace p.csv <p.csv"), "p.csv: it is the input on standard input as well");
    const Call appended = tool.shell("'" + splinefeed::test::tool_path() + "' plan p.csv --quiet >>p.csv");
    CHECK(appended.status == 2);
    CHECK(contains(appended.error, "standard output: it is the input p.csv as well"));
    const Call both = tool.shell("'" + splinefeed::test::tool_path() + "' plan p.csv --quiet --trace s.txt >>s.txt");
    CHECK(both.status == 2);
    CHECK(contains(both.error, "s.txt: it is the same file as the output on standard output"));
    CHECK(untouched(tool));
}

TEST_CASE("devices and pipes take any number of outputs") {
    const Tool tool;
    write_inputs(tool);
    CHECK(tool("run p.csv --quiet --trace /dev/null --segments /dev/null --edges /dev/null").status == 0);
    CHECK(tool("plan - --quiet --trace /dev/stdout --summary text <p.csv | cat").status == 0);
    const Call piped = tool.shell("mkfifo f && { cat f >got & } && '" + splinefeed::test::tool_path() +
                                  "' run p.csv --quiet --trace f && wait");
    CHECK(piped.status == 0);
    CHECK(contains(tool.read("got"), "t,x,y,z"));
}

TEST_CASE("what cannot be read again is read once, and nothing says then what would help") {
    const Tool tool;
    write_inputs(tool);
    tool.write("e.json", R"({"elements": [{"type": "line", "from": [0, 0, 0], "to": [9, 0, 0], "feed_mm_s": 20}]})");
    tool.write("c.json",
               R"({"degree": 3, "segments": [{"control_points": [[0, 0, 0], [3, 0, 0], [6, 3, 0], [9, 3, 0]]}]})");
    tool.write("g.ngc", "T1 M6\nG43\nG1 X9 F600\nM2\n");
    tool.write("tool.tbl", "T1 P1 Z10\n");
    const std::string run = "'" + splinefeed::test::tool_path() + "' run ";
    const std::string rest = " --quiet --summary json --report r.html";
    const auto helps = [&](const std::string& command) {
        const Call call = tool.shell(command + rest);
        CAPTURE(command, call.error);
        REQUIRE(call.status == 0);
        return !nlohmann::json::parse(call.output)["what_would_help"].is_null();
    };
    for (const std::string file : {"p.csv", "e.json", "c.json"}) {
        const std::string format = " --format " + file.substr(file.find('.') + 1);
        CHECK_FALSE(helps("cat " + file + " | " + run + "-" + format));
        CHECK_FALSE(helps("cat " + file + " | " + run + "/dev/stdin" + format));
        CHECK(helps(run + "- " + format + " <" + file));
    }
    CHECK_FALSE(helps("mkfifo f && { cat tool.tbl >f & } && " + run + "g.ngc --tools f"));
    CHECK(helps(run + "g.ngc --tools tool.tbl"));
    CHECK(helps(run + "- --format gcode --tools tool.tbl <g.ngc"));
    CHECK(contains(tool.read("r.html"), "G1 X9 F600")); // the report shows what was redirected, too
}

TEST_CASE("events that never happened are told") {
    const Tool tool;
    write_inputs(tool);
    tool.write("e.csv", "# an operator\n0.01,override,0.5\n9000,hold\n9001,resume\n9002,hold\n9003,resume\n");
    const Call call = tool("run p.csv --events e.csv --summary json");
    CHECK(call.status == 0);
    CHECK(contains(call.error, "e.csv:3: warning: the event at 9000 s did not happen: the run ended at "));
    CHECK(contains(call.error, "e.csv:5: warning: "));
    CHECK(contains(call.error, "e.csv: warning: nor did the 1 events after them"));
    const auto summary = nlohmann::json::parse(call.output);
    CHECK(summary["events"] == 1);
    CHECK(summary["events_not_reached"] == 4);
    CHECK(tool("run p.csv --events e.csv --quiet").error.empty());
}

TEST_CASE("help is -h, too") {
    const Tool tool;
    CHECK(tool("-h").output == tool("--help").output);
    CHECK(tool("plan -h").output == tool("plan --help").output);
    CHECK(contains(tool("plan -h").output, "Usage: splinefeed plan"));
}

TEST_CASE("every reader has a bound") {
    const Tool tool;
    write_inputs(tool);
    const auto deep = [&](const std::string& name, const std::string& command) {
        require_refused(tool.shell("{ " + command + "; } >" + name + "; '" + splinefeed::test::tool_path() + "' " +
                                   (name == "m.toml" ? "plan p.csv --quiet -m m.toml" : "plan " + name)),
                        name + ":");
    };
    deep("a.json", "head -c 200000 /dev/zero | tr '\\0' '['");
    deep("b.json", "printf '{\"segments\": [{\"degree\": '; head -c 200000 /dev/zero | tr '\\0' '['; printf 1; head -c "
                   "200000 /dev/zero | tr '\\0' ']'; printf ', \"control_points\": [[0],[1]]}]}'");
    deep("m.toml", "printf 'a = '; head -c 200000 /dev/zero | tr '\\0' '['");
    deep("m.toml", "head -c 200000 /dev/zero | sed 's/\\x0/a./g'; echo 'a = 1'");
    deep("m.toml", "printf '['; head -c 200000 /dev/zero | sed 's/\\x0/a./g'; echo 'a]'");
    deep("w.csv", "head -c 5000 /dev/zero | tr '\\0' ','");
    // Five million rows: seconds with sanitizers
    const Call closed = tool.shell("yes 1,1 | '" + splinefeed::test::tool_path() + "' plan - --closed --quiet");
    CHECK(closed.status == 2);
    CHECK(contains(closed.error, "-:4000001: a closed curve is kept in memory as a whole"));
    const Call whole =
        tool.shell("yes 1,1 | '" + splinefeed::test::tool_path() + "' plan - --curve bspline-interpolation --quiet");
    CHECK(whole.status == 2);
    CHECK(contains(whole.error, "-:1000001: --curve bspline-interpolation is made of all points at once"));
    CHECK(tool.shell("yes 0 | '" + splinefeed::test::tool_path() + "' plan p.csv --quiet -m /dev/stdin").status == 2);
    CHECK(tool.shell("yes '1,hold' | '" + splinefeed::test::tool_path() + "' plan p.csv --quiet --events /dev/stdin")
              .status == 2);
}

TEST_CASE("a coordinate that grows for ever is refused with its line, and the machine stops before it") {
    const Tool tool;
    tool.write("p.csv", "0,0\n60000,0\n120000,0\n1048577,0\n");
    const Call call = tool("plan p.csv --quiet");
    CHECK(call.status == 2);
    CHECK(contains(call.error, "p.csv:4: "));
    CHECK(contains(call.error, "1048576"));
}

TEST_CASE("closed standard streams: no message gets into an output, and the exit status is right") {
    const Tool tool;
    write_inputs(tool);
    tool.write("bad.csv", "0,0\nx\n");
    REQUIRE(tool("run p.csv --quiet --trace t.csv").status == 0);
    const std::string trace = tool.read("t.csv");
    struct Started {
        const char* streams;
        int status; // of a run whose summary is standard output
    };
    for (const Started& started : {Started{"<&-", 0}, Started{"2>&-", 0}, Started{"<&- 2>&-", 0}, Started{">&-", 2},
                                   Started{">&- 2>&-", 2}, Started{"<&- >&- 2>&-", 2}}) {
        const std::string streams = started.streams;
        CAPTURE(streams);
        CHECK(tool("run p.csv --quiet --trace t.csv " + streams).status == started.status);
        CHECK((started.status != 0 || tool.read("t.csv") == trace));
        CHECK(tool("run bad.csv --trace bad_t.csv " + streams).status == 2);
        CHECK(tool("run p.csv --nonsense " + streams).status == 2);
        CHECK(tool("run p.csv --corner-angle 1 --curve polyline --trace t.csv " + streams).status != 0);
    }
    CHECK(tool.holds_only(inputs + " bad.csv t.csv"));
    const Call input = tool("run - <&-");
    CHECK(input.status == 2);
    CHECK(input.error == "-: cannot be read; it must be a file or a pipe\n");
}

TEST_CASE("a full disk under standard error ends nothing, one under standard output is told") {
    const Tool tool;
    write_inputs(tool);
    tool.write("talks.ngc", "(MSG,here)\nG0 X1\n(MSG,there)\nM2\n");
    tool.write("bad.csv", "0,0\nx\n");
    CHECK(tool("run talks.ngc --trace t.csv 2>/dev/full").status == 0);
    CHECK(tool.read("t.csv").find("\n0.065") != std::string::npos);
    CHECK(tool("run bad.csv 2>/dev/full").status == 2);
    CHECK(tool("run p.csv --nonsense 2>/dev/full").status == 2);
    CHECK(tool("run p.csv --trace /dev/full 2>/dev/full").status == 2);
    for (const char* const command : {"run p.csv --quiet", "check talks.ngc", "check talks.ngc --json", "--version",
                                      "run --help", "curve p.csv", "drive --list-profiles"}) {
        CAPTURE(command);
        const Call call = tool(std::string(command) + " >/dev/full");
        CHECK(call.status == 2);
        CHECK(one_line(call.error));
        CHECK(contains(call.error, "splinefeed: standard output: "));
    }
}

TEST_CASE("what counts as text is the same for every input") {
    const Tool tool;
    write_inputs(tool);
    struct Input {
        const char* name;
        std::string text;
        const char* use;
    };
    const std::vector<Input> all{{"i.csv", program, "plan i.csv --quiet"},
                                 {"i.ngc", "G0 X1\nX2\n", "plan i.ngc --quiet"},
                                 {"i.toml", machine, "plan p.csv --quiet -m i.toml"},
                                 {"i_events.csv", events, "plan p.csv --quiet --events i_events.csv"},
                                 {"i.tbl", "T1 P1 Z5\n", "plan g.ngc --quiet --tools i.tbl"}};
    tool.write("g.ngc", "G0 X1\n");
    const auto with_returns = [](std::string text, const std::string& end) {
        for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size())) {
            text.replace(at, 1, end);
        }
        return text;
    };
    for (const Input& input : all) {
        CAPTURE(input.name);
        const auto call = [&](const std::string& text) {
            tool.write(input.name, text);
            return tool(input.use);
        };
        for (const std::string& text : {input.text, "\xef\xbb\xbf" + input.text, with_returns(input.text, "\r\n"),
                                        with_returns(input.text, "\r\n") + "\x1a"}) {
            const Call taken = call(text);
            CAPTURE(text, taken.error);
            CHECK(taken.status == 0);
        }
        const std::string first = std::string(input.name) + ":1: ";
        CHECK(contains(call("\xff\xfe" + input.text).error, first + "the text is UTF-16; save it as UTF-8 or ASCII\n"));
        CHECK(contains(call(std::string(1, '\0') + input.text).error, first + "the line holds a NUL byte; "));
        CHECK(contains(call("\r" + with_returns(input.text, "\r")).error, first + "the line holds a CR alone; "));
        CHECK(call("\r" + with_returns(input.text, "\r")).status == 2);
    }
}
