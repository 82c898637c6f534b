#include "audio/genre/bar_patterns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/time.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

constexpr double kBpm = 120.0;

/// Hits of a low drum at these sixteenths of a bar and a high one at those, as mel magnitudes.
struct Drums {
    std::vector<int> low;
    std::vector<int> high;
    float gain = 1.0F;
    int turned_by = 0;  ///< beats that the tracker's bar is off
};

std::array<float, BarPatterns::kFeatures> features_of(const Drums& drums, double seconds = 10.0) {
    BarPatterns patterns;
    BeatGrid grid;
    grid.tempo = Bpm(kBpm);
    grid.bar_origin = Beats(drums.turned_by);
    grid.confidence = 0.8F;
    std::array<float, BarPatterns::kMelBands> mel{};
    for (HopIndex hop = 0; hop < static_cast<HopIndex>(seconds * kHopsPerSecond); ++hop) {
        const double sixteenth = to_seconds(time_of_hop(hop)) * kBpm / 60.0 * 4.0 + 0.01;
        const int step = static_cast<int>(sixteenth) % 16;
        const double since = (sixteenth - std::floor(sixteenth)) / 4.0 / kBpm * 60.0;
        const auto decay = static_cast<float>(std::exp(-since / 0.04));
        const auto hits = [step](const std::vector<int>& steps) {
            return std::find(steps.begin(), steps.end(), step) != steps.end();
        };
        for (std::size_t band = 0; band < mel.size(); ++band) {
            const bool sounds = band < 8 ? hits(drums.low) : band > 25 && hits(drums.high);
            mel[band] = drums.gain * (0.01F + (sounds ? decay : 0.0F));
        }
        patterns.add(mel, grid, time_of_hop(hop));
    }
    std::array<float, BarPatterns::kFeatures> features{};
    patterns.features(patterns.segments(), features);
    return features;
}

/// First feature of a part.
std::size_t place_of(std::string_view name) {
    std::size_t at = 0;
    for (const BarPatterns::Part& part : BarPatterns::kParts) {
        if (name == part.name) {
            return at;
        }
        at += static_cast<std::size_t>(part.size);
    }
    ADD_FAILURE() << name;
    return 0;
}

const Drums kMaqsum{.low = {0, 8}, .high = {2, 6, 12}};
const Drums kFour{.low = {0, 4, 8, 12}, .high = {2, 6, 10, 14}};

TEST(BarPatterns, gain_changes_nothing) {
    Drums quiet = kMaqsum;
    quiet.gain = 0.25F;
    const auto loud = features_of(kMaqsum);
    const auto soft = features_of(quiet);
    for (std::size_t i = 0; i < loud.size(); ++i) {
        EXPECT_NEAR(loud[i], soft[i], 1e-3F) << i;
    }
}

TEST(BarPatterns, a_bar_turned_by_beats_changes_only_the_bar_itself) {
    Drums turned = kMaqsum;
    turned.turned_by = 1;
    const auto right = features_of(kMaqsum);
    const auto wrong = features_of(turned);
    const std::size_t bar = place_of("bar");
    const std::size_t phases = place_of("phases");
    const std::size_t three = place_of("three");
    double bar_change = 0.0;
    for (std::size_t i = 0; i < right.size(); ++i) {
        if (i >= bar && i < phases) {
            bar_change += std::abs(static_cast<double>(right[i] - wrong[i]));
        } else if (i < three) {
            EXPECT_NEAR(right[i], wrong[i], 0.02F) << i;
        }
    }
    EXPECT_GT(bar_change, 0.5);
}

TEST(BarPatterns, the_bar_shows_where_the_drums_hit) {
    const auto features = features_of(kFour);
    const std::size_t bar = place_of("bar");
    for (std::size_t slot = 0; slot < 16; ++slot) {
        const float low = features[bar + slot];
        const float high = features[bar + 32 + slot];
        EXPECT_NEAR(low, slot % 4 == 0 ? 0.25F : 0.0F, 0.05F) << slot;
        EXPECT_NEAR(high, slot % 4 == 2 ? 0.25F : 0.0F, 0.05F) << slot;
    }
}

TEST(BarPatterns, rhythms_of_the_same_sounds_differ) {
    const auto maqsum = features_of(kMaqsum);
    const auto four = features_of(kFour);
    const std::size_t series = place_of("series");
    double difference = 0.0;
    for (std::size_t i = series; i < series + 8; ++i) {
        difference += std::abs(static_cast<double>(maqsum[i] - four[i]));
    }
    EXPECT_GT(difference, 1.0) << "a pulse on each beat has no wave of one or two a bar";
}

TEST(BarPatterns, a_window_forgets_what_lies_before_it) {
    BarPatterns changed;
    BarPatterns fresh;
    BeatGrid grid;
    std::array<float, BarPatterns::kMelBands> mel{};
    const auto play = [&](BarPatterns& patterns, int from, int to, bool is_loud) {
        for (int hop = from; hop < to; ++hop) {
            for (std::size_t band = 0; band < mel.size(); ++band) {
                const bool hits = hop % (is_loud ? 25 : 40) < 4 && (is_loud || band > 20);
                mel[band] = hits ? 1.0F : 0.02F;
            }
            patterns.add(mel, grid, time_of_hop(hop));
        }
    };
    play(changed, 0, 2000, true);
    play(changed, 2000, 4000, false);
    play(fresh, 0, 4000, false);
    std::array<float, BarPatterns::kFeatures> a{};
    std::array<float, BarPatterns::kFeatures> b{};
    changed.features(10, a);
    fresh.features(10, b);
    // The resonators of the pulse remember 2.5 s more.
    const std::size_t pulse = place_of("pulse");
    for (std::size_t i = 0; i < pulse; ++i) {
        EXPECT_NEAR(a[i], b[i], 1e-4F) << i;
    }
}

TEST(BarPatterns, all_features_are_finite_for_nothing_and_noise) {
    BarPatterns patterns;
    const BeatGrid grid;
    const std::array<float, BarPatterns::kMelBands> nothing{};
    raks::test::RealtimeScope scope;
    for (int hop = 0; hop < 200; ++hop) {
        patterns.add(nothing, grid, time_of_hop(hop));
    }
    std::array<float, BarPatterns::kFeatures> features{};
    patterns.features(1, features);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    for (const float value : features) {
        EXPECT_TRUE(std::isfinite(value));
    }
}

}  // namespace
}  // namespace raks::audio
