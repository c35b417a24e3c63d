// SPDX-License-Identifier: MIT
// The tool `splinefeed`.
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/cli/command_line.hpp"
#include "host_sim/run/exit_status.hpp"

#include <csignal>
#include <ios>

int main(int argc, char** argv) {
    using namespace splinefeed::host;
    keep_standard_streams();
    std::ios::sync_with_stdio(false);                 // a pipe is read in blocks of what has arrived
    for (const int of_outputs : {SIGPIPE, SIGXFSZ}) { // a reader that has gone, or a limit, is an error like any other
        static_cast<void>(std::signal(of_outputs, SIG_IGN));
    }
    return exit_status([&] {
        const auto parsed = parse_command_line(argc, argv);
        if (const Answer* const answer = std::get_if<Answer>(&parsed)) {
            static_cast<void>(std::signal(SIGPIPE, SIG_DFL)); // whoever has read enough of a page ends it, as of any
            print_whole(answer->text, "the answer");
            return 0;
        }
        return carry_out(std::get<Job>(parsed));
    });
}
