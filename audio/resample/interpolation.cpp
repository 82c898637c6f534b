#include "audio/resample/interpolation.hpp"

#include <cmath>

namespace raks::audio {

std::vector<float> read_between(std::span<const float> sound,
                                double first,
                                double step,
                                std::size_t count) {
    const auto size = static_cast<std::ptrdiff_t>(sound.size());
    const auto sample = [&](std::ptrdiff_t at) {
        return at >= 0 && at < size ? sound[static_cast<std::size_t>(at)] : 0.0F;
    };
    std::vector<float> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double place = first + step * static_cast<double>(i);
        const double below = std::floor(place);
        const auto at = static_cast<std::ptrdiff_t>(below);
        const auto t = static_cast<float>(place - below);
        const float a = sample(at - 1);
        const float b = sample(at);
        const float c = sample(at + 1);
        const float d = sample(at + 2);
        const float bend = 3.0F * (b - c) + d - a;
        const float lift = 2.0F * a - 5.0F * b + 4.0F * c - d;
        result[i] = b + 0.5F * t * (c - a + t * (lift + t * bend));
    }
    return result;
}

}  // namespace raks::audio
