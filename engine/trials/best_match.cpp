#include "engine/trials/best_match.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
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

}  // namespace

Match best_match(std::span<const float> samples,
                 std::span<const float> wanted,
                 std::int64_t from,
                 std::int64_t to) {
    Match best;
    const std::int64_t last = std::ssize(samples) - std::ssize(wanted) + 1;
    for (std::int64_t at = std::max<std::int64_t>(0, from); at < std::min(to, last); ++at) {
        const double value =
            correlation(samples.subspan(static_cast<std::size_t>(at), wanted.size()), wanted);
        if (value > best.correlation) {
            best = {at, value};
        }
    }
    return best;
}

}  // namespace raks::engine
