#include "engine/midi/jack_midi.hpp"

#include <jack/jack.h>
#include <jack/midiport.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <semaphore>
#include <thread>
#include <utility>

#include "audio/io/deadline.hpp"
#include "audio/io/jack_devices.hpp"
#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/realtime.hpp"

namespace raks::engine {
namespace {

constexpr const char* kServerGone = "the JACK server has gone; start Raks again";
constexpr Nanos kStopWithin = std::chrono::milliseconds(200);  // a period, and more
// The name of a port that has just come may not be there yet.
constexpr std::chrono::milliseconds kLooksAgain(300);
constexpr int kLooks = 4;

struct FreePortNames {
    void operator()(const char** names) const noexcept { jack_free(static_cast<void*>(names)); }
};

// A port's own name and what else the server calls it.
std::vector<std::string> names_of(const jack_port_t* port) {
    std::vector<std::string> names{jack_port_name(port)};
    const auto size = static_cast<std::size_t>(jack_port_name_size());
    std::array<std::string, 2> aliases{std::string(size, '\0'), std::string(size, '\0')};
    std::array<char*, 2> texts{aliases[0].data(), aliases[1].data()};
    const int count = jack_port_get_aliases(port, texts.data());
    for (int i = 0; i < std::clamp(count, 0, 2); ++i) {
        names.emplace_back(aliases[static_cast<std::size_t>(i)].c_str());
    }
    return names;
}

// What JACK's threads use of either port.
struct MidiLine {
    jack_client_t* client = nullptr;
    jack_port_t* port = nullptr;
    Nanos epoch{};  // of JACK's clock, on ours
    std::atomic<bool> is_shut_down{false};
    std::counting_semaphore<> has_changed{0};  // ports have

    // When the first sample of the period that is worked on passes. Threads: JACK's.
    [[nodiscard]] HostTime period_begins() const noexcept RAKS_NONBLOCKING {
        jack_nframes_t frames = 0;
        jack_time_t now = 0;
        jack_time_t next = 0;
        float length = 0.0F;
        // Both are read from memory that the server shares.
        if (RAKS_TRUSTED(jack_get_cycle_times(client, &frames, &now, &next, &length)) != 0) {
            return host_now();
        }
        return HostTime(epoch + std::chrono::microseconds(now));
    }
};

void on_midi_shutdown(void* line) noexcept {
    // relaxed: a flag by itself
    static_cast<MidiLine*>(line)->is_shut_down.store(true, std::memory_order_relaxed);
}

void on_midi_port(jack_port_id_t, int, void* line) noexcept {
    static_cast<MidiLine*>(line)->has_changed.release();
}

struct ClockLineOut final : MidiLine {
    explicit ClockLineOut(int rate, int clocks_per_beat)
        : clock(static_cast<double>(rate), clocks_per_beat) {}

    LatestValue<MidiClockBeats> beats;
    MidiClock clock;  // of JACK's thread
    std::atomic<bool> is_ending{false};
    std::atomic<bool> has_ended{false};
    std::atomic<std::uint64_t> sent{0};
};

int on_clock_period(jack_nframes_t frames, void* data) noexcept RAKS_NONBLOCKING {
    ClockLineOut& line = *static_cast<ClockLineOut*>(data);
    // JACK says that its callback may ask for these.
    void* const buffer = RAKS_TRUSTED(jack_port_get_buffer(line.port, frames));
    RAKS_TRUSTED(jack_midi_clear_buffer(buffer));
    // acquire: pairs with the release of the destructor
    const bool is_ending = line.is_ending.load(std::memory_order_acquire);
    const auto messages = is_ending
                              ? line.clock.stop()
                              : line.clock.advance(line.beats.read(), line.period_begins(), frames);
    for (const MidiClock::Message& message : messages) {
        RAKS_TRUSTED(jack_midi_event_write(buffer, message.offset, &message.byte, 1));
    }
    line.sent.fetch_add(messages.size(), std::memory_order_relaxed);  // a statistic
    // release: pairs with the acquire of the destructor
    line.has_ended.store(is_ending, std::memory_order_release);
    return 0;
}

struct InputLine final : MidiLine {
    MidiParser parser;  // of JACK's thread
    EventQueue<MidiMessage> messages{MidiInputPort::kRoom};
};

// What happened during the period before is handed over with its place in that.
int on_input_period(jack_nframes_t frames, void* data) noexcept RAKS_NONBLOCKING {
    InputLine& line = *static_cast<InputLine*>(data);
    void* const buffer = RAKS_TRUSTED(jack_port_get_buffer(line.port, frames));
    const jack_nframes_t rate = RAKS_TRUSTED(jack_get_sample_rate(line.client));
    const HostTime begins = line.period_begins();
    const jack_nframes_t count = RAKS_TRUSTED(jack_midi_get_event_count(buffer));
    for (jack_nframes_t i = 0; i < count; ++i) {
        jack_midi_event_t event{};
        if (RAKS_TRUSTED(jack_midi_event_get(&event, buffer, i)) != 0) {
            continue;
        }
        const double early = static_cast<double>(frames) - static_cast<double>(event.time);
        for (std::size_t byte = 0; byte < event.size; ++byte) {
            if (auto message = line.parser.take(event.buffer[byte])) {
                message->came = begins - nanos_from_seconds(early / rate);
                line.messages.push(*message);
            }
        }
    }
    return 0;
}

// A port of ours on the server, and a thread that connects it to the one that is meant: asking the
// server may take its time.
class JackMidiPort {
 public:
    JackMidiPort(std::shared_ptr<MidiLine> line,
                 audio::JackClient client,
                 bool is_input,
                 std::string wanted)
        : line_(std::move(line)),
          client_(std::move(client)),
          is_input_(is_input),
          wanted_(std::move(wanted)),
          thread_([this] { keep_connected(); }) {}

    ~JackMidiPort() {
        is_stopping_ = true;
        line_->has_changed.release();
        thread_.join();
        // Where closing does not return, JACK's thread may still run: it keeps its line.
        static_cast<void>(audio::within(
            audio::kCloseWithin,
            [client = client_.release(), line = line_] { return jack_client_close(client); }));
    }
    JackMidiPort(const JackMidiPort&) = delete;
    JackMidiPort& operator=(const JackMidiPort&) = delete;

    // The name by which the other port was found.
    [[nodiscard]] std::string peer() const {
        const std::lock_guard lock(mutex_);
        return peer_;
    }
    // Once.
    [[nodiscard]] std::optional<std::string> take_trouble() {
        const bool is_news = line_->is_shut_down.load(std::memory_order_relaxed) &&
                             !std::exchange(has_complained_, true);
        return is_news ? std::optional<std::string>(kServerGone) : std::nullopt;
    }

 private:
    void keep_connected() {
        while (!is_stopping_) {
            for (int look = 0; look < kLooks && !is_stopping_; ++look) {
                if (!line_->is_shut_down.load(std::memory_order_relaxed)) {
                    connect();
                }
                static_cast<void>(line_->has_changed.try_acquire_for(kLooksAgain));
            }
            if (!is_stopping_) {
                line_->has_changed.acquire();
            }
        }
    }

    void connect() {
        jack_client_t* const client = client_.get();
        const unsigned long flag = is_input_ ? JackPortIsOutput : JackPortIsInput;
        const std::unique_ptr<const char*, FreePortNames> ports(
            jack_get_ports(client, nullptr, JACK_DEFAULT_MIDI_TYPE, flag));
        std::string peer;
        for (const char** name = ports.get(); name != nullptr && *name != nullptr; ++name) {
            const jack_port_t* const port = jack_port_by_name(client, *name);
            if (port == nullptr) {
                continue;
            }
            const std::vector<std::string> names = names_of(port);
            const auto found = std::find_if(names.begin(), names.end(), [&](const auto& text) {
                return is_midi_port_meant(text, wanted_);
            });
            if (found != names.end()) {
                peer = *found;
                const char* const ours = jack_port_name(line_->port);
                // One that is there already stays.
                jack_connect(client, is_input_ ? *name : ours, is_input_ ? ours : *name);
                break;
            }
        }
        const std::lock_guard lock(mutex_);
        peer_ = std::move(peer);
    }

    std::shared_ptr<MidiLine> line_;
    audio::JackClient client_;
    bool is_input_;
    std::string wanted_;
    bool has_complained_ = false;
    std::atomic<bool> is_stopping_{false};
    mutable std::mutex mutex_;  // of the one below
    std::string peer_;
    std::thread thread_;
};

class JackClockPort final : public MidiClockPort {
 public:
    JackClockPort(const std::shared_ptr<ClockLineOut>& line,
                  audio::JackClient client,
                  const std::string& wanted)
        : line_(line), port_(line, std::move(client), false, wanted) {}

    // The stop goes out with the next period.
    ~JackClockPort() override {
        line_->is_ending.store(true, std::memory_order_release);  // see on_clock_period()
        const HostTime until = host_now() + kStopWithin;
        while (!line_->has_ended.load(std::memory_order_acquire) && host_now() < until) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    JackClockPort(const JackClockPort&) = delete;
    JackClockPort& operator=(const JackClockPort&) = delete;

    void follow(const MidiClockBeats& beats) override {
        jack_latency_range_t range{};
        jack_port_get_latency_range(line_->port, JackPlaybackLatency, &range);
        const auto rate = static_cast<int>(jack_get_sample_rate(line_->client));
        MidiClockBeats earlier = beats;
        earlier.anchor -= std::min<Nanos>(SampleRate(rate).time_of(range.max).time_since_epoch(),
                                          audio::kMostLatency);
        line_->beats.write(earlier);
    }
    std::uint64_t take_sent() override {
        const std::uint64_t sent = line_->sent.load(std::memory_order_relaxed);
        return sent - std::exchange(sent_, sent);
    }
    std::optional<std::string> take_trouble() override { return port_.take_trouble(); }

 private:
    std::shared_ptr<ClockLineOut> line_;
    std::uint64_t sent_ = 0;  // as told last
    JackMidiPort port_;
};

class JackInputPort final : public MidiInputPort {
 public:
    JackInputPort(const std::shared_ptr<InputLine>& line,
                  audio::JackClient client,
                  const std::string& wanted)
        : line_(line), port_(line, std::move(client), true, wanted) {}

    bool take(MidiMessage& message) override { return line_->messages.pop(message); }
    std::string device() override { return midi_device_name(port_.peer()); }
    [[nodiscard]] std::uint64_t lost() const override { return line_->messages.dropped(); }
    std::optional<std::string> take_trouble() override { return port_.take_trouble(); }

 private:
    std::shared_ptr<InputLine> line_;
    JackMidiPort port_;
};

// Makes the port and hands JACK's threads their line. False: the server refuses.
bool set_up_midi(const std::shared_ptr<MidiLine>& line,
                 const char* name,
                 unsigned long flag,
                 JackProcessCallback on_period) {
    line->epoch = host_now().time_since_epoch() - std::chrono::microseconds(jack_get_time());
    line->port = jack_port_register(line->client, name, JACK_DEFAULT_MIDI_TYPE, flag, 0);
    jack_on_shutdown(line->client, on_midi_shutdown, line.get());
    return line->port != nullptr &&
           jack_set_process_callback(line->client, on_period, line.get()) == 0 &&
           jack_set_port_registration_callback(line->client, on_midi_port, line.get()) == 0 &&
           jack_activate(line->client) == 0;
}

// Within what the server may take. Errors: it refuses.
Expected<void> start_midi(const std::shared_ptr<MidiLine>& line,
                          const char* name,
                          unsigned long flag,
                          JackProcessCallback on_period) {
    const auto is_set_up = audio::within(audio::kServerPatience, [line, name, flag, on_period] {
        return set_up_midi(line, name, flag, on_period);
    });
    return is_set_up && *is_set_up ? Expected<void>() : fail("the JACK server refuses it");
}

}  // namespace

Expected<std::unique_ptr<MidiClockPort>> open_jack_midi_clock(const std::string& name,
                                                              int clocks_per_beat) {
    auto client = audio::open_jack_client("raks-clock");
    if (!client) {
        return fail(client.error());
    }
    if (!*client) {
        return std::unique_ptr<MidiClockPort>();
    }
    const auto rate = static_cast<int>(jack_get_sample_rate(client->get()));
    auto line = std::make_shared<ClockLineOut>(rate, clocks_per_beat);
    line->client = client->get();
    if (auto started = start_midi(line, "out", JackPortIsOutput, on_clock_period); !started) {
        return fail(started.error());
    }
    return std::make_unique<JackClockPort>(line, std::move(*client), name);
}

Expected<std::unique_ptr<MidiInputPort>> open_jack_midi_input(const std::string& name) {
    auto client = audio::open_jack_client("raks-control");
    if (!client) {
        return fail(client.error());
    }
    if (!*client) {
        return std::unique_ptr<MidiInputPort>();
    }
    auto line = std::make_shared<InputLine>();
    line->client = client->get();
    if (auto started = start_midi(line, "in", JackPortIsInput, on_input_period); !started) {
        return fail(started.error());
    }
    return std::make_unique<JackInputPort>(line, std::move(*client), name);
}

}  // namespace raks::engine
