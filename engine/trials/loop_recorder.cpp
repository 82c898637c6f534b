#include "engine/trials/loop_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "audio/io/jack_loop.hpp"
#include "engine/trials/best_match.hpp"

namespace raks::engine {
namespace {

// Length of the attack that is searched for, seconds.
constexpr double kTemplateSeconds = 0.02;
// Seconds searched to either side of the delay that the beat before had.
constexpr double kSearchSeconds = 0.03;
// A match below this is some other sound than the beat's attack.
constexpr double kLeastCorrelation = 0.9;
// Louder than this is sound: -60 dBFS, as a loop of ports adds no noise.
constexpr float kLeastSound = 1e-3F;

std::int64_t frames_of(double seconds, SampleRate rate) {
    return std::llround(seconds * rate.hertz());
}

}  // namespace

// Keeps the first channel and the time of every block, in memory that was allocated before: the
// callback must not allocate.
class LoopRecorder::Tape final : public audio::StreamCallback {
 public:
    // Before run(): no callback touches the memory yet. `stream`: which calls back.
    void make_room(double seconds, const audio::DeviceStream& stream) {
        stream_ = &stream;
        samples_.resize(static_cast<std::size_t>(frames_of(seconds, stream.rate())));
        blocks_.resize(samples_.size() / BlockClock::kSmallestBlock);
    }

    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override {
        // acquire: pairs with the release in run(): the room is there.
        if (!is_running_.load(std::memory_order_acquire)) {
            return;
        }
        const auto stride = static_cast<std::size_t>(channels);
        const std::size_t frames = interleaved.size() / stride;
        std::size_t at = frames_.load(std::memory_order_relaxed);  // relaxed: only we write it
        const std::size_t block = block_count_.load(std::memory_order_relaxed);
        // When the room is used up, the recording is complete.
        if (at + frames > samples_.size() || block == blocks_.size()) {
            return;
        }
        blocks_[block] = {static_cast<std::int64_t>(at + frames),
                          time.entered + stream_->heard_after()};
        for (std::size_t i = 0; i < frames; ++i) {
            samples_[at++] = interleaved[i * stride];
        }
        // Before the frames: who reads a number of frames sees their blocks.
        block_count_.store(block + 1, std::memory_order_relaxed);
        // release: pairs with the acquire in copy().
        frames_.store(at, std::memory_order_release);
    }

    void run() noexcept { is_running_.store(true, std::memory_order_release); }

    [[nodiscard]] LoopRecording copy() const {
        const std::size_t frames = frames_.load(std::memory_order_acquire);
        const std::size_t blocks = block_count_.load(std::memory_order_relaxed);
        const auto count = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
        return {BlockClock(stream_->rate(), {blocks_.begin(), blocks_.begin() + count(blocks)}),
                {samples_.begin(), samples_.begin() + count(frames)}};
    }
    [[nodiscard]] bool is_empty() const noexcept {
        return frames_.load(std::memory_order_acquire) == 0;
    }

 private:
    const audio::DeviceStream* stream_ = nullptr;
    std::vector<float> samples_;
    std::vector<BlockClock::Mark> blocks_;
    std::atomic<bool> is_running_{false};
    std::atomic<std::size_t> frames_{0};
    std::atomic<std::size_t> block_count_{0};
};

LoopRecorder::LoopRecorder(std::unique_ptr<Tape> tape) : tape_(std::move(tape)) {}

LoopRecorder::~LoopRecorder() = default;

Expected<std::unique_ptr<LoopRecorder>> LoopRecorder::start_beside(
    std::span<const audio::AudioDevice> devices, const audio::AudioDevice& output, double seconds) {
    // The input of the same JACK device: its ports are what our output can be connected to.
    const auto input = std::find_if(devices.begin(), devices.end(), [&](const auto& device) {
        return device.host_api == "JACK" && device.name == output.name && device.input_channels > 0;
    });
    if (output.host_api != "JACK" || input == devices.end()) {
        return fail("the output is no JACK device with an input");
    }
    return start(*input, seconds);
}

Expected<std::unique_ptr<LoopRecorder>> LoopRecorder::start(const audio::AudioDevice& input,
                                                            double seconds) {
    std::unique_ptr<LoopRecorder> recorder(new LoopRecorder(std::make_unique<Tape>()));
    auto stream = audio::DeviceStream::open_input(input, {.channels = 1, .stays = true});
    if (!stream) {
        return fail(stream.error());
    }
    recorder->stream_ = std::move(*stream);
    recorder->tape_->make_room(seconds, *recorder->stream_);
    recorder->stream_->connect(*recorder->tape_);
    return recorder;
}

void LoopRecorder::keep() noexcept { tape_->run(); }

Expected<void> LoopRecorder::close_loop(const audio::DeviceStream& output) {
    // Connected first, so that the recording begins with what the loop brings.
    if (auto connected = audio::connect_jack_loop(output, *stream_); !connected) {
        return fail(connected.error());
    }
    keep();
    return {};
}

Expected<LoopRecording> LoopRecorder::recording() const {
    if (tape_->is_empty()) {
        return fail("nothing came back");
    }
    return tape_->copy();
}

namespace {

// Index of the first sample that is not silence; the size when there is none.
std::int64_t first_sound(std::span<const float> samples) {
    const auto found = std::find_if(samples.begin(), samples.end(), [](float sample) {
        return std::abs(sample) > kLeastSound;
    });
    return found - samples.begin();
}

// The first of the interleaved channels, as the recording has one.
std::vector<float> left_channel(const audio::GeneratedMusic& music) {
    std::vector<float> left;
    const auto stride = static_cast<std::size_t>(music.channels);
    for (std::size_t i = 0; i < music.samples.size(); i += stride) {
        left.push_back(music.samples[i]);
    }
    return left;
}

}  // namespace

// Each beat is searched near the delay of the one before: the search stays short, and a beat cannot
// be taken for its neighbour. The first delay comes from the first sound of both.
std::vector<AudibleBeat> audible_beats(const LoopRecording& recording,
                                       const audio::GeneratedMusic& music) {
    std::vector<AudibleBeat> audible;
    const SampleRate rate = music.rate;
    if (recording.rate() != rate) {
        return audible;
    }
    const std::vector<float> sent = left_channel(music);
    const std::span<const float> samples = recording.samples();
    // Frames from a sample's place in the music to its place in the recording.
    std::int64_t delay = first_sound(samples) - first_sound(sent);
    const std::int64_t length = frames_of(kTemplateSeconds, rate);
    const std::int64_t reach = frames_of(kSearchSeconds, rate);
    for (std::size_t beat = 0; beat < music.beats.size(); ++beat) {
        const std::int64_t at = rate.index_at(music.beats[beat].time);
        if (at + length > std::ssize(sent)) {
            break;
        }
        const auto wanted =
            std::span(sent).subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(length));
        const Match match = best_match(samples, wanted, at + delay - reach, at + delay + reach + 1);
        if (match.correlation > kLeastCorrelation) {
            delay = match.place - at;
            audible.push_back({beat, recording.heard_at(match.place)});
        }
    }
    return audible;
}

}  // namespace raks::engine
