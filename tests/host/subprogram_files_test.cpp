// SPDX-License-Identifier: MIT
// Programs whose subprograms are files of their own: what is read, what is refused, and which lines moves and errors
// have.
#include "host_sim/program/gcode/subprogram_files.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/program/gcode/gcode_moves.hpp"
#include "support/catch.hpp"
#include "temporary_folder.hpp"
#include "text_lines.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include <sys/stat.h>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

class Folders {
public:
    [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name)) << text;
    }

    /// "line:X" of each move, "line event" of each event; then the error, without the folder.
    [[nodiscard]] std::string run(const std::string& program, Dialect dialect = Dialect::linuxcnc,
                                  ProblemList* problems = nullptr, bool simulated = true) const {
        GcodeSettings settings;
        settings.dialect = dialect;
        settings.axes = {"x", "y", "z"};
        settings.simulated = simulated;
        settings.subprogram_folders = {path("main"), path("shared")};
        const auto moves =
            gcode_moves(settings, "p.ngc", std::make_unique<TextLines>(program), ScalarKind::float64, problems);
        std::string out;
        try {
            PerAxis<Position> at{};
            REQUIRE(moves->start(at));
            for (SourceStep step; moves->next(step);) {
                if (step.kind == StepKind::move) {
                    moves->pushed(step);
                    out += fmt::format(" {}:{:g}", step.line, to_mm(step.move.to[0]));
                } else if (step.kind == StepKind::event && step.action.kind == EventKind::program_end) {
                    out += fmt::format(" {} end", step.line);
                }
            }
        } catch (const InputError& error) {
            out += std::string(" ") + error.what();
        }
        return plain(out);
    }
    [[nodiscard]] std::string plain(std::string text) const {
        const std::string top = path("");
        for (std::size_t at = text.find(top); at != std::string::npos; at = text.find(top)) {
            text.erase(at, top.size());
        }
        return text;
    }

private:
    TemporaryFolder folder_;
};

std::string sub(const std::string& name, const std::string& lines) {
    return "o<" + name + "> sub\n" + lines + "\no<" + name + "> endsub\n";
}

} // namespace

TEST_CASE("A subprogram may be a file of its own, and its moves have the line of the call") {
    const Folders at;
    at.write("main/hole.ngc", "(not run)\nG0 X99\n" + sub("hole", "G0 X#1\nX[#1+1]") + "G0 X98\n");
    at.write("shared/hole.ngc", sub("hole", "G0 X77"));
    at.write("shared/deep.ngc", sub("deep", "o<hole> call [20]\nG0 X30\no<twice> call"));
    at.write("main/100.ngc", "o100 sub\nG0 X5\no100 return [7]\no100 endsub\n");
    CHECK(at.run("G0 X1\no<hole> call [3]\nX9\nM2") == " 1:1 2:3 2:4 3:9 4 end");
    CHECK(at.run("o<Hole> call [3]\no[50*2] call\nG0 X#<_value>\nM2") == " 1:3 1:4 2:5 3:7 4 end");
    // Files call each other, and subprograms of the program.
    CHECK(at.run("o<twice> sub\nG0 X60\no<twice> endsub\no<deep> call\no<twice> call") == " 4:20 4:21 4:30 2:60 2:60");
    // LinuxCNC takes what is known, then a file, then what stands behind the call.
    CHECK(at.run("o<hole> call [3]\nM2\n" + sub("hole", "G0 X50")) == " 1:3 1:4 2 end");
    CHECK(at.run(sub("hole", "G0 X50") + "o<hole> call [3]\nM2\n") == " 2:50 5 end");
}

TEST_CASE("Numbered programs have the file names of their controls") {
    const Folders at;
    at.write("main/O1000.nc", "%\nO1000 (GRID)\n#1=[#1+1]\nG0 X#1\nM99\n%\n");
    at.write("shared/O00012.nc", "O0012\nG0 X12 M99\n");
    at.write("shared/1000.ngc", "o1000\nG0 X3\nM98 P20\nM99\n");
    at.write("shared/20.ngc", "O0020\nG0 X20\nM99\n");
    CHECK(at.run("#1=4\nM98 P1000 L2\nG0 X9\nM30", Dialect::fanuc) == " 2:5 2:6 3:9 4 end");
    CHECK(at.run("M98 P30012\nM30", Dialect::fanuc) == " 1:12 1:12 1:12 2 end");
    CHECK(at.run("G65 P1000 A7\nM30", Dialect::fanuc) == " 1:8 2 end");
    CHECK(at.run("M98 P1000\nM2") == " 1:3 1:20 2 end");
    // Where programs are in one memory those of the program come first.
    CHECK(at.run("M98 P1000\nM30\nO1000\nG0 X50\nM99", Dialect::fanuc) == " 4:50 2 end");
    CHECK(at.run("G65 P1000 A7\nG0 X9\nM99\nO1000\nG0 X50\nM99", Dialect::fanuc) == " 5:50 2:9");
}

TEST_CASE("What is wrong is told with its file") {
    const Folders at;
    at.write("main/bad.ngc", sub("bad", "G0 X1\nG0 XX"));
    at.write("main/open.ngc", "o<open> sub\nG0 X1\no5 if [1]\n");
    at.write("main/other.ngc", sub("another", "G0 X1"));
    at.write("main/loop.ngc", sub("loop", "o<pool> call"));
    at.write("main/pool.ngc", sub("pool", "o<loop> call"));
    at.write("main/calls.ngc", sub("calls", "\no<nowhere> call"));
    at.write("main/modes.ngc", sub("modes", "G20\nM73\nG21\n#1=[1/0]"));
    CHECK(at.run("o<bad> call").find(" 1:1 main/bad.ngc:3:5: ") == 0);
    CHECK(at.run("o<open> call").find(" main/open.ngc:1:1: oopen has no end") == 0);
    CHECK(at.run("o<other> call") ==
          " main/other.ngc: there is no line o<other> sub in it, with which the subprogram would begin");
    CHECK(at.run("M98 P5") ==
          " p.ngc:1:6: there is no subprogram O5 behind this line; no file 5.ngc is in 'main', 'shared'");
    CHECK(at.run("M98 P5", Dialect::fanuc).find("; no file O0005.nc or O00005.nc is in 'main', 'shared'") !=
          std::string::npos);
    CHECK(
        at.run("\no<calls> call")
            .find(" main/calls.ngc:3:2: there is no subprogram onowhere in this program; no file nowhere.ngc is in") ==
        0);
    CHECK(at.run("o<loop> call").find("nested more than 30 deep") != std::string::npos);
    CHECK(at.run("o<modes> call").find(" main/modes.ngc:5:6: ") == 0);
    ProblemList problems;
    CHECK(at.run("o<bad> call\nG0 XX\no<bad> call\no<open> call\no<other> call\no<other> call\nG0 X9\nM2",
                 Dialect::linuxcnc, &problems) == " 1:1 3:1 7:9 8 end");
    std::string told;
    for (const std::string& text : problems.texts()) {
        told +=
            at.plain(text.substr(0, text.find(": "))) + text.substr(std::min(text.size(), text.find("; also"))) + "\n";
    }
    CHECK(told == "main/bad.ngc:3:5; also on line p.ngc:2\nmain/open.ngc:1:1\nmain/open.ngc:3:1\nmain/other.ngc\n");
}

TEST_CASE("What a real machine cannot do is told with its file, also where the move was held back") {
    const Folders at;
    at.write("main/probe.ngc", sub("probe", "G38.2 X5 F100"));
    at.write("main/round.ngc", sub("round", "\nM7\nX20\nY20"));
    CHECK(at.run("G0 X1\no<probe> call", Dialect::linuxcnc, nullptr, false).find(" 1:1 main/probe.ngc:2: G38.2: ") ==
          0);
    CHECK(at.run("F100 G41.1 D2 G1 X10\no<round> call\nX30", Dialect::linuxcnc, nullptr, false)
              .find("main/round.ngc:3: mist_on: ") != std::string::npos);
}

TEST_CASE("Nothing outside the folders is read, and nothing that is no file") {
    const Folders at;
    at.write("main/inside.ngc", sub("inside", "G0 X1"));
    at.write("outside.ngc", sub("outside", "G0 X2") + sub("link", "G0 X3"));
    at.write("main/deeper/fine.ngc", sub("fine", "G0 X4"));
    namespace fs = std::filesystem;
    fs::create_symlink(at.path("outside.ngc"), at.path("main/link.ngc"));
    fs::create_symlink(at.path("main/deeper/fine.ngc"), at.path("main/fine.ngc"));
    fs::create_symlink(at.path("main/none.ngc"), at.path("main/dangling.ngc"));
    fs::create_directories(at.path("main/folder.ngc"));
    REQUIRE(mkfifo(at.path("main/fifo.ngc").c_str(), 0600) == 0);
    CHECK(at.run("o<inside> call") == " 1:1");
    CHECK(at.run("o<fine> call") == " 1:4");
    CHECK(at.run("o<link> call").find(" main/link.ngc: is a symbolic link that leads out of the folders") == 0);
    CHECK(at.run("o<dangling> call").find(" main/dangling.ngc: cannot be opened: No such file") == 0);
    CHECK(at.run("o<folder> call").find(" main/folder.ngc: is no file") == 0);
    CHECK(at.run("o<fifo> call").find(" main/fifo.ngc: is no file") == 0);
    for (const std::string name :
         {"../outside", "deeper/fine", "..", ".", "/etc/passwd", "a.b", "~", "\xc3\xa4", "a$b"}) {
        CAPTURE(name);
        CHECK(at.run("o<" + name + "> call").find("; no file can have this name: letters, digits") !=
              std::string::npos);
    }
    CHECK(at.run("o<" + std::string(240, 'a') + "> call").find("; no file can have this name") != std::string::npos);
}

TEST_CASE("Files that are too large are refused, before they fill the memory") {
    const Folders at;
    at.write("main/lines.ngc", std::string(2'000'000, '\n'));
    at.write("main/long.ngc", "o<long> sub\n" + std::string(70'000, ' ') + "\no<long> endsub\n");
    at.write("main/nul.ngc", std::string("o<nul> sub\n\0\n", 13));
    CHECK(at.run("o<lines> call")
              .find(" main/lines.ngc:1000001: files of subprograms have more than 67108864 bytes, or 1000000 lines") ==
          0);
    CHECK(at.run("o<long> call").find(" main/long.ngc:2: the line is longer than 65536 bytes") == 0);
    CHECK(at.run("o<nul> call").find(" main/nul.ngc:2") == 0);
    at.write("main/huge.ngc", "");
    std::filesystem::resize_file(at.path("main/huge.ngc"), std::uintmax_t{1} << 30U);
    CHECK(at.run("o<huge> call").find(" main/huge.ngc:1") == 0);
    std::ofstream wide(at.path("main/wide.ngc"));
    for (int i = 0; i < 1100; ++i) {
        wide << '(' << std::string(65'000, 'x') << ")\n";
    }
    wide.close();
    CHECK(at.run("o<wide> call").find(" main/wide.ngc:1033: files of subprograms have more than") == 0);
}

TEST_CASE("Without a folder there is nothing to look in") {
    SubprogramFiles files({});
    CHECK_FALSE(files.read({"a.ngc"}, 10).has_value());
    CHECK(files.searched({"a.ngc"}) == "there is no folder to look for a.ngc in; --subprograms states some");
}
