#include "motion/figures/foot_events.hpp"

#include <algorithm>
#include <cmath>

#include "motion/figures/clip_conditioning.hpp"

namespace raks::motion {
namespace {

using Feet = std::span<const std::array<SourceFoot, 2>>;

// Speed by frame of the point that `place` gives: each axis is low-pass filtered, then
// differentiated (central, one-sided at the ends).
template <typename Place>
std::vector<double> speed_of(std::size_t count,
                             double frames_per_second,
                             double low_pass_hz,
                             const Place& place) {
    const std::vector<double> taps = low_pass_taps(low_pass_hz, frames_per_second);
    std::array<std::vector<double>, 3> axes;
    for (int c = 0; c < 3; ++c) {
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = place(i)[c];
        }
        axes[static_cast<std::size_t>(c)] = filtered(values, taps);
    }
    std::vector<double> speed(count, 0.0);
    for (std::size_t i = 0; i < count && count > 1; ++i) {
        // One-sided differences at both ends.
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, count - 1);
        double square = 0.0;
        for (const std::vector<double>& axis : axes) {
            square += (axis[after] - axis[before]) * (axis[after] - axis[before]);
        }
        speed[i] = std::sqrt(square) * frames_per_second / static_cast<double>(after - before);
    }
    return speed;
}

/// Sets runs of true that are shorter than `shortest` to false.
void drop_short_runs(std::vector<bool>& flags, std::size_t shortest) {
    std::size_t start = 0;
    for (std::size_t i = 0; i <= flags.size(); ++i) {
        if (i < flags.size() && flags[i]) {
            continue;
        }
        if (i - start < shortest) {
            for (std::size_t j = start; j < i; ++j) {
                flags[j] = false;
            }
        }
        start = i + 1;
    }
}

}  // namespace

std::vector<double> toe_speed(Feet feet, Side side, double frames_per_second, double low_pass_hz) {
    const std::size_t s = static_cast<std::size_t>(side);
    return speed_of(feet.size(), frames_per_second, low_pass_hz, [&](std::size_t i) {
        return feet[i][s].toe_tip;
    });
}

std::vector<double> foot_speed(Feet feet, Side side, double frames_per_second, double low_pass_hz) {
    const std::size_t s = static_cast<std::size_t>(side);
    std::vector<double> speed = toe_speed(feet, side, frames_per_second, low_pass_hz);
    const std::vector<double> ankle =
        speed_of(feet.size(), frames_per_second, low_pass_hz, [&](std::size_t i) {
            return feet[i][s].ankle;
        });
    for (std::size_t i = 0; i < speed.size(); ++i) {
        speed[i] = 0.5 * (speed[i] + ankle[i]);
    }
    return speed;
}

std::vector<bool> toe_contacts(Feet feet,
                               Side side,
                               double frames_per_second,
                               const FootRules& rules) {
    const std::vector<double> speed =
        toe_speed(feet, side, frames_per_second, rules.contact_low_pass_hz);
    std::vector<bool> contacts(feet.size());
    for (std::size_t i = 0; i < feet.size(); ++i) {
        contacts[i] = speed[i] < rules.contact_speed &&
                      feet[i][static_cast<std::size_t>(side)].toe_tip.y < rules.contact_height;
    }
    drop_short_runs(contacts, rules.contact_frames);
    return contacts;
}

std::vector<double> landings(Feet feet,
                             Side side,
                             double frames_per_second,
                             const FootRules& rules) {
    const std::vector<double> speed =
        foot_speed(feet, side, frames_per_second, rules.landing_low_pass_hz);
    std::vector<double> moments;
    bool is_stepping = false;
    for (std::size_t i = 1; i < speed.size(); ++i) {
        // Hysteresis: a foot that trembles about the landing speed lands only once.
        is_stepping = is_stepping || speed[i] > rules.step_speed;
        if (is_stepping && speed[i] < rules.landing_speed) {
            // Where the line between both frames crosses the limit.
            const double past = (speed[i - 1] - rules.landing_speed) / (speed[i - 1] - speed[i]);
            moments.push_back(static_cast<double>(i - 1) + past);
            is_stepping = false;
        }
    }
    return moments;
}

}  // namespace raks::motion
