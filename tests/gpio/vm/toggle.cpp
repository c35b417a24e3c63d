// SPDX-License-Identifier: MIT
// Guest's side of the bed's self-test, for libgpiod 1.6 and 2: sets lines, waits for edges, plays a file of edges.
#include <gpiod.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

void require(bool good, const char* what) {
    if (!good) {
        throw std::runtime_error(what);
    }
}

#ifdef GPIOD_LINE_BULK_MAX_LINES // version 1

/// Lines of one chip; they are released with the process.
class Pins {
public:
    explicit Pins(const std::string& path) : chip_(gpiod_chip_open(path.c_str())) {
        require(chip_ != nullptr, "the chip does not open");
    }
    void request_outputs(const std::vector<unsigned>& offsets) {
        for (const unsigned offset : offsets) {
            gpiod_line* const line = gpiod_chip_get_line(chip_, offset);
            require(line != nullptr && gpiod_line_request_output(line, "toggle", 0) == 0, "a line cannot be had");
            lines_[offset] = line;
        }
    }
    void request_edges(unsigned offset) {
        input_ = gpiod_chip_get_line(chip_, offset);
        require(input_ != nullptr && gpiod_line_request_both_edges_events(input_, "toggle") == 0,
                "a line cannot be had");
    }
    void set(unsigned offset, int value) {
        require(gpiod_line_set_value(lines_.at(offset), value) == 0, "a line cannot be set");
    }
    bool next_edge_rises(int seconds) {
        const timespec patience{seconds, 0};
        gpiod_line_event event{};
        require(gpiod_line_event_wait(input_, &patience) == 1, "no edge came");
        require(gpiod_line_event_read(input_, &event) == 0, "an edge cannot be read");
        return event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
    }

private:
    gpiod_chip* chip_;
    std::map<unsigned, gpiod_line*> lines_;
    gpiod_line* input_ = nullptr;
};

#else

/// Lines of one chip; they are released with the process.
class Pins {
public:
    explicit Pins(const std::string& path) : chip_(gpiod_chip_open(path.c_str())) {
        require(chip_ != nullptr, "the chip does not open");
    }
    void request_outputs(const std::vector<unsigned>& offsets) {
        request(offsets, GPIOD_LINE_DIRECTION_OUTPUT, GPIOD_LINE_EDGE_NONE);
    }
    void request_edges(unsigned offset) { request({offset}, GPIOD_LINE_DIRECTION_INPUT, GPIOD_LINE_EDGE_BOTH); }
    void set(unsigned offset, int value) {
        require(gpiod_line_request_set_value(lines_, offset,
                                             value == 0 ? GPIOD_LINE_VALUE_INACTIVE : GPIOD_LINE_VALUE_ACTIVE) == 0,
                "a line cannot be set");
    }
    bool next_edge_rises(int seconds) {
        gpiod_edge_event_buffer* const buffer = gpiod_edge_event_buffer_new(1);
        require(gpiod_line_request_wait_edge_events(lines_, seconds * 1'000'000'000LL) == 1, "no edge came");
        require(gpiod_line_request_read_edge_events(lines_, buffer, 1) == 1, "an edge cannot be read");
        const bool rises = gpiod_edge_event_get_event_type(gpiod_edge_event_buffer_get_event(buffer, 0)) ==
                           GPIOD_EDGE_EVENT_RISING_EDGE;
        gpiod_edge_event_buffer_free(buffer);
        return rises;
    }

private:
    void request(const std::vector<unsigned>& offsets, gpiod_line_direction direction, gpiod_line_edge edge) {
        gpiod_line_settings* const settings = gpiod_line_settings_new();
        gpiod_line_config* const config = gpiod_line_config_new();
        require(settings != nullptr && config != nullptr &&
                    gpiod_line_settings_set_direction(settings, direction) == 0 &&
                    gpiod_line_settings_set_edge_detection(settings, edge) == 0 &&
                    gpiod_line_config_add_line_settings(config, offsets.data(), offsets.size(), settings) == 0,
                "a line cannot be described");
        lines_ = gpiod_chip_request_lines(chip_, nullptr, config);
        gpiod_line_config_free(config);
        gpiod_line_settings_free(settings);
        require(lines_ != nullptr, "a line cannot be had");
    }
    gpiod_chip* chip_;
    gpiod_line_request* lines_ = nullptr;
};

#endif

/// A level of a line at an instant, in ns from the start.
struct Edge {
    std::int64_t t_ns;
    unsigned offset;
    int value;
};

/// Rows t_ns,offset,value without a heading.
std::vector<Edge> read_edges(const std::string& path) {
    std::ifstream file(path);
    require(file.is_open(), "the edges cannot be read");
    std::vector<Edge> edges;
    for (std::string row; std::getline(file, row);) {
        std::istringstream fields(row);
        Edge edge{};
        char comma = 0;
        require(static_cast<bool>(fields >> edge.t_ns >> comma >> edge.offset >> comma >> edge.value),
                "not a row of edges");
        edges.push_back(edge);
    }
    return edges;
}

/// Each edge at its instant, or as soon afterwards as the guest can.
void play(Pins& lines, const std::vector<Edge>& edges) {
    std::map<unsigned, int> used;
    for (const Edge& edge : edges) {
        used[edge.offset] = 0;
    }
    std::vector<unsigned> offsets;
    offsets.reserve(used.size());
    for (const auto& [offset, value] : used) {
        offsets.push_back(offset);
    }
    lines.request_outputs(offsets);
    const auto start = std::chrono::steady_clock::now();
    for (const Edge& edge : edges) {
        std::this_thread::sleep_until(start + std::chrono::nanoseconds(edge.t_ns));
        lines.set(edge.offset, edge.value);
    }
}

int run(const std::vector<std::string>& words) {
    require(words.size() >= 4, "usage: toggle set|wait|play CHIP ...");
    Pins lines(words[2]);
    if (words[1] == "set") { // OFFSET COUNT: so many edges
        const auto offset = static_cast<unsigned>(std::stoul(words[3]));
        lines.request_outputs({offset});
        const int count = std::stoi(words.at(4));
        for (int i = 1; i <= count; ++i) {
            lines.set(offset, i % 2);
        }
    } else if (words[1] == "wait") { // OFFSET COUNT SECONDS: so many edges, one a line
        lines.request_edges(static_cast<unsigned>(std::stoul(words[3])));
        std::puts("ready");
        std::fflush(stdout);
        for (int i = std::stoi(words.at(4)); i > 0; --i) {
            std::puts(lines.next_edge_rises(std::stoi(words.at(5))) ? "rises" : "falls");
            std::fflush(stdout);
        }
    } else { // play FILE
        play(lines, read_edges(words[3]));
    }
    return 0;
}

} // namespace

int main(int count, char** words) {
    try {
        return run(std::vector<std::string>(words, words + count));
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "toggle: %s\n", problem.what());
        return 1;
    }
}
