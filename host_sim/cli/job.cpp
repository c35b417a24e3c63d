// SPDX-License-Identifier: MIT
#include "host_sim/cli/job.hpp"

#include "host_sim/base/file_claims.hpp"
#include "host_sim/run/runner.hpp"

namespace splinefeed::host {

int carry_out(const Job& job) {
    const FileClaims claims;
    switch (job.command) {
    case Command::run:
    case Command::plan: return run(job.run);
    case Command::check: return check_program(job.run);
    case Command::curve: return draw(job.run);
    case Command::surface: return run_surface(job.run.path.input, job.surface, job.run.path.scalar);
    case Command::drive: return run_drive(job.drive);
    case Command::link: return report_link(job.link);
    case Command::machine: return run_machine(job.run.path.input, job.machine);
    case Command::schema: break; // an answer, not a job
    case Command::serve: return run_serve(job.serve);
    }
    return 1;
}

} // namespace splinefeed::host
