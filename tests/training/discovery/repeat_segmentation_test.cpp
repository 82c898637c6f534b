#include "training/discovery/repeat_segmentation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::motion::repeat_segmentation_test {
namespace {

/// Two curves over the phase, repeated; waiting before and after, and between the halves.
FeatureTrack track_of(std::initializer_list<double> lengths, std::size_t gap) {
    FeatureTrack track;
    track.columns = 2;
    const auto wait = [&] { track.values.insert(track.values.end(), 2 * gap, 0.0); };
    std::size_t at = 0;
    wait();
    for (const double length : lengths) {
        for (double i = 0.0; i < length; i += 1.0) {
            const double phase = 2.0 * M_PI * i / length;
            track.values.push_back(std::sin(phase) + 0.5 * std::cos(3.0 * phase));
            track.values.push_back(std::cos(phase) - 0.5 * std::sin(2.0 * phase));
        }
        if (++at == lengths.size() / 2) {
            wait();
        }
    }
    wait();
    return track;
}

TEST(RepeatSegmentation, finds_every_repeat_around_gaps_and_at_changing_tempo) {
    constexpr std::size_t kGap = 50;
    const std::initializer_list<double> lengths = {80, 80, 84, 88, 84, 80, 76, 80};
    const FeatureTrack track = track_of(lengths, kGap);
    const std::vector<RepeatSpan> known = {{50.0, 80.0}, {130.0, 80.0}};
    const auto found = segment_repeats(track, template_of(track, known), 80.0);
    ASSERT_EQ(found.size(), lengths.size());
    double start = kGap;
    std::size_t i = 0;
    for (const double length : lengths) {
        EXPECT_NEAR(found[i].start, start, 4.0) << i;
        EXPECT_NEAR(found[i].end(), start + length, 4.0) << i;
        start += length + (++i == lengths.size() / 2 ? kGap : 0.0);
    }
}

TEST(RepeatSegmentation, finds_none_where_nothing_is_like_the_template) {
    const FeatureTrack track = track_of({80, 80}, 40);
    FeatureTrack still = track;
    for (double& value : still.values) {
        value = 0.0;
    }
    const std::vector<RepeatSpan> known = {{40.0, 80.0}};
    EXPECT_TRUE(segment_repeats(still, template_of(track, known), 80.0).empty());
}

TEST(RepeatSegmentation, folding_gives_the_template_of_steady_repeats) {
    const FeatureTrack track = track_of({80, 80, 80, 80}, 0);
    const RepeatTemplate folded = folded_template(track, 80.0);
    ASSERT_EQ(folded.mean.size(), 2 * kRepeatPhases);
    for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
        const double at = 2.0 * M_PI * (static_cast<double>(phase) + 0.5) / kRepeatPhases;
        EXPECT_NEAR(folded.mean[2 * phase], std::sin(at) + 0.5 * std::cos(3.0 * at), 0.02);
    }
}

}  // namespace
}  // namespace raks::motion::repeat_segmentation_test
