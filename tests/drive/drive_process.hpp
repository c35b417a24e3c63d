// SPDX-License-Identifier: MIT
// DriveProcess: `splinefeed drive` as a process of its own.
#pragma once

#include "support/places.hpp"
#include "tool/tool.hpp"

#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/prctl.h>

namespace splinefeed::test {

/// Started in the folder of a Tool; what it listens on is known when it is made. Ended by SIGTERM.
class DriveProcess {
public:
    DriveProcess(const Tool& tool, const std::string& arguments) : tool_(&tool) {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) {
            throw std::runtime_error("no pipe");
        }
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM); // a test that crashes leaves no drive behind
            dup2(ends[1], STDOUT_FILENO);
            close(ends[0]);
            close(ends[1]);
            const std::string command = "cd '" + tool.folder() + "' && exec '" + splinefeed::test::tool_path() +
                                        "' drive " + arguments + " 2>.drive_error";
            execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ends[1]);
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') {
            line_ += c;
        }
        close(ends[0]);
    }
    DriveProcess(const DriveProcess&) = delete;
    DriveProcess& operator=(const DriveProcess&) = delete;
    ~DriveProcess() { static_cast<void>(stop()); }

    /// "listening on ..."
    [[nodiscard]] const std::string& line() const { return line_; }
    [[nodiscard]] int port() const {
        const std::size_t at = line_.rfind(':');
        return at == std::string::npos ? 0 : std::atoi(line_.c_str() + at + 1);
    }
    [[nodiscard]] std::string error() const { return tool_->read(".drive_error"); }

    /// Its exit status; its records are complete.
    int stop() {
        if (process_ <= 0) {
            return status_;
        }
        kill(process_, SIGTERM);
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return status_;
    }

private:
    const Tool* tool_;
    pid_t process_ = -1;
    int status_ = -1;
    std::string line_;
};

} // namespace splinefeed::test
