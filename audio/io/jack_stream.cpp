#include "audio/io/jack_stream.hpp"

#include <jack/jack.h>
#include <jack/thread.h>

#include <algorithm>
#include <atomic>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/io/counted_blocks.hpp"
#include "audio/io/deadline.hpp"
#include "audio/io/jack_devices.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// JACK's largest period; its callback interleaves into room for that much.
constexpr std::size_t kMostFrames = 8192;
constexpr Nanos kSettles = std::chrono::seconds(1);  // names of ports, after a change

// What JACK's threads use. It outlives a client that cannot be closed.
struct JackLine {
    JackLine(bool input, int channels) : is_input(input), blocks(channels) {}

    const bool is_input;
    CountedBlocks blocks;
    std::vector<jack_port_t*> ports;
    std::vector<float> block;  // interleaved, kMostFrames
    std::atomic<bool> is_shut_down{false};
    std::atomic<bool> have_ports_changed{false};
};

// One period: JACK has a buffer for each port, our callbacks take interleaved samples.
int on_period(jack_nframes_t frames, void* data) noexcept RAKS_NONBLOCKING {
    JackLine& line = *static_cast<JackLine*>(data);
    const HostTime entered = host_now();
    const std::size_t stride = line.ports.size();
    const std::size_t count = std::min<std::size_t>(frames, kMostFrames);
    const std::span<float> block = std::span(line.block).first(count * stride);
    if (!line.is_input) {
        line.blocks.take_output(block, entered);
    }
    for (std::size_t channel = 0; channel < stride; ++channel) {
        // JACK says that its callback may ask for this.
        float* const samples =
            static_cast<float*>(RAKS_TRUSTED(jack_port_get_buffer(line.ports[channel], frames)));
        for (std::size_t i = 0; i < count; ++i) {
            float& own = block[i * stride + channel];
            (line.is_input ? own : samples[i]) = line.is_input ? samples[i] : own;
        }
    }
    if (line.is_input) {
        line.blocks.take_input(block, entered);
    }
    return 0;
}

int on_xrun(void* line) noexcept {
    static_cast<JackLine*>(line)->blocks.note_xrun();
    return 0;
}

void on_shutdown(void* line) noexcept {
    static_cast<JackLine*>(line)->is_shut_down.store(true, std::memory_order_relaxed);
}

void on_port(jack_port_id_t, int, void* line) noexcept {
    static_cast<JackLine*>(line)->have_ports_changed.store(true, std::memory_order_relaxed);
}

class JackStream final : public DeviceStream {
 public:
    JackStream(std::shared_ptr<JackLine> line, JackClient client, std::string device)
        : DeviceStream(std::shared_ptr<CountedBlocks>(line, &line->blocks),
                       SampleRate(static_cast<int>(jack_get_sample_rate(client.get())))),
          line_(std::move(line)),
          client_(std::move(client)),
          name_(jack_get_client_name(client_.get())),
          device_(std::move(device)) {}

    // Where closing does not return, JACK's thread may still run: it keeps its line.
    ~JackStream() override {
        disconnect();
        static_cast<void>(within(kCloseWithin, [client = client_.release(), line = line_] {
            return jack_client_close(client);
        }));
    }
    JackStream(const JackStream&) = delete;
    JackStream& operator=(const JackStream&) = delete;

    // JACK counts to or from the block's first sample.
    [[nodiscard]] Nanos heard_after() const noexcept RAKS_NONBLOCKING override {
        jack_latency_range_t range{};
        const auto way = line_->is_input ? JackCaptureLatency : JackPlaybackLatency;
        // JACK reads it from memory that the server shares, and waits for no change on its thread.
        RAKS_TRUSTED(jack_port_get_latency_range(line_->ports.front(), way, &range));
        const Nanos latency =
            std::min<Nanos>(rate().time_of(range.max).time_since_epoch(), kMostLatency);
        const Nanos block = rate().time_of(blocks().block_frames()).time_since_epoch();
        return line_->is_input ? block - latency : latency;
    }
    // What is handed over is in the cycle of all clients.
    [[nodiscard]] Nanos behind_server() const noexcept RAKS_NONBLOCKING override {
        return line_->is_input ? Nanos(0) : heard_after();
    }
    [[nodiscard]] bool is_alive(HostTime) const noexcept override {
        return !line_->is_shut_down.load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::string client_name() const override { return name_; }
    // -1: the server runs without real time.
    [[nodiscard]] int callback_priority() const override {
        return std::max(0, jack_client_real_time_priority(client_.get()));
    }

    // An input follows its client, which may leave and come back. The names of ports are read from
    // memory that the server shares; only connecting asks the server.
    [[nodiscard]] std::optional<DeviceEvent> poll() override {
        // JACK tells of a port that goes while its name may still be read: looked at for a while.
        const HostTime now = host_now();
        if (line_->have_ports_changed.exchange(false, std::memory_order_relaxed)) {
            looks_until_ = now + kSettles;
        }
        if (!line_->is_input || now >= looks_until_) {
            return std::nullopt;
        }
        const bool is_there = !jack_ports(client_.get(), device_, true).empty();
        if (is_there == is_source_there_) {
            return std::nullopt;
        }
        is_source_there_ = is_there;
        if (is_there) {
            connect_ports();
        }
        return DeviceEvent{
            .kind = is_there ? DeviceEvent::Kind::source_back : DeviceEvent::Kind::source_gone,
            .id = device_};
    }

    // Port n to port n, as far as both sides have them.
    void connect_ports() {
        const std::vector<std::string> theirs = jack_ports(client_.get(), device_, line_->is_input);
        for (std::size_t i = 0; i < std::min(theirs.size(), line_->ports.size()); ++i) {
            const char* const ours = jack_port_name(line_->ports[i]);
            jack_connect(client_.get(),
                         line_->is_input ? theirs[i].c_str() : ours,
                         line_->is_input ? ours : theirs[i].c_str());
        }
    }

 private:
    std::shared_ptr<JackLine> line_;
    JackClient client_;
    std::string name_;
    std::string device_;  // the other client
    bool is_source_there_ = true;
    HostTime looks_until_{};  // at the ports, after a change
};

// Makes the ports and hands JACK's threads their line. False: the server refuses.
bool set_up(jack_client_t* client, JackLine& line, int channels) {
    for (int i = 0; i < channels; ++i) {
        const std::string name = fmt::format("{}_{}", line.is_input ? "in" : "out", i);
        line.ports.push_back(jack_port_register(client,
                                                name.c_str(),
                                                JACK_DEFAULT_AUDIO_TYPE,
                                                line.is_input ? JackPortIsInput : JackPortIsOutput,
                                                0));
    }
    line.block.resize(kMostFrames * line.ports.size());
    jack_on_shutdown(client, on_shutdown, &line);
    return std::find(line.ports.begin(), line.ports.end(), nullptr) == line.ports.end() &&
           jack_set_process_callback(client, on_period, &line) == 0 &&
           jack_set_xrun_callback(client, on_xrun, &line) == 0 &&
           jack_set_port_registration_callback(client, on_port, &line) == 0 &&
           jack_activate(client) == 0;
}

}  // namespace

Expected<std::unique_ptr<DeviceStream>> open_jack_stream(DeviceStream::Direction direction,
                                                         const AudioDevice& device,
                                                         const StreamConfig& config) {
    const bool is_input = direction == DeviceStream::Direction::input;
    const int most = is_input ? device.input_channels : device.output_channels;
    auto client = open_jack_client(is_input ? "raks-in" : "raks");
    if (!client) {
        return fail(client.error());
    }
    if (!*client) {
        return fail("the JACK server is not running");
    }
    const int channels = std::clamp(config.channels, 1, std::min(most, 8));
    auto line = std::make_shared<JackLine>(is_input, channels);
    jack_client_t* const connection = client->get();
    auto stream = std::make_unique<JackStream>(line, std::move(*client), device.id);
    const auto is_set_up = within(kServerPatience, [connection, line, channels] {
        return set_up(connection, *line, channels);
    });
    if (!is_set_up || !*is_set_up) {
        return fail("the JACK server refuses it");
    }
    stream->connect_ports();
    return stream;
}

}  // namespace raks::audio
