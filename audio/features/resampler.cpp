#include "audio/features/resampler.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <samplerate.h>

namespace raks::audio {

struct Resampler::State {
    SRC_STATE* converter = nullptr;
    double ratio = 1.0;
    bool is_copy = true;
    Nanos delay{};

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { src_delete(converter); }
};

namespace {

/// How far the output's time lags behind the input's at worst, over a quarter of a second.
Nanos measured_delay(Resampler& resampler, SampleRate from, SampleRate to) {
    constexpr std::size_t kChunk = 16;
    const std::array<float, kChunk> silence{};
    std::array<float, 1024> out{};
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

}  // namespace

Resampler::Resampler() : state_(std::make_unique<State>()) {}
Resampler::~Resampler() = default;
Resampler::Resampler(Resampler&&) noexcept = default;
Resampler& Resampler::operator=(Resampler&&) noexcept = default;

Expected<void> Resampler::prepare(SampleRate from, SampleRate to) {
    state_ = std::make_unique<State>();
    state_->is_copy = from == to;
    if (state_->is_copy) {
        return {};
    }
    state_->ratio = static_cast<double>(to.hertz()) / from.hertz();
    int error = 0;
    state_->converter = src_new(SRC_SINC_FASTEST, 1, &error);
    if (state_->converter == nullptr) {
        return fail(std::string("resampler: ") + src_strerror(error));
    }
    state_->delay = measured_delay(*this, from, to);
    reset();
    return {};
}

Resampler::Progress Resampler::process(std::span<const float> input,
                                       std::span<float> output) noexcept RAKS_NONBLOCKING {
    if (state_->is_copy) {
        const std::size_t count = std::min(input.size(), output.size());
        std::copy_n(input.data(), count, output.data());
        return {count, count};
    }
    SRC_DATA data{};
    data.data_in = input.data();
    data.input_frames = static_cast<long>(input.size());
    data.data_out = output.data();
    data.output_frames = static_cast<long>(output.size());
    data.src_ratio = state_->ratio;
    src_process(state_->converter, &data);  // fails only on misuse; then nothing moves
    return {static_cast<std::size_t>(data.input_frames_used),
            static_cast<std::size_t>(data.output_frames_gen)};
}

void Resampler::reset() noexcept RAKS_NONBLOCKING {
    if (!state_->is_copy) {
        src_reset(state_->converter);
    }
}

Nanos Resampler::delay() const noexcept { return state_->delay; }

}  // namespace raks::audio
