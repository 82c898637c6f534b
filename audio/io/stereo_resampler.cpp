#include "audio/io/stereo_resampler.hpp"

#include <algorithm>
#include <string>

#include <samplerate.h>

namespace raks::audio {

struct StereoResampler::State {
    SRC_STATE* converter = nullptr;
    double ratio = 1.0;
    bool is_copy = true;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { src_delete(converter); }
};

StereoResampler::StereoResampler() : state_(std::make_unique<State>()) {}
StereoResampler::~StereoResampler() = default;
StereoResampler::StereoResampler(StereoResampler&&) noexcept = default;
StereoResampler& StereoResampler::operator=(StereoResampler&&) noexcept = default;

Expected<void> StereoResampler::prepare(SampleRate from, SampleRate to) {
    state_ = std::make_unique<State>();
    state_->ratio = static_cast<double>(to.hertz()) / from.hertz();
    state_->is_copy = from == to;
    if (!state_->is_copy) {
        int error = 0;
        state_->converter = src_new(SRC_SINC_FASTEST, 2, &error);
        if (state_->converter == nullptr) {
            return fail(std::string("resampler: ") + src_strerror(error));
        }
    }
    return {};
}

StereoResampler::Progress StereoResampler::process(
    std::span<const float> input, std::span<float> output) noexcept RAKS_NONBLOCKING {
    if (state_->is_copy) {
        const std::size_t samples = std::min(input.size(), output.size());
        std::copy_n(input.data(), samples, output.data());
        return {samples / 2, samples / 2};
    }
    SRC_DATA data{};
    data.data_in = input.data();
    data.input_frames = static_cast<long>(input.size() / 2);
    data.data_out = output.data();
    data.output_frames = static_cast<long>(output.size() / 2);
    data.src_ratio = state_->ratio;
    src_process(state_->converter, &data);  // fails only on misuse; then nothing moves
    return {static_cast<std::size_t>(data.input_frames_used),
            static_cast<std::size_t>(data.output_frames_gen)};
}

void StereoResampler::reset() noexcept RAKS_NONBLOCKING {
    if (!state_->is_copy) {
        src_reset(state_->converter);
    }
}

}  // namespace raks::audio
