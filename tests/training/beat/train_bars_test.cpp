// The trainer of the bars' network: what it is shown, and that it learns it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "training/beat/train_bars.hpp"
#include "training/networks/network_gradient.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kBands = BarInput::kBands;

std::vector<PlayedBeat> beats_of(std::initializer_list<int> positions) {
    std::vector<PlayedBeat> beats;
    for (const int position : positions) {
        beats.push_back({0.5 * static_cast<double>(beats.size()), position});
    }
    return beats;
}

std::string letters(const std::vector<BarTarget>& places) {
    std::string text;
    for (const BarTarget place : places) {
        text += "fmo?"[static_cast<std::size_t>(place)];
    }
    return text;
}

TEST(BarPlaces, fours_and_sixes_have_a_middle_twos_and_threes_none) {
    EXPECT_EQ(letters(places_of(beats_of({1, 2, 3, 4, 1, 2, 3}))), "fomofom");
    EXPECT_EQ(letters(places_of(beats_of({2, 3, 1, 2, 3, 1}))), "oofoof");
    EXPECT_EQ(letters(places_of(beats_of({1, 2, 1, 2, 1}))), "fofof");
    EXPECT_EQ(letters(places_of(beats_of({1, 2, 3, 4, 5, 6, 1}))), "foomoof");
    EXPECT_EQ(letters(places_of(beats_of({3, 4, 1, 2, 3, 1, 2, 3, 1}))), "mofoofoof");
    EXPECT_EQ(letters(places_of(beats_of({0, 0}))), "??");
}

/// Beats of half a second in bars of four; the low bands are louder in the first of each bar.
TrainingExcerpt accented(int first_position) {
    TrainingExcerpt excerpt;
    excerpt.family = "test";
    for (int n = 0; n < 32; ++n) {
        const int position = (first_position - 1 + n) % 4 + 1;
        excerpt.beats.push_back({0.2 + 0.5 * n, position});
    }
    for (std::size_t hop = 0; hop < 1600; ++hop) {
        const int beat = (static_cast<int>(hop) - 20 + 200) / 50 - 4;
        const bool is_loud = (first_position - 1 + beat + 8) % 4 == 0;
        for (std::size_t band = 0; band < kBands; ++band) {
            excerpt.mel.push_back(is_loud && band < 9 ? 20.0F : 5.0F);
        }
    }
    return excerpt;
}

std::shared_ptr<const BeatNetwork> any_network() {
    auto network = std::make_shared<BeatNetwork>(4, 1, 0);
    initialize(*network, 5);
    return network;
}

TEST(BarSequences, each_whole_beat_is_a_frame_with_its_place) {
    const BarSequence heard =
        make_bar_sequence(accented(3), any_network(), MelAugmentation::plain(), nullptr);
    ASSERT_EQ(heard.frames.size(), 31U);  // the last has no end
    for (std::size_t i = 1; i < heard.frames.size(); ++i) {
        EXPECT_EQ(heard.places[i] == BarTarget::first, i % 4 == 2) << i;
        EXPECT_EQ(heard.frames[i][0] > 0.3F, i % 4 == 2) << i;
    }
}

TEST(BarSequences, a_later_start_and_another_speed_move_the_beats_with_the_music) {
    MelAugmentation augmentation = MelAugmentation::plain();
    augmentation.first_hop = 110.0;
    augmentation.stretch = 1.25;
    const BarSequence heard = make_bar_sequence(accented(1), any_network(), augmentation, nullptr);
    ASSERT_EQ(heard.frames.size(), 29U);  // from the third on, but for the last
    EXPECT_EQ(heard.places[2], BarTarget::first);
    EXPECT_GT(heard.frames[2][0], 0.3F);
    EXPECT_NEAR(heard.frames[2].back(), std::log2(40.0F / 50.0F), 0.05F);
}

TEST(TrainBars, learns_an_accent_and_gives_the_same_weights_for_any_number_of_threads) {
    std::vector<TrainingExcerpt> corpus;
    for (int n = 0; n < 9; ++n) {
        corpus.push_back(accented(n % 4 + 1));
    }
    corpus.resize(10);  // one that is left out
    BarPlan plan;
    plan.units = 8;
    plan.steps = 60;
    plan.rate = 2e-2;
    std::vector<NetworkProgress> reports;
    const auto note = [&](const NetworkProgress& progress, const BarNetwork&) {
        reports.push_back(progress);
    };
    const BarNetwork network = train_bars(corpus, any_network(), plan, note);
    ASSERT_FALSE(reports.empty());
    EXPECT_LT(reports.back().validation_loss, 0.5);
    plan.threads = 1;
    const BarNetwork again = train_bars(corpus, any_network(), plan, note);
    EXPECT_TRUE(std::ranges::equal(network.parameters(), again.parameters()));
}

}  // namespace
}  // namespace raks::audio
