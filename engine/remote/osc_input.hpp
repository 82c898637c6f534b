#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/descriptor.hpp"
#include "base/expected.hpp"
#include "engine/control/request_inbox.hpp"

namespace raks::engine {

/// Requests that come by OSC over UDP, on a thread of its own. Bounds: read_osc_requests(), and
/// kMostPackets a second; what is over them is counted. Threads: main, for all methods.
class OscInput {
 public:
    static constexpr int kMostPackets = 1'000;  ///< a second

    /// `place`: PORT, heard from this machine alone, or ADDRESS:PORT. `inbox` must outlive it.
    /// Errors: no port, no address; the system's.
    [[nodiscard]] static Expected<std::unique_ptr<OscInput>> open(const std::string& place,
                                                                  RequestInbox& inbox);
    ~OscInput();                                    ///< joins the thread
    OscInput(const OscInput&) = delete;             ///< the thread refers to it
    OscInput& operator=(const OscInput&) = delete;  ///< likewise

    /// Where it listens: "127.0.0.1:9000".
    [[nodiscard]] const std::string& place() const noexcept { return place_; }
    /// The first line about something that could not be read, once.
    [[nodiscard]] std::optional<std::string> take_trouble();
    /// Requests that were handed on.
    [[nodiscard]] std::uint64_t taken() const noexcept { return taken_.load(); }
    /// Messages that were not.
    [[nodiscard]] std::uint64_t passed_over() const noexcept { return passed_over_.load(); }

 private:
    OscInput(Descriptor socket, Descriptor stop, std::string place, RequestInbox& inbox);
    void run();
    void read_one();
    [[nodiscard]] bool has_budget(HostTime now);
    void complain(std::string fault);

    Descriptor socket_;
    Descriptor stop_;  // an event that ends the thread
    std::string place_;
    RequestInbox& inbox_;
    std::atomic<std::uint64_t> taken_{0};
    std::atomic<std::uint64_t> passed_over_{0};
    std::mutex mutex_;  // of the two below
    std::optional<std::string> trouble_;
    bool has_complained_ = false;
    HostTime second_{};  // that is counted
    int packets_ = 0;    // in it
    std::thread thread_;
};

/// Whether it is a place as OscInput::open takes it; nothing is opened. Errors: what is wrong.
[[nodiscard]] Expected<void> check_osc_input(const std::string& place);

}  // namespace raks::engine
