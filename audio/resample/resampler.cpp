#include "audio/resample/resampler.hpp"

#include <speex/speex_resampler.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audio/resample/polyphase.hpp"

namespace raks::audio {

// One of the two, and none where the rates are equal. The library's converter is freed with the
// object.
struct Resampler::State {
    std::optional<PolyphaseResampler> polyphase;
    SpeexResamplerState* converter = nullptr;
    std::size_t channels = 1;
    bool is_copy = true;
    Nanos delay{};

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (converter != nullptr) {
            speex_resampler_destroy(converter);
        }
    }
};

namespace {

constexpr int kQuality = 5;  // 0 to 10 in speexdsp; why 5: docs/decisions/0001

// Longest lag of the output's time behind the input's, over a quarter of a second of silence in
// small chunks. The lag varies as output frames come in groups.
Nanos measured_delay(Resampler& resampler, SampleRate from, SampleRate to, std::size_t channels) {
    constexpr std::size_t kChunk = 16;
    const std::vector<float> silence(kChunk * channels);
    std::vector<float> out(1024 * channels);
    Nanos worst{};
    std::int64_t taken = 0;
    std::int64_t made = 0;
    while (taken < from.hertz() / 4) {
        const auto progress = resampler.process(silence, out);
        taken += static_cast<std::int64_t>(progress.taken);
        made += static_cast<std::int64_t>(progress.made);
        worst = std::max(worst, from.time_of(taken) - to.time_of(made));
    }
    return worst;
}

Expected<SpeexResamplerState*> speex_converter(SampleRate from, SampleRate to, int channels) {
    int error = 0;
    SpeexResamplerState* const converter =
        speex_resampler_init(static_cast<spx_uint32_t>(channels),
                             static_cast<spx_uint32_t>(from.hertz()),
                             static_cast<spx_uint32_t>(to.hertz()),
                             kQuality,
                             &error);
    if (converter == nullptr) {
        return fail(std::string("resampler: ") + speex_resampler_strerror(error));
    }
    return converter;
}

}  // namespace

Resampler::Resampler() : state_(std::make_unique<State>()) {}
Resampler::~Resampler() = default;
Resampler::Resampler(Resampler&&) noexcept = default;
Resampler& Resampler::operator=(Resampler&&) noexcept = default;

Expected<void> Resampler::prepare(SampleRate from, SampleRate to, int channels) {
    state_ = std::make_unique<State>();
    state_->channels = static_cast<std::size_t>(channels);
    state_->is_copy = from == to;
    if (state_->is_copy) {
        return {};
    }
    if (channels == 1) {
        state_->polyphase = PolyphaseResampler::create(from, to);
    }
    if (!state_->polyphase) {
        auto converter = speex_converter(from, to, channels);
        if (!converter) {
            return fail(converter.error());
        }
        state_->converter = *converter;
    }
    // The measurement changes the converter's state: start afresh after it.
    reset();
    state_->delay = measured_delay(*this, from, to, state_->channels);
    reset();
    return {};
}

Resampler::Progress Resampler::process(std::span<const float> input,
                                       std::span<float> output) noexcept RAKS_NONBLOCKING {
    const std::size_t channels = state_->channels;
    if (state_->is_copy) {
        // Equal rates: samples pass unchanged and without delay.
        const std::size_t frames = std::min(input.size(), output.size()) / channels;
        std::copy_n(input.data(), frames * channels, output.data());
        return {frames, frames};
    }
    if (state_->polyphase) {
        const auto progress = state_->polyphase->process(input, output);
        return {progress.taken, progress.made};
    }
    // In: frames offered and room for; out: frames taken and made.
    auto taken = static_cast<spx_uint32_t>(input.size() / channels);
    auto made = static_cast<spx_uint32_t>(output.size() / channels);
    // Speex allocates when its rates and channels are set, and here nothing.
    RAKS_TRUSTED(speex_resampler_process_interleaved_float(
        state_->converter, input.data(), &taken, output.data(), &made));
    return {taken, made};
}

void Resampler::reset() noexcept RAKS_NONBLOCKING {
    if (state_->polyphase) {
        state_->polyphase->reset();
    } else if (!state_->is_copy) {
        // Skips the filter's delay at the start: output frame 0 belongs to input frame 0. Both only
        // write what Speex has.
        RAKS_TRUSTED(speex_resampler_reset_mem(state_->converter));
        RAKS_TRUSTED(speex_resampler_skip_zeros(state_->converter));
    }
}

Nanos Resampler::delay() const noexcept { return state_->delay; }

}  // namespace raks::audio
