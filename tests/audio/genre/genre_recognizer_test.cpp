#include "audio/genre/genre_recognizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "tests/audio/genre/small_genre_model.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// With the dances that come with Raks.
GenreSettings with_dances(GenreSettings settings) {
    settings.dances = raks::test::shipped_dances();
    return settings;
}

/// Feeds hops of sound that the small model takes for one genre.
class Stage {
 public:
    explicit Stage(GenreSettings settings = {}, GenreModel model = test::small_genre_model())
        : recognizer_(*GenreRecognizer::create(std::make_shared<const GenreModel>(std::move(model)),
                                               with_dances(std::move(settings)))) {
        states_.reserve(20'000);
    }

    /// C1 as the small model's genres have it: salsa -4, house 4, none of them far off.
    void play(double seconds, float c1, float level = -20.0F, float confidence = 0.8F) {
        std::array<float, BarPatterns::kMelBands> mel{};
        for (int i = 0; i < static_cast<int>(seconds * kHopsPerSecond); ++i) {
            MfccVector vector{};
            vector[0] = c1;
            mel.fill(hop_ % 50 < 5 ? 1.0F : 0.1F);
            MusicState state;
            state.hop = hop_;
            state.time = time_of_hop(hop_++);
            state.level_dbfs = level;
            state.grid.confidence = confidence;
            state.grid.bar_confidence = 1.0F;
            recognizer_.advance(vector, mel, nullptr, state);
            states_.push_back(state);
        }
    }
    [[nodiscard]] DanceId now() const { return states_.back().genre; }
    /// Of a class of the small model.
    [[nodiscard]] double chance(std::size_t genre) const {
        return std::exp(static_cast<double>(states_.back().genre_log_probability[genre]));
    }
    /// Seconds from `from` until the genre was first shown.
    [[nodiscard]] double shown_after(DanceId genre, double from) const {
        for (const MusicState& state : states_) {
            if (to_seconds(state.time) >= from && state.genre == genre) {
                return to_seconds(state.time) - from;
            }
        }
        return 1e9;
    }
    [[nodiscard]] const std::vector<MusicState>& states() const { return states_; }
    GenreRecognizer& recognizer() { return recognizer_; }

 private:
    GenreRecognizer recognizer_;
    std::vector<MusicState> states_;
    HopIndex hop_ = 0;
};

constexpr float kSalsa = -4.0F;
constexpr float kHouse = 4.0F;
constexpr float kNeither = 60.0F;

TEST(GenreRecognizer, a_new_genre_is_shown_within_6_seconds) {
    Stage stage;
    stage.play(12.0, kSalsa);
    EXPECT_EQ(stage.now(), shipped::salsa);
    stage.play(12.0, kHouse);
    EXPECT_EQ(stage.now(), shipped::house);
    EXPECT_LT(stage.shown_after(shipped::house, 12.0), 6.0);
}

TEST(GenreRecognizer, chances_sum_to_one_in_every_hop) {
    Stage stage;
    stage.play(3.0, kSalsa);
    stage.play(3.0, kNeither);
    for (const MusicState& state : stage.states()) {
        double sum = 0.0;
        for (const float log : state.genre_log_probability) {
            sum += std::exp(static_cast<double>(log));
        }
        ASSERT_NEAR(sum, 1.0, 1e-4);
    }
}

// Whoever asks for what is heard decides as the recognizer does.
TEST(GenreRecognizer, a_decision_apart_by_what_is_heard_is_the_one_that_is_shown) {
    Stage stage;
    DanceDecision apart = stage.recognizer().decision({});
    std::int64_t judged = 0;
    for (int i = 0; i < 2'000; ++i) {
        stage.play(0.01, i < 800 ? kSalsa : i < 1'400 ? kHouse : kNeither);
        const MusicState& state = stage.states().back();
        if (stage.recognizer().moment().number != judged) {
            judged = stage.recognizer().moment().number;
            apart.advance(stage.recognizer().heard(SongJudgement::Asked::own_parts, state.grid),
                          stage.recognizer().moment().heard_hops,
                          state.grid);
        }
        ASSERT_EQ(apart.shown(), state.genre_class) << i;
    }
    EXPECT_GT(judged, 150);
}

TEST(GenreRecognizer, a_word_of_another_genre_does_not_switch) {
    Stage stage;
    stage.play(12.0, kSalsa);
    for (int i = 0; i < 10; ++i) {
        stage.play(1.0, kHouse);
        stage.play(9.0, kSalsa);
    }
    EXPECT_GT(stage.shown_after(shipped::house, 5.0), 1e8);
}

TEST(GenreRecognizer, silence_and_applause_keep_the_genre) {
    Stage stage;
    stage.play(12.0, kSalsa);
    stage.play(60.0, kNeither, -90.0F);
    EXPECT_EQ(stage.now(), shipped::salsa);
    stage.play(60.0, kNeither, -20.0F, 0.05F);
    EXPECT_EQ(stage.now(), shipped::salsa);
}

TEST(GenreRecognizer, music_to_none_of_the_dances_is_unknown) {
    Stage stage;
    stage.play(12.0, kSalsa);
    stage.play(15.0, kNeither);
    EXPECT_EQ(stage.now(), DanceId::none);
    EXPECT_GT(stage.chance(2), 0.9);
}

TEST(GenreRecognizer, starts_unknown_and_forgets_on_reset) {
    Stage stage;
    stage.play(0.3, kSalsa);
    EXPECT_EQ(stage.now(), DanceId::none);
    stage.play(10.0, kSalsa);
    EXPECT_EQ(stage.now(), shipped::salsa);
    stage.recognizer().reset();
    stage.play(0.1, kSalsa);
    EXPECT_EQ(stage.now(), DanceId::none);
}

TEST(GenreRecognizer, longer_windows_switch_later) {
    Stage quick({.window_seconds = 1.0});
    Stage slow({.window_seconds = 10.0});
    for (Stage* stage : {&quick, &slow}) {
        stage->play(12.0, kSalsa);
        stage->play(14.0, kHouse);
    }
    EXPECT_LT(quick.shown_after(shipped::house, 12.0) + 1.0,
              slow.shown_after(shipped::house, 12.0));
}

TEST(GenreRecognizer, frames_that_all_genres_share_do_not_count) {
    GenreModel model = test::small_genre_model();
    model.similarity = model.background;
    model.similarity->means.col(0).setConstant(double{kNeither});
    model.similarity->covariances.assign(2, Eigen::MatrixXd::Constant(kMfccFeatures, 1, 4.0));
    Stage stage({.evidence = GenreEvidence::mfcc_similarity}, model);
    stage.play(10.0, kSalsa);
    const double sure = stage.chance(0);
    stage.play(10.0, kNeither);
    // All frames of the window are left out: nothing is said, the decision stays.
    EXPECT_GT(sure, 0.9);
    EXPECT_NEAR(stage.chance(0), 1.0 / 3.0, 0.01);
    EXPECT_EQ(stage.now(), shipped::salsa);
}

TEST(GenreRecognizer, every_length_is_judged_once_it_is_full) {
    Stage stage;
    stage.play(6.0, kSalsa);
    for (std::size_t window = 0; window < kGenreWindows.size(); ++window) {
        const auto judgement = stage.recognizer().judge(window);
        EXPECT_EQ(judgement.is_full, kGenreWindows[window] <= 10) << window;
    }
}

TEST(GenreRecognizer, nothing_allocates) {
    Stage stage;
    raks::test::RealtimeScope scope;
    stage.play(15.0, kSalsa);
    stage.play(5.0, kNeither, -90.0F);
    stage.recognizer().reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

TEST(GenreRecognizer, bad_settings_and_models_are_refused) {
    const auto model = std::make_shared<const GenreModel>(test::small_genre_model());
    const auto create = [&](const GenreSettings& settings) {
        const auto made = GenreRecognizer::create(model, settings);
        return made ? std::string("made") : made.error().message;
    };
    EXPECT_EQ(create({.window_seconds = 0.4}), "genre window is 0.400000 s, must be 0.5 to 10");
    EXPECT_EQ(create({.evidence = GenreEvidence::mfcc_similarity}),
              "the genre model has no inter-genre similarity; train it with --similarity");
    GenreModel bad = *model;
    bad.rhythm.deviation[3] = 0.0F;
    EXPECT_EQ(validate(bad).error().message, "rhythm.deviation[3] is 0, must be > 0");
}

/// Told of a class of the small model: salsa, house, none of them.
GenreSettings told(std::size_t told_class, float strength = 2.5F) {
    GenreSettings settings;
    settings.prior[told_class] = strength;
    return settings;
}

TEST(GenreRecognizer, what_is_told_decides_until_something_is_heard) {
    Stage stage(told(1));
    stage.play(0.02, kHouse);
    EXPECT_EQ(stage.now(), shipped::house);
    EXPECT_TRUE(stage.states().back().is_genre_told);
    EXPECT_NEAR(stage.chance(1), std::exp(2.5) / (std::exp(2.5) + 2.0), 1e-5);
    stage.play(6.0, kHouse);
    EXPECT_EQ(stage.now(), shipped::house);
    EXPECT_FALSE(stage.states().back().is_genre_told) << "heard, too";
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        sum += stage.chance(c);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    stage.recognizer().reset();
    stage.play(0.02, kHouse);
    EXPECT_TRUE(stage.states().back().is_genre_told);
}

TEST(GenreRecognizer, what_is_heard_outvotes_what_is_told) {
    Stage stage(told(1));
    stage.play(20.0, kSalsa);
    EXPECT_EQ(stage.now(), shipped::salsa);
    EXPECT_FALSE(stage.states().back().is_genre_told);
    Stage none(told(2));
    none.play(0.02, kSalsa);
    EXPECT_EQ(none.now(), DanceId::none);
    none.play(20.0, kSalsa);
    EXPECT_EQ(none.now(), shipped::salsa);
}

TEST(GenreRecognizer, nothing_told_changes_no_bit) {
    Stage plain;
    Stage untold(told(0, 0.0F));
    plain.play(5.0, kHouse);
    untold.play(5.0, kHouse);
    EXPECT_EQ(plain.states(), untold.states());
}

// A waltz that is told, to bars of four that are sure: what is told is not believed any more.
TEST(GenreRecognizer, bars_of_another_metre_forbid_what_is_told) {
    GenreModel model = test::small_genre_model();
    model.genres[1] = "waltz";
    Stage stage(told(1, 60.0F), model);
    stage.play(9.0, kSalsa);
    EXPECT_EQ(stage.now(), shipped::waltz);
    EXPECT_TRUE(stage.states().back().is_genre_told);
    stage.play(5.0, kSalsa, -20.0F, 0.5F);
    EXPECT_EQ(stage.now(), shipped::waltz) << "the beat is not sure";
    stage.play(2.0, kSalsa);
    EXPECT_EQ(stage.now(), shipped::salsa);
}

TEST(GenreRecognizer, what_is_certain_is_neither_outvoted_nor_forbidden) {
    GenreModel model = test::small_genre_model();
    model.genres[1] = "waltz";
    Stage stage(told(1, kCertainPrior), model);
    stage.play(20.0, kSalsa);
    for (const MusicState& state : stage.states()) {
        ASSERT_EQ(state.genre, shipped::waltz) << to_seconds(state.time);
        ASSERT_TRUE(state.is_genre_told);
    }
    EXPECT_NEAR(stage.chance(1), 1.0, 1e-5);
    Stage heard(told(1, kCertainPrior));
    heard.play(6.0, kHouse);
    EXPECT_TRUE(heard.states().back().is_genre_told) << "heard, too";
}

}  // namespace
}  // namespace raks::audio
