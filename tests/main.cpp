// SPDX-License-Identifier: MIT
// The main program of every test executable, for Catch2 2 and 3. A filter that no test matches is an error with both.
#define CATCH_CONFIG_RUNNER
#include "host/temporary_folder.hpp"
#include "support/catch.hpp"

int main(int argc, char** argv) {
    Catch::Session session;
    const int status = session.applyCommandLine(argc, argv);
    if (status != 0) {
        return status;
    }
#if CATCH_VERSION_MAJOR == 2
    auto& warnings = session.configData().warnings;
    warnings = static_cast<Catch::WarnAbout::What>(warnings | Catch::WarnAbout::NoTests);
#endif
    // Each run works in a folder of its own: tests run at once, and a file of one must not be another's.
    const splinefeed_test::TemporaryFolder folder;
    std::filesystem::current_path(folder.file(""));
    return session.run();
}
