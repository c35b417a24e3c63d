// SPDX-License-Identifier: MIT
#include "host_sim/base/output_file.hpp"

#include "refusal.hpp"
#include "support/child.hpp"
#include "temporary_folder.hpp"

#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>

using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

using Entries = std::vector<std::string>;

const std::string megabyte(std::size_t{1} << 20, 'm');

void write(const std::string& path, const std::string& text) {
    OutputFile file(path);
    file.append(text);
    file.commit();
}

} // namespace

TEST_CASE("an output file appears whole, at commit") {
    const TemporaryFolder folder;
    const std::string path = folder.file("out.csv");
    {
        OutputFile file(path);
        file.append("one,");
        file.format("{:.2f}\n", 2.0);
        for (int i = 0; i < 3; ++i) {
            file.append(megabyte);
        }
        CHECK_FALSE(std::filesystem::exists(path));
        file.commit();
        CHECK(contents(path) == "one,2.00\n" + megabyte + megabyte + megabyte);
    }
    CHECK(folder.entries() == Entries{"out.csv"});
    CHECK(contents(path).size() == 9 + 3 * megabyte.size());
}

TEST_CASE("an empty output is an empty file") {
    const TemporaryFolder folder;
    OutputFile(folder.file("empty")).commit();
    CHECK(folder.entries() == Entries{"empty"});
}

TEST_CASE("without commit nothing is left, and an existing file stays") {
    const TemporaryFolder folder;
    const std::string path = folder.file("out.csv");
    write(path, "before");
    SECTION("end of scope") {
        OutputFile file(path);
        file.append(megabyte);
        CHECK(contents(path) == "before");
    }
    SECTION("exception") {
        const auto broken = [&] {
            OutputFile file(path);
            file.append(megabyte);
            throw std::runtime_error("in the middle");
        };
        CHECK_THROWS_AS(broken(), std::runtime_error);
    }
    SECTION("exception, new file") {
        const auto broken = [&] {
            OutputFile file(folder.file("new.csv"));
            file.append(megabyte);
            throw std::runtime_error("in the middle");
        };
        CHECK_THROWS_AS(broken(), std::runtime_error);
    }
    CHECK(folder.entries() == Entries{"out.csv"});
    CHECK(contents(path) == "before");
}

TEST_CASE("a killed process leaves no target") {
    const TemporaryFolder folder;
    const std::string path = folder.file("out.csv");
    const int status = child_status([&] {
        OutputFile file(path);
        file.append(megabyte);
        raise(SIGKILL);
    });
    CHECK(WIFSIGNALED(status));
    CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("commit replaces a file and keeps its mode; the umask narrows that of a new one") {
    const TemporaryFolder folder;
    const std::string path = folder.file("out.csv");
    const auto mode_of = [](const std::string& name) {
        struct stat status {};
        REQUIRE(stat(name.c_str(), &status) == 0);
        return status.st_mode & 07777;
    };
    const mode_t before = umask(027);
    write(path, "before");
    umask(before);
    CHECK(mode_of(path) == 0640);
    REQUIRE(chmod(path.c_str(), 0604) == 0);
    write(path, "after");
    CHECK(contents(path) == "after");
    CHECK(mode_of(path) == 0604);
    CHECK(folder.entries() == Entries{"out.csv"});
}

TEST_CASE("a symbolic link stays one") {
    const TemporaryFolder folder;
    write(folder.file("real"), "before");
    std::filesystem::create_symlink("real", folder.file("link"));
    write(folder.file("link"), "after");
    CHECK(std::filesystem::is_symlink(folder.file("link")));
    CHECK(contents(folder.file("real")) == "after");
}

TEST_CASE("two outputs of one name do not mix") {
    const TemporaryFolder folder;
    OutputFile first(folder.file("out"));
    OutputFile second(folder.file("out"));
    first.append(megabyte);
    second.append("second");
    first.commit();
    second.commit();
    CHECK(contents(folder.file("out")) == "second");
    CHECK(folder.entries() == Entries{"out"});
}

// With pipes in a folder of the test's own, never with the devices of the system: run by root, a fault would replace
// them.
TEST_CASE("a target that is no regular file is written to, not replaced") {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const pid_t reader = fork();
    REQUIRE(reader >= 0);
    if (reader == 0) {
        std::ofstream(folder.file("copy"), std::ios::binary) << contents(pipe);
        _exit(0);
    }
    write(pipe, megabyte);
    CHECK(std::filesystem::is_fifo(pipe));
    if (!std::filesystem::is_fifo(pipe)) { // nobody writes to the reader any more
        kill(reader, SIGKILL);
    }
    REQUIRE(waitpid(reader, nullptr, 0) == reader);
    CHECK(contents(folder.file("copy")) == megabyte);
}

TEST_CASE("a file that cannot grow is an error that names it, and leaves nothing") {
    const TemporaryFolder folder;
    const std::string path = folder.file("out.csv");
    write(path, "before");
    const int code = exit_of([&] {
        const rlimit limit{std::size_t{1} << 19, std::size_t{1} << 19};
        signal(SIGXFSZ, SIG_IGN);
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
            _exit(2);
        }
        const std::string message = refusal_of<OutputError>([&] { write(path, megabyte); });
        _exit(message.find(path + ": cannot write: File too large; ") == 0 ? 0 : 1);
    });
    CHECK(code == 0);
    CHECK(contents(path) == "before");
    CHECK(folder.entries() == Entries{"out.csv"});
}

TEST_CASE("what cannot be created is refused at once, in one line") {
    const TemporaryFolder folder;
    const std::string missing = folder.file("missing/out.csv");
    const std::string message = refusal_of<OutputError>([&] { OutputFile file(missing); });
    CHECK(message.find(missing + ": cannot create: No such file or directory; ") == 0);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(refusal_of<OutputError>([&] { OutputFile file(folder.file("")); }).find("not a directory") !=
          std::string::npos);
    CHECK(refusal_of<OutputError>([&] { OutputFile file(folder.file("new/")); }).find("not a directory") !=
          std::string::npos);
    CHECK_THROWS_AS(OutputFile(""), OutputError);
    CHECK(folder.entries().empty());
}

TEST_CASE("a dash is standard output") {
    const auto captured = [](bool commit) {
        const TemporaryFolder folder;
        const std::string path = folder.file("stdout");
        const int code = exit_of([&] {
            if (std::freopen(path.c_str(), "w", stdout) == nullptr) {
                _exit(1);
            }
            OutputFile file("-");
            file.append("to the terminal\n");
            if (commit) {
                file.commit();
            }
        });
        CHECK(code == 0);
        CHECK(folder.entries() == Entries{"stdout"});
        return contents(path);
    };
    CHECK(captured(true) == "to the terminal\n");
    CHECK(captured(false).empty());
    CHECK_FALSE(std::filesystem::exists("-"));
}
