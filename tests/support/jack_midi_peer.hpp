#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace raks::test {

/// A JACK client of this process with MIDI ports `in` and `out`: it notes at which sample each byte
/// comes, and plays the part of a knob box.
class JackMidiPeer {
 public:
    /// A byte, and the server's sample at which it came.
    struct Byte {
        std::int64_t sample;
        std::uint8_t byte;
    };

    /// On the server that JACK_DEFAULT_SERVER names.
    explicit JackMidiPeer(const std::string& name);
    ~JackMidiPeer();
    JackMidiPeer(const JackMidiPeer&) = delete;
    JackMidiPeer& operator=(const JackMidiPeer&) = delete;

    /// False when the server refused.
    [[nodiscard]] bool is_running() const noexcept { return line_ != nullptr; }
    /// All bytes so far, in order.
    [[nodiscard]] std::vector<Byte> bytes() const;
    /// How often the server lost time: samples are missing then.
    [[nodiscard]] int xruns() const;
    /// Waits for so many bytes. False: they did not come within `patience`.
    [[nodiscard]] bool wait_for_bytes(std::size_t count, std::chrono::seconds patience) const;
    /// Waits until something is connected to `out`. False: nothing was within `patience`.
    [[nodiscard]] bool wait_for_listener(std::chrono::seconds patience) const;
    /// Sends a message with the next period.
    void send(const std::vector<std::uint8_t>& message);
    /// The server's sample that passes at a time of CLOCK_MONOTONIC, as it reckons now.
    [[nodiscard]] double sample_at(std::chrono::steady_clock::time_point time) const;

    struct Line;  ///< what its callback works on

 private:
    std::unique_ptr<Line> line_;
};

}  // namespace raks::test
