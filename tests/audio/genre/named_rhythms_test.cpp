#include "audio/genre/named_rhythms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using Likeness = std::array<float, NamedRhythms::kRhythms>;
// Sixteenths of low and of high drums.
struct Played {
    std::string_view low;
    std::string_view high;
    double beats_a_step = 0.25;
    double begun_at = 0.0;  ///< beats after the tracker's
};

/// Likeness of 72 beats of it, at 40 hops a beat: whole cycles of all lengths.
Likeness likeness_of(const Played& played) {
    constexpr int kHops = 72 * 40;
    NamedRhythms rhythms;
    for (int hop = 0; hop < kHops; ++hop) {
        const double beats = hop / 40.0;
        const double step = (beats - played.begun_at) / played.beats_a_step;
        const auto hits = [&](std::string_view line) {
            const auto whole = static_cast<long>(std::floor(step + 1e-9));
            const auto length = static_cast<long>(line.size());
            const bool is_first = step - static_cast<double>(whole) < 0.05 / played.beats_a_step;
            return is_first &&
                   line[static_cast<std::size_t>((whole % length + length) % length)] == 'x';
        };
        const float high = hits(played.high) ? 1.0F : 0.0F;
        const std::array<float, 3> onsets = {hits(played.low) ? 1.0F : 0.0F, high, high};
        rhythms.add(onsets, beats);
    }
    return rhythms.likeness();
}

std::string_view nearest(const Likeness& likeness) {
    const auto best = std::max_element(likeness.begin(), likeness.end());
    return NamedRhythms::kNames[static_cast<std::size_t>(best - likeness.begin())];
}

constexpr std::array<std::pair<std::string_view, Played>, 4> kDrums = {{
    {"maqsum", {"x.......x.......", "..x...x.....x..."}},
    {"saidi", {"x.....x.x.......", "..x.........x..."}},
    {"malfuf", {"x.......x.......", "...x..x....x..x."}},
    {"four-on-the-floor", {"x...x...x...x...", "..x...x...x...x."}},
}};

TEST(NamedRhythms, drums_that_play_a_rhythm_are_most_like_it) {
    for (const auto& [name, played] : kDrums) {
        const Likeness likeness = likeness_of(played);
        EXPECT_EQ(nearest(likeness), name);
        EXPECT_GT(*std::max_element(likeness.begin(), likeness.end()), 0.9F) << name;
    }
}

TEST(NamedRhythms, karsilama_is_found_in_nine_eighths) {
    const Likeness likeness = likeness_of({"x...x....", "..x...xxx", 0.5});
    EXPECT_EQ(nearest(likeness), "karsilama");
}

TEST(NamedRhythms, a_wrong_first_beat_and_a_doubled_tempo_change_nothing) {
    for (const auto& [name, played] : kDrums) {
        Played later = played;
        later.begun_at = 3.0;
        Played doubled = played;
        doubled.beats_a_step = 0.5;
        const Likeness right = likeness_of(played);
        const Likeness turned = likeness_of(later);
        const Likeness twice = likeness_of(doubled);
        for (std::size_t i = 0; i < right.size(); ++i) {
            if (NamedRhythms::kNames[i] == name) {
                EXPECT_NEAR(right[i], turned[i], 0.01F) << name;
                EXPECT_NEAR(right[i], twice[i], 0.01F) << name;
            }
        }
    }
}

TEST(NamedRhythms, a_waltz_has_its_bass) {
    EXPECT_EQ(nearest(likeness_of({"x...........", "....x...x..."})), "oom-pah-pah");
}

TEST(NamedRhythms, nothing_is_like_nothing) {
    raks::test::RealtimeScope scope;
    NamedRhythms rhythms;
    for (int hop = 0; hop < 500; ++hop) {
        rhythms.add(std::array<float, 3>{}, -2.0 + 0.01 * hop);
    }
    const Likeness likeness = rhythms.likeness();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    for (const float value : likeness) {
        EXPECT_EQ(value, 0.0F);
    }
}

}  // namespace
}  // namespace raks::audio
