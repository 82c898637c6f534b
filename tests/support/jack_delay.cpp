#include "tests/support/jack_delay.hpp"

#include <jack/jack.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <vector>

namespace raks::test {

struct JackDelay::Line {
    jack_client_t* client = nullptr;
    jack_port_t* in = nullptr;
    jack_port_t* out = nullptr;
    std::vector<float> ring;
    std::size_t at = 0;
    std::atomic<int> taps{-1};
    std::size_t silent = 0;  // frames so far
};

namespace {

int repeat(jack_nframes_t frames, void* data) {
    auto& line = *static_cast<JackDelay::Line*>(data);
    const auto* const in = static_cast<const float*>(jack_port_get_buffer(line.in, frames));
    auto* const out = static_cast<float*>(jack_port_get_buffer(line.out, frames));
    const std::size_t pause = jack_get_sample_rate(line.client) / 10;
    for (jack_nframes_t i = 0; i < frames; ++i) {
        if (std::abs(in[i]) > 0.1F) {
            if (line.silent > pause && line.taps >= 0) {
                static_cast<void>(write(line.taps, "x", 1) == 1);
            }
            line.silent = 0;
        }
        ++line.silent;
        out[i] = line.ring[line.at];
        line.ring[line.at] = in[i];
        line.at = (line.at + 1) % line.ring.size();
    }
    return 0;
}

}  // namespace

JackDelay::JackDelay(const std::string& name, std::size_t frames)
    : line_(std::make_unique<Line>()) {
    line_->ring.resize(frames);
    line_->client = jack_client_open(name.c_str(), JackNoStartServer, nullptr);
    if (line_->client == nullptr) {
        line_.reset();
        return;
    }
    const auto add = [&](const char* port, JackPortFlags direction) {
        return jack_port_register(
            line_->client, port, JACK_DEFAULT_AUDIO_TYPE, static_cast<unsigned long>(direction), 0);
    };
    line_->in = add("playback_1", JackPortIsInput);
    line_->out = add("capture_1", JackPortIsOutput);
    jack_set_process_callback(line_->client, repeat, line_.get());
    jack_activate(line_->client);
}

void JackDelay::tap_into(int descriptor) noexcept { line_->taps = descriptor; }

JackDelay::~JackDelay() {
    if (line_) {
        jack_client_close(line_->client);
    }
}

}  // namespace raks::test
