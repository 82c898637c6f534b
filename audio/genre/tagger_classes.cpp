#include "audio/genre/tagger_classes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "audio/genre/pattern_network.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

Expected<void> check_size(const char* name, std::size_t size, std::size_t wanted) {
    return size == wanted
               ? Expected<void>()
               : fail(fmt::format("tagger.{} has {} numbers, must have {}", name, size, wanted));
}

}  // namespace

void TaggerClasses::log_chances(std::span<const float, kTagFeatures> embedding,
                                std::span<float> logs) const noexcept RAKS_NONBLOCKING {
    for (std::size_t c = 0; c < logs.size(); ++c) {
        float sum = bias[c];
        for (std::size_t i = 0; i < kTagFeatures; ++i) {
            sum += weights[c * kTagFeatures + i] * (embedding[i] - mean[i]) / deviation[i];
        }
        logs[c] = sum;
    }
    normalize_logs(logs);
    float chance = 0.0F;
    float unknown = 0.0F;
    for (std::size_t c = 0; c < logs.size(); ++c) {
        chance += knows[c] ? 0.0F : std::exp(logs[c]);
        unknown += knows[c] ? 0.0F : 1.0F;
    }
    for (std::size_t c = 0; c < logs.size(); ++c) {
        logs[c] = knows[c] ? logs[c] : std::log(chance / unknown);
    }
}

Expected<void> validate(const TaggerClasses& tagger, std::size_t classes) {
    for (const Expected<void>& checked :
         {check_size("mean", tagger.mean.size(), kTagFeatures),
          check_size("deviation", tagger.deviation.size(), kTagFeatures),
          check_size("weights", tagger.weights.size(), classes * kTagFeatures),
          check_size("bias", tagger.bias.size(), classes),
          check_size("knows", tagger.knows.size(), classes)}) {
        if (!checked) {
            return checked;
        }
    }
    // Larger numbers would make infinities of sums; a NaN fails the comparison.
    const auto is_sane = [](float number) { return std::abs(number) < 1e3F; };
    const auto are_sane = [&](const std::vector<float>& numbers) {
        return std::all_of(numbers.begin(), numbers.end(), is_sane);
    };
    if (!are_sane(tagger.mean) || !are_sane(tagger.weights) || !are_sane(tagger.bias) ||
        !std::all_of(tagger.deviation.begin(), tagger.deviation.end(), [](float number) {
            return number > 1e-6F && number < 1e3F;
        })) {
        return fail(std::string("tagger has a number that is not below 1000, or a deviation of 0"));
    }
    return {};
}

}  // namespace raks::audio
