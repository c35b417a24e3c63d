// SPDX-License-Identifier: MIT
#include "host_sim/program/row_queue.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/input_stream.hpp"
#include "host_sim/program/waypoint_reader.hpp"
#include "support/catch.hpp"

#include <istream>
#include <unistd.h>

using namespace splinefeed::host;
using namespace std::chrono_literals;

namespace {

/// A reader at the end of a pipe, as path_input has it.
class PipeRows final : public WaypointRows {
public:
    explicit PipeRows(int descriptor)
        : input_("/proc/self/fd/" + std::to_string(descriptor), "pipe"), reader_(stream_, "pipe", {"x", "y"}) {}
    bool next(WaypointRow& out) override { return reader_.next(out); }
    void stop() noexcept override { input_.stop(); }

private:
    InputStream input_;
    std::istream stream_{&input_};
    WaypointReader reader_;
};

struct Pipe {
    Pipe() { REQUIRE(pipe(ends) == 0); }
    ~Pipe() {
        close(ends[0]);
        close(ends[1]);
    }
    void send(const std::string& text) const {
        REQUIRE(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    }
    int ends[2]{};
};

} // namespace

TEST_CASE("rows that have arrived are there, and nobody waits for those that have not") {
    const Pipe pipe;
    pipe.send("0,0\n1,2\n");
    RowQueue queue(std::make_unique<PipeRows>(pipe.ends[0]));
    WaypointRow row;
    for (const double x : {0.0, 1.0}) {
        REQUIRE(queue.wait(5s));
        REQUIRE(queue.next(row));
        CHECK(row.position[0] == x);
    }
    CHECK_FALSE(queue.wait(10ms));
    pipe.send("5,6\n");
    CHECK(queue.wait(5s));
    REQUIRE(queue.next(row));
    CHECK(row.position[1] == 6.0);
    CHECK(row.line == 3);
} // its reader waits for the pipe, and is stopped

TEST_CASE("what is wrong in the input comes behind the rows before it") {
    const Pipe pipe;
    pipe.send("0,0\n1,2\nwhat\n");
    RowQueue queue(std::make_unique<PipeRows>(pipe.ends[0]));
    WaypointRow row;
    REQUIRE(queue.next(row));
    REQUIRE(queue.next(row));
    CHECK(queue.wait(5s));
    CHECK_THROWS_AS(queue.next(row), InputError);
    CHECK_FALSE(queue.next(row));
}

TEST_CASE("a queue is bounded, and keeps the order") {
    constexpr int count = 5000;
    class Counting final : public WaypointRows {
    public:
        explicit Counting(std::atomic<int>& given) : given_(&given) {}
        bool next(WaypointRow& out) override {
            out.line = static_cast<std::uint64_t>(given_->load());
            return given_->fetch_add(1) < count;
        }

    private:
        std::atomic<int>* given_;
    };
    std::atomic<int> given{0};
    RowQueue queue(std::make_unique<Counting>(given));
    std::this_thread::sleep_for(50ms);
    CHECK(given.load() <= static_cast<int>(RowQueue::capacity) + 1);
    WaypointRow row;
    for (int i = 0; i < count; ++i) {
        REQUIRE(queue.next(row));
        REQUIRE(row.line == static_cast<std::uint64_t>(i));
    }
    CHECK_FALSE(queue.next(row));
}
