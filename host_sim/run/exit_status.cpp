// SPDX-License-Identifier: MIT
#include "host_sim/run/exit_status.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/ports/run_target.hpp"

#include <exception>

namespace splinefeed::host {

int exit_status(const std::function<int()>& job) {
    constexpr int not_finished = 1;
    constexpr int bad_input = 2;
    try {
        return job();
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

} // namespace splinefeed::host
