// SPDX-License-Identifier: MIT
#include "host_sim/serve/sender_door.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/serve/sender_guard.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <optional>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

namespace splinefeed::host {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::seconds longest_silence{3};
constexpr std::chrono::milliseconds terminal_look{100};
constexpr int most_at_once = 16;
constexpr int most_waiting = 64;        // connections that are not accepted yet
constexpr std::size_t most_refused = 8; // connections
constexpr std::size_t most_unread = std::size_t{64} << 10U;
constexpr std::size_t most_with_reports = std::size_t{16} << 10U;

/// A connection, whatever it is made of.
struct Sender {
    Sender(asio::io_context& context, int descriptor, std::string called)
        : stream(context, descriptor), name(std::move(called)), heard(SteadyClock::now()) {
        stream.non_blocking(true);
    }

    asio::posix::stream_descriptor stream;
    std::string name;
    SenderGuard guard;
    StopBytes stops;
    std::string unsent;
    SteadyClock::time_point heard;
    bool is_terminal = false;
    bool present = true;  // of a terminal: somebody has opened it
    bool refused = false; // another one has the machine,
    bool stopped = false; // which it has stopped
};
using SenderPointer = std::shared_ptr<Sender>;

// The other end answers by itself, however quiet its program is: what does not for so long has lost its link.
void watch_link(int socket) {
    const auto set = [socket](int level, int option, int value) {
        static_cast<void>(::setsockopt(socket, level, option, &value, sizeof value));
    };
    const int silence_s = std::chrono::duration_cast<std::chrono::duration<int>>(longest_silence).count();
    set(SOL_SOCKET, SO_KEEPALIVE, 1);
    set(IPPROTO_TCP, TCP_KEEPIDLE, 1);
    set(IPPROTO_TCP, TCP_KEEPINTVL, 1);
    set(IPPROTO_TCP, TCP_KEEPCNT, silence_s);
    set(IPPROTO_TCP, TCP_USER_TIMEOUT, silence_s * 1000); // of what was sent, too
}

std::string reason() {
    return std::strerror(errno);
}

class AsioDoor final : public SenderDoor {
public:
    explicit AsioDoor(Events events) : events_(std::move(events)) {}
    ~AsioDoor() override {
        if (!link_.empty()) {
            ::unlink(link_.c_str());
        }
    }

    std::string listen(const std::string& address) override {
        const std::size_t colon = address.rfind(':');
        const auto port = read_whole<unsigned>(colon == std::string::npos ? "" : address.substr(colon + 1), 0, 65535);
        boost::system::error_code error;
        const auto host = asio::ip::make_address_v4(address.substr(0, colon), error);
        if (!port || error) {
            throw UsageError("--tcp {}: write ADDRESS:PORT, for example 127.0.0.1:2300", in_quotes(address));
        }
        if (!host.is_loopback()) {
            throw UsageError("--tcp {}: others than this computer could move the machine there; listen on "
                             "127.0.0.1, and come from elsewhere by ssh -L",
                             in_quotes(address));
        }
        const tcp::endpoint place(host, static_cast<unsigned short>(*port));
        acceptor_.open(place.protocol());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(place, error);
        if (!error) {
            acceptor_.listen(most_waiting, error);
        }
        if (error) {
            throw UsageError("--tcp {}: {}; take another port", in_quotes(address), error.message());
        }
        accept();
        const tcp::endpoint bound = acceptor_.local_endpoint();
        return fmt::format("{}:{}", bound.address().to_string(), bound.port());
    }

    std::string open_terminal(const std::string& link) override {
        const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) {
            throw UsageError("--pty: there is no pseudo terminal: " + reason());
        }
        std::string name = ::ptsname(master);
        // Cooked, it would echo what we say back to us, as lines.
        const int slave = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios mode{};
        if (slave < 0 || ::tcgetattr(slave, &mode) != 0) {
            throw UsageError("--pty: " + reason());
        }
        ::cfmakeraw(&mode);
        if (::tcsetattr(slave, TCSANOW, &mode) != 0 || ::fchmod(slave, S_IRUSR | S_IWUSR) != 0) {
            throw UsageError("--pty: " + reason());
        }
        ::close(slave); // else nobody would see that a sender has gone
        std::error_code ignored;
        if (std::filesystem::read_symlink(link, ignored).parent_path() == "/dev/pts") {
            ::unlink(link.c_str()); // of a server that was killed
        }
        if (::symlink(name.c_str(), link.c_str()) != 0) {
            throw UsageError("--pty {}: {}; name a file that is not there yet", in_quotes(link), reason());
        }
        link_ = link;
        terminal_name_ = name;
        terminal_ = std::make_shared<Sender>(context_, master, link);
        terminal_->is_terminal = true;
        terminal_->present = false;
        look_at_terminal();
        return name;
    }

    void watch_input(std::function<void(std::string_view)> line) override {
        on_line_ = std::move(line);
        input_.emplace(context_, ::dup(STDIN_FILENO));
        read_input();
    }

    void wait(std::chrono::microseconds longest) override {
        context_.restart();
        context_.run_one_for(longest);
        for (int more = 0; more < most_at_once && context_.poll_one() > 0; ++more) { // who floods does not keep us here
        }
        flush();
    }

    void send(std::string_view text) override {
        if (operator_ == nullptr) {
            return;
        }
        std::string& unsent = operator_->unsent;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            const std::size_t next = end == std::string_view::npos ? text.size() : end + 1;
            const bool report = text[at] == '<';
            if (!report || unsent.size() < most_with_reports) {
                unsent += text.substr(at, next - at);
            }
            at = next;
        }
        flush();
    }

    [[nodiscard]] bool has_sender() const noexcept override { return operator_ != nullptr; }

private:
    void accept() {
        acceptor_.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
            boost::system::error_code ignored;
            if (!error) {
                const tcp::endpoint from = socket.remote_endpoint(ignored);
                socket.set_option(tcp::no_delay(true), ignored);
                watch_link(socket.native_handle());
                greet(std::make_shared<Sender>(context_, socket.release(),
                                               fmt::format("{}:{}", from.address().to_string(), from.port())));
            }
            accept();
        });
    }

    // The machine is given to it, or it is told who has it.
    void greet(const SenderPointer& sender) {
        if (operator_ != nullptr && SteadyClock::now() - operator_->heard > longest_silence && events_.rests()) {
            events_.noted(fmt::format("{} was silent, and {} takes the machine", operator_->name, sender->name));
            const SenderPointer silent = operator_;
            drop(silent);
        }
        sender->guard = {};
        if (operator_ != nullptr) {
            refuse(sender);
            return;
        }
        operator_ = sender;
        sender->heard = SteadyClock::now();
        events_.opened(sender->name);
        read(sender);
    }

    // It is heard for what stops the machine.
    void refuse(const SenderPointer& sender) {
        boost::system::error_code ignored;
        const std::string busy = fmt::format("[MSG:Busy: {} has the machine]\r\n", operator_->name);
        sender->stream.write_some(asio::buffer(busy), ignored);
        events_.noted(fmt::format("{} was refused: {} has the machine", sender->name, operator_->name));
        sender->refused = true;
        sender->stopped = false;
        sender->stops = {};
        if (!sender->is_terminal) {
            std::erase_if(refused_, [](const std::weak_ptr<Sender>& one) { return one.expired(); });
            if (refused_.size() == most_refused) {
                drop(refused_.front().lock());
                refused_.pop_front();
            }
            refused_.push_back(sender);
        }
        read(sender);
    }

    void read(const SenderPointer& sender) {
        sender->stream.async_wait(asio::posix::stream_descriptor::wait_read,
                                  [this, sender](const boost::system::error_code& error) {
                                      if (!error) {
                                          take(sender);
                                      }
                                  });
    }

    void take(const SenderPointer& sender) {
        std::array<char, 4096> bytes{};
        boost::system::error_code error;
        const std::size_t size = sender->stream.read_some(asio::buffer(bytes), error);
        if (error == asio::error::would_block || error == asio::error::interrupted) {
            read(sender);
            return;
        }
        if (error || size == 0) {
            if (error == asio::error::timed_out) {
                events_.noted(fmt::format("{} has gone: its link does not answer", sender->name));
            }
            drop(sender);
            return;
        }
        sender->heard = SteadyClock::now();
        std::string through;
        if (!sender->guard.take({bytes.data(), size}, through)) {
            events_.noted(
                fmt::format("{} is no sender (HTTP, TLS, STUN, or no text): nothing of it was executed", sender->name));
            stop(sender, through);
            drop(sender);
            return;
        }
        if (sender->refused) {
            stop(sender, through);
        } else if (!through.empty() && operator_ == sender) {
            events_.received(through);
        }
        read(sender);
    }

    void stop(const SenderPointer& sender, std::string_view bytes) const {
        for (const RealtimeByte byte : sender->stops.take(bytes)) {
            events_.stopped(byte);
            if (!std::exchange(sender->stopped, true)) {
                events_.noted(fmt::format("{}, which has not got the machine, stops it", sender->name));
            }
        }
    }

    void drop(const SenderPointer& sender) {
        const bool had = operator_ == sender;
        if (had) {
            operator_ = nullptr;
        }
        if (sender->is_terminal) {
            sender->present = sender->refused = false;
            sender->unsent.clear();
            boost::system::error_code ignored;
            sender->stream.cancel(ignored);
            forget_unread();
        } else {
            boost::system::error_code ignored;
            sender->stream.close(ignored);
        }
        if (had) {
            events_.closed();
        }
    }

    // Nobody has it open: the kernel says that it is hung up.
    void look_at_terminal() {
        pollfd look{terminal_->stream.native_handle(), POLLIN, 0};
        ::poll(&look, 1, 0);
        const bool open = (look.revents & POLLHUP) == 0;
        if (open && !terminal_->present) {
            terminal_->present = true;
            greet(terminal_);
        } else if (!open && terminal_->present) {
            drop(terminal_);
        } else if (!open && (look.revents & POLLIN) != 0) { // somebody came and went between two looks
            forget_unread();
        }
        timer_.expires_after(terminal_look);
        timer_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                look_at_terminal();
            }
        });
    }

    // What the last sender has not read or we have not is nothing for the next one.
    void forget_unread() const {
        std::array<char, 4096> bytes{};
        boost::system::error_code error;
        for (int part = 0; part < most_at_once && !error; ++part) {
            terminal_->stream.read_some(asio::buffer(bytes), error);
        }
        const int slave = ::open(terminal_name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (slave >= 0) {
            ::tcflush(slave, TCIOFLUSH);
            ::close(slave);
        }
    }

    void read_input() {
        input_->async_wait(asio::posix::stream_descriptor::wait_read, [this](const boost::system::error_code& error) {
            std::array<char, 1024> bytes{};
            const ssize_t size = error ? -1 : ::read(input_->native_handle(), bytes.data(), bytes.size());
            if (size <= 0) {
                return; // its end: the senders stay
            }
            input_text_.append(bytes.data(), static_cast<std::size_t>(size));
            for (std::size_t end = input_text_.find('\n'); end != std::string::npos; end = input_text_.find('\n')) {
                const std::string one = input_text_.substr(0, end);
                input_text_.erase(0, end + 1);
                on_line_(one);
            }
            read_input();
        });
    }

    void flush() {
        if (operator_ == nullptr || operator_->unsent.empty()) {
            return;
        }
        const SenderPointer sender = operator_;
        boost::system::error_code error;
        const std::size_t sent = sender->stream.write_some(asio::buffer(sender->unsent), error);
        sender->unsent.erase(0, sent);
        const bool gone = error && error != asio::error::would_block;
        if (gone || sender->unsent.size() > most_unread) {
            events_.noted(fmt::format("{} {}", sender->name, gone ? "has gone" : "does not read, and was sent away"));
            drop(sender);
        }
    }

    Events events_;
    asio::io_context context_;
    tcp::acceptor acceptor_{context_};
    asio::steady_timer timer_{context_};
    SenderPointer operator_;
    SenderPointer terminal_;
    std::deque<std::weak_ptr<Sender>> refused_; // the oldest one first
    std::optional<asio::posix::stream_descriptor> input_;
    std::function<void(std::string_view)> on_line_;
    std::string input_text_;
    std::string link_;
    std::string terminal_name_;
};

} // namespace

bool has_sender_door() noexcept {
    return true;
}

std::unique_ptr<SenderDoor> make_sender_door(const SenderDoor::Events& events) {
    return std::make_unique<AsioDoor>(events);
}

} // namespace splinefeed::host
