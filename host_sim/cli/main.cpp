// SPDX-License-Identifier: MIT
// The tool `splinefeed`: exceptions become exit statuses here and nowhere else.
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/cli/command_line.hpp"
#include "host_sim/ports/run_target.hpp"

#include <csignal>
#include <exception>

int main(int argc, char** argv) {
    using namespace splinefeed::host;
    constexpr int not_finished = 1;
    constexpr int bad_input = 2;
    keep_standard_streams();
    std::ios::sync_with_stdio(false);                 // a pipe is read in blocks of what has arrived
    for (const int of_outputs : {SIGPIPE, SIGXFSZ}) { // a reader that has gone, or a limit, is an error like any other
        static_cast<void>(std::signal(of_outputs, SIG_IGN));
    }
    try {
        const auto parsed = parse_command_line(argc, argv);
        if (const Answer* const answer = std::get_if<Answer>(&parsed)) {
            print_whole(answer->text, "the answer");
            return 0;
        }
        return carry_out(std::get<Job>(parsed));
    } catch (const InputError& error) {
        tell("{}\n", error.what());
        return bad_input;
    } catch (const UsageError& error) {
        tell("splinefeed: {}\n", error.what());
        return bad_input;
    } catch (const OutputError& error) {
        tell("splinefeed: {}\n", printable(error.what()));
        return bad_input;
    } catch (const TargetError& error) {
        tell("splinefeed: {}\n", printable(error.what()));
        return not_finished;
    } catch (const std::exception& error) {
        tell("splinefeed: internal error: {}\n", printable(error.what()));
        return not_finished;
    }
}
