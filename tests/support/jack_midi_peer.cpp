#include "tests/support/jack_midi_peer.hpp"

#include <jack/jack.h>
#include <jack/midiport.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <thread>

namespace raks::test {

// A test's client may lock in its callback.
struct JackMidiPeer::Line {
    jack_client_t* client = nullptr;
    jack_port_t* in = nullptr;
    jack_port_t* out = nullptr;
    std::atomic<int> xruns{0};
    std::mutex mutex;
    std::vector<Byte> bytes;
    std::deque<std::vector<std::uint8_t>> waiting;
};

namespace {

int note_and_play(jack_nframes_t frames, void* data) {
    auto& line = *static_cast<JackMidiPeer::Line*>(data);
    const std::lock_guard lock(line.mutex);
    const std::int64_t period = jack_last_frame_time(line.client);
    void* const in = jack_port_get_buffer(line.in, frames);
    for (jack_nframes_t i = 0; i < jack_midi_get_event_count(in); ++i) {
        jack_midi_event_t event;
        jack_midi_event_get(&event, in, i);
        for (std::size_t byte = 0; byte < event.size; ++byte) {
            line.bytes.push_back({period + event.time, event.buffer[byte]});
        }
    }
    void* const out = jack_port_get_buffer(line.out, frames);
    jack_midi_clear_buffer(out);
    for (; !line.waiting.empty(); line.waiting.pop_front()) {
        const auto& message = line.waiting.front();
        jack_midi_event_write(out, 0, message.data(), message.size());
    }
    return 0;
}

int count_xrun(void* data) {
    ++static_cast<JackMidiPeer::Line*>(data)->xruns;
    return 0;
}

template <typename Condition>
bool wait_for(std::chrono::seconds patience, Condition condition) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > until) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

}  // namespace

JackMidiPeer::JackMidiPeer(const std::string& name) : line_(std::make_unique<Line>()) {
    line_->client = jack_client_open(name.c_str(), JackNoStartServer, nullptr);
    if (line_->client == nullptr) {
        line_.reset();
        return;
    }
    line_->in = jack_port_register(line_->client,
                                   "in",
                                   JACK_DEFAULT_MIDI_TYPE,
                                   static_cast<unsigned long>(JackPortIsInput),
                                   0);
    line_->out = jack_port_register(line_->client,
                                    "out",
                                    JACK_DEFAULT_MIDI_TYPE,
                                    static_cast<unsigned long>(JackPortIsOutput),
                                    0);
    jack_set_process_callback(line_->client, note_and_play, line_.get());
    jack_set_xrun_callback(line_->client, count_xrun, line_.get());
    jack_activate(line_->client);
}

int JackMidiPeer::xruns() const { return line_->xruns; }

JackMidiPeer::~JackMidiPeer() {
    if (line_) {
        jack_client_close(line_->client);
    }
}

std::vector<JackMidiPeer::Byte> JackMidiPeer::bytes() const {
    const std::lock_guard lock(line_->mutex);
    return line_->bytes;
}

bool JackMidiPeer::wait_for_bytes(std::size_t count, std::chrono::seconds patience) const {
    return wait_for(patience, [&] { return bytes().size() >= count; });
}

bool JackMidiPeer::wait_for_listener(std::chrono::seconds patience) const {
    return wait_for(patience, [&] { return jack_port_connected(line_->out) > 0; });
}

void JackMidiPeer::send(const std::vector<std::uint8_t>& message) {
    const std::lock_guard lock(line_->mutex);
    line_->waiting.push_back(message);
}

double JackMidiPeer::sample_at(std::chrono::steady_clock::time_point time) const {
    const auto now = std::chrono::steady_clock::now();
    const double ago = std::chrono::duration<double>(now - time).count();
    return static_cast<double>(jack_frame_time(line_->client)) -
           ago * jack_get_sample_rate(line_->client);
}

}  // namespace raks::test
