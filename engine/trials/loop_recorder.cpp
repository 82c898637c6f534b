#include "engine/trials/loop_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "audio/io/jack_loop.hpp"
#include "base/statistics.hpp"

namespace raks::engine {
namespace {

// Blocks within this many seconds to either side of a sample date it.
constexpr double kMedianSeconds = 0.5;
// Length of the attack that is searched for, seconds.
constexpr double kTemplateSeconds = 0.02;
// Seconds searched to either side of the delay that the beat before had.
constexpr double kSearchSeconds = 0.03;
// A match below this is some other sound than the beat's attack.
constexpr double kLeastCorrelation = 0.9;
// Louder than this is sound: -60 dBFS, as a loop of ports adds no noise.
constexpr float kLeastSound = 1e-3F;
// Room is made for the times of blocks of at least this many frames.
constexpr std::size_t kSmallestBlock = 16;

std::int64_t frames_of(double seconds, SampleRate rate) {
    return std::llround(seconds * rate.hertz());
}

}  // namespace

LoopRecording::LoopRecording(SampleRate rate,
                             Nanos input_latency,
                             std::vector<float> samples,
                             std::vector<Block> blocks)
    : rate_(rate),
      input_latency_(input_latency),
      samples_(std::move(samples)),
      blocks_(std::move(blocks)) {}

HostTime LoopRecording::heard_at(std::int64_t frame) const {
    // Every block says when frame 0 would have been; a late wake-up says too late. The median over
    // the blocks nearby takes such ones out.
    const std::int64_t reach = frames_of(kMedianSeconds, rate_);
    const auto starts_before = [](const Block& block, std::int64_t at) {
        return block.first_frame < at;
    };
    // At least one block, even when the frame lies outside the recording.
    const auto from =
        std::lower_bound(blocks_.begin(), blocks_.end() - 1, frame - reach, starts_before);
    const auto to = std::lower_bound(from + 1, blocks_.end(), frame + reach, starts_before);
    std::vector<Nanos> origins;  // host time of frame 0, as each block has it
    for (auto block = from; block != to; ++block) {
        origins.push_back(block->entered.time_since_epoch() -
                          rate_.time_of(block->first_frame).time_since_epoch());
    }
    // Subtracted: the input's latency is between the loop and the callback.
    return HostTime(upper_median(std::move(origins)) + rate_.time_of(frame).time_since_epoch() -
                    input_latency_);
}

// Keeps the first channel and the time of every block, in memory that was allocated before: the
// callback must not allocate.
class LoopRecorder::Tape final : public audio::StreamCallback {
 public:
    // Before run(): no callback touches the memory yet.
    void make_room(double seconds, SampleRate rate) {
        samples_.resize(static_cast<std::size_t>(frames_of(seconds, rate)));
        blocks_.resize(samples_.size() / kSmallestBlock);
    }

    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& time) noexcept override {
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
        blocks_[block] = {static_cast<std::int64_t>(at), time.entered};
        for (std::size_t i = 0; i < frames; ++i) {
            samples_[at++] = interleaved[i * stride];
        }
        // Before the frames: who reads a number of frames sees their blocks.
        block_count_.store(block + 1, std::memory_order_relaxed);
        // release: pairs with the acquire in copy().
        frames_.store(at, std::memory_order_release);
    }

    void run() noexcept { is_running_.store(true, std::memory_order_release); }

    [[nodiscard]] LoopRecording copy(SampleRate rate, Nanos input_latency) const {
        const std::size_t frames = frames_.load(std::memory_order_acquire);
        const std::size_t blocks = block_count_.load(std::memory_order_relaxed);
        const auto count = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
        return {rate,
                input_latency,
                {samples_.begin(), samples_.begin() + count(frames)},
                {blocks_.begin(), blocks_.begin() + count(blocks)}};
    }
    [[nodiscard]] bool is_empty() const noexcept {
        return frames_.load(std::memory_order_acquire) == 0;
    }

 private:
    std::vector<float> samples_;
    std::vector<LoopRecording::Block> blocks_;
    std::atomic<bool> is_running_{false};
    std::atomic<std::size_t> frames_{0};
    std::atomic<std::size_t> block_count_{0};
};

LoopRecorder::LoopRecorder(std::unique_ptr<Tape> tape) : tape_(std::move(tape)) {}

LoopRecorder::~LoopRecorder() = default;

Expected<std::unique_ptr<LoopRecorder>> LoopRecorder::start(
    std::span<const audio::AudioDevice> devices, const audio::AudioDevice& output, double seconds) {
    // The input of the same JACK device: its ports are what our output can be connected to.
    const auto input = std::find_if(devices.begin(), devices.end(), [&](const auto& device) {
        return device.host_api == "JACK" && device.name == output.name && device.input_channels > 0;
    });
    if (output.host_api != "JACK" || input == devices.end()) {
        return fail("the output is no JACK device with an input");
    }
    std::unique_ptr<LoopRecorder> recorder(new LoopRecorder(std::make_unique<Tape>()));
    auto stream = audio::DeviceStream::open_input(*input, {.channels = 1});
    if (!stream) {
        return fail(stream.error());
    }
    recorder->stream_ = std::move(*stream);
    recorder->tape_->make_room(seconds, recorder->stream_->rate());
    recorder->stream_->connect(*recorder->tape_);
    return recorder;
}

Expected<void> LoopRecorder::close_loop(const audio::DeviceStream& output) {
    // Connected first, so that the recording begins with what the loop brings.
    if (auto connected = audio::connect_jack_loop(output, *stream_); !connected) {
        return fail(connected.error());
    }
    tape_->run();
    return {};
}

Expected<LoopRecording> LoopRecorder::recording() const {
    if (tape_->is_empty()) {
        return fail("nothing came back");
    }
    return tape_->copy(stream_->rate(), stream_->latency());
}

namespace {

// Normalized correlation of two stretches of the same length, [-1, 1]; 0 when one is silent.
double correlation(std::span<const float> a, std::span<const float> b) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += static_cast<double>(a[i]) * static_cast<double>(b[i]);
        aa += static_cast<double>(a[i]) * static_cast<double>(a[i]);
        bb += static_cast<double>(b[i]) * static_cast<double>(b[i]);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

// Index of the first sample that is not silence; the size when there is none.
std::int64_t first_sound(std::span<const float> samples) {
    const auto found = std::find_if(samples.begin(), samples.end(), [](float sample) {
        return std::abs(sample) > kLeastSound;
    });
    return found - samples.begin();
}

// Start of the best match of `wanted` in `samples`, searched from `from` to `to`; nothing when no
// correlation exceeds kLeastCorrelation.
std::optional<std::int64_t> best_place(std::span<const float> samples,
                                       std::span<const float> wanted,
                                       std::int64_t from,
                                       std::int64_t to) {
    std::optional<std::int64_t> best;
    double best_correlation = kLeastCorrelation;
    const std::int64_t last = std::ssize(samples) - std::ssize(wanted);
    for (std::int64_t at = std::max<std::int64_t>(0, from); at < std::min(to, last); ++at) {
        const double value =
            correlation(samples.subspan(static_cast<std::size_t>(at), wanted.size()), wanted);
        if (value > best_correlation) {
            best = at;
            best_correlation = value;
        }
    }
    return best;
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
        const auto place = best_place(samples, wanted, at + delay - reach, at + delay + reach + 1);
        if (place) {
            delay = *place - at;
            audible.push_back({beat, recording.heard_at(*place)});
        }
    }
    return audible;
}

}  // namespace raks::engine
