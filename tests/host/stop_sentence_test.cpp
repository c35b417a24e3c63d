// SPDX-License-Identifier: MIT
#include "host_sim/ports/stop_sentence.hpp"

#include "support/catch.hpp"

using namespace splinefeed::hal;
using namespace splinefeed::host;

namespace {

StoppedDrive drive(const char* name, StopRequest request, StopState state, bool on_path = true) {
    return {name, {.request = request, .state = state, .on_path = on_path}};
}

} // namespace

TEST_CASE("Stop sentence: held is said where every drive confirmed that it was held, and nowhere else") {
    const StoppedDrive held = drive("tcp://a", StopRequest::hold, StopState::confirmed);
    CHECK(stop_sentence({held, held}, false) == "interrupted: all drives were held on the path");
    CHECK(stop_sentence({held, drive("tcp://b", StopRequest::hold, StopState::confirmed, false)}, false) ==
          "interrupted: all axes stopped, each for itself");
    CHECK(stop_sentence({held, drive("tcp://b", StopRequest::quick_stop, StopState::confirmed)}, false) ==
          "interrupted: all axes stopped, each for itself; tcp://b did not hold in time and got a quick stop");
    CHECK(stop_sentence({held, drive("tcp://b", StopRequest::disable, StopState::unconfirmed)}, false) ==
          "interrupted: tcp://b did not confirm its stop and may still move");
    CHECK(stop_sentence({held, drive("tcp://b", StopRequest::hold, StopState::stopping)}, true) ==
          "interrupted twice: tcp://b did not confirm its stop and may still move");
    CHECK(stop_sentence({drive("tcp://a", StopRequest::quick_stop, StopState::confirmed)}, true) ==
          "interrupted twice: all axes stopped, each for itself");
}

TEST_CASE("Stop sentence: drives that were not asked to stop are not named") {
    CHECK(unconfirmed_drives({drive("tcp://a", StopRequest::none, StopState::moving)}).empty());
    CHECK(unconfirmed_drives({drive("tcp://a", StopRequest::hold, StopState::moving),
                              drive("tcp://b", StopRequest::hold, StopState::unconfirmed)}) ==
          "; tcp://a did not confirm its stop and may still move; tcp://b did not confirm its stop and may still move");
}
