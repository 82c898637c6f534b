#include "engine/midi/alsa_midi.hpp"

#include <alsa/asoundlib.h>
#include <rtmidi/RtMidi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "base/channels/event_queue.hpp"

namespace raks::engine {
namespace {

constexpr double kTicks = 1e6;                               // a second, as the clock counts
constexpr Nanos kLooksApart = std::chrono::seconds(2);       // at the ports that are there
constexpr Nanos kStoodStill = std::chrono::milliseconds(5);  // then time was lost

// RtMidi throws: its errors become ours here. Warnings, which it would print, are passed over.
void pass_over(RtMidiError::Type /*type*/, const std::string& /*text*/, void* /*data*/) {}

void print_nothing_of_alsa(const char*, int, const char*, int, const char*, ...) {}

// Asked first, since RtMidi prints what it cannot open. Errors: why there is none.
Expected<void> has_sequencer() {
    snd_lib_error_set_handler(print_nothing_of_alsa);
    snd_seq_t* sequencer = nullptr;
    const int fault = snd_seq_open(&sequencer, "default", SND_SEQ_OPEN_DUPLEX, SND_SEQ_NONBLOCK);
    if (fault < 0) {
        return fail(std::string("no JACK server runs, and ALSA has no MIDI: ") +
                    snd_strerror(fault));
    }
    snd_seq_close(sequencer);
    return {};
}

// The first port whose name holds `wanted`, and its name.
struct FoundPort {
    unsigned number = 0;
    std::string name;
};
std::optional<FoundPort> find_port(RtMidi& midi, const std::string& wanted) {
    for (unsigned port = 0; port < midi.getPortCount(); ++port) {
        std::string name = midi.getPortName(port);
        if (is_midi_port_meant(name, wanted)) {
            return FoundPort{port, std::move(name)};
        }
    }
    return std::nullopt;
}

// Keeps a port of ours connected to the one that is meant.
class AlsaConnection {
 public:
    AlsaConnection(RtMidi& midi, std::string wanted, std::string own)
        : midi_(midi), wanted_(std::move(wanted)), own_(std::move(own)) {}

    void turn(HostTime now) {
        if (now < next_look_) {
            return;
        }
        next_look_ = now + kLooksApart;
        const auto found = find_port(midi_, wanted_);
        const std::string peer = found ? found->name : "";
        if (peer == peer_) {
            return;
        }
        peer_ = peer;
        midi_.closePort();
        if (found) {
            midi_.openPort(found->number, own_);
        }
    }
    [[nodiscard]] const std::string& peer() const noexcept { return peer_; }

 private:
    RtMidi& midi_;
    std::string wanted_;
    std::string own_;
    std::string peer_;
    HostTime next_look_{};
};

class AlsaClockPort final : public MidiClockPort {
 public:
    AlsaClockPort(std::unique_ptr<RtMidiOut> midi, const std::string& wanted, int clocks_per_beat)
        : midi_(std::move(midi)),
          connection_(*midi_, wanted, "out"),
          clock_(kTicks, clocks_per_beat) {}
    ~AlsaClockPort() override { send(clock_.stop()); }
    AlsaClockPort(const AlsaClockPort&) = delete;
    AlsaClockPort& operator=(const AlsaClockPort&) = delete;

    void follow(const MidiClockBeats& beats) override { beats_ = beats; }

    // What was due while this thread stood still is not made up for: clocks would come at once.
    void turn(HostTime now) override {
        connection_.turn(now);
        if (now - counted_ > kStoodStill + ticks_of(clock_.next_in())) {
            counted_ = now - ticks_of(clock_.next_in());
        }
        const auto ticks = std::chrono::floor<std::chrono::microseconds>(now - counted_) +
                           std::chrono::microseconds(1);
        if (ticks > Nanos(0)) {
            send(clock_.advance(beats_, counted_, static_cast<std::uint32_t>(ticks.count())));
            counted_ += ticks;
        }
    }
    [[nodiscard]] std::optional<HostTime> due() const override {
        return counted_ + ticks_of(clock_.next_in());
    }
    std::uint64_t take_sent() override { return std::exchange(sent_, 0); }
    std::optional<std::string> take_trouble() override { return std::nullopt; }

 private:
    static Nanos ticks_of(double ticks) { return nanos_from_seconds(ticks / kTicks); }

    void send(std::span<const MidiClock::Message> messages) {
        if (connection_.peer().empty()) {
            return;
        }
        for (const MidiClock::Message& message : messages) {
            midi_->sendMessage(&message.byte, 1);
            ++sent_;
        }
    }

    std::unique_ptr<RtMidiOut> midi_;
    AlsaConnection connection_;
    MidiClock clock_;
    MidiClockBeats beats_;
    HostTime counted_ = host_now();  // up to here
    std::uint64_t sent_ = 0;
};

class AlsaInputPort final : public MidiInputPort {
 public:
    AlsaInputPort(std::unique_ptr<RtMidiIn> midi, const std::string& wanted)
        : midi_(std::move(midi)), connection_(*midi_, wanted, "in") {
        midi_->setCallback(on_message, this);
    }
    // No callback runs behind this.
    ~AlsaInputPort() override { midi_.reset(); }
    AlsaInputPort(const AlsaInputPort&) = delete;
    AlsaInputPort& operator=(const AlsaInputPort&) = delete;

    bool take(MidiMessage& message) override {
        connection_.turn(host_now());
        return messages_.pop(message);
    }
    std::string device() override { return midi_device_name(connection_.peer()); }
    [[nodiscard]] std::uint64_t lost() const override { return messages_.dropped(); }
    std::optional<std::string> take_trouble() override { return std::nullopt; }

 private:
    // On RtMidi's thread.
    static void on_message(double /*since*/, std::vector<unsigned char>* bytes, void* data) {
        AlsaInputPort& port = *static_cast<AlsaInputPort*>(data);
        for (const unsigned char byte : *bytes) {
            if (auto message = port.parser_.take(byte)) {
                message->came = host_now();
                port.messages_.push(*message);
            }
        }
    }

    std::unique_ptr<RtMidiIn> midi_;
    AlsaConnection connection_;
    MidiParser parser_;  // of RtMidi's thread
    EventQueue<MidiMessage> messages_{kRoom};
};

}  // namespace

Expected<std::unique_ptr<MidiClockPort>> open_alsa_midi_clock(const std::string& name,
                                                              int clocks_per_beat) {
    if (auto there = has_sequencer(); !there) {
        return fail(there.error());
    }
    try {
        auto midi = std::make_unique<RtMidiOut>(RtMidi::LINUX_ALSA, "raks-clock");
        midi->setErrorCallback(pass_over);
        return std::make_unique<AlsaClockPort>(std::move(midi), name, clocks_per_beat);
    } catch (const RtMidiError& error) {
        return fail("ALSA has no MIDI: " + error.getMessage());
    }
}

Expected<std::unique_ptr<MidiInputPort>> open_alsa_midi_input(const std::string& name) {
    if (auto there = has_sequencer(); !there) {
        return fail(there.error());
    }
    try {
        auto midi = std::make_unique<RtMidiIn>(RtMidi::LINUX_ALSA, "raks-control");
        midi->setErrorCallback(pass_over);
        return std::make_unique<AlsaInputPort>(std::move(midi), name);
    } catch (const RtMidiError& error) {
        return fail("ALSA has no MIDI: " + error.getMessage());
    }
}

}  // namespace raks::engine
