#include "audio/song/song_dances.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/audio/genre/small_genre_model.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

constexpr std::uint8_t kSalsaClass = 0;
constexpr std::uint8_t kHouseClass = 1;
constexpr std::uint8_t kNoneClass = 2;

GenreRecognizer small_recognizer() {
    return *GenreRecognizer::create(std::make_shared<const GenreModel>(test::small_genre_model()),
                                    {.dances = raks::test::shipped_dances()});
}

// A song by what its parts said of it.
class HeardSong {
 public:
    // Seconds of music of which the own parts say these probabilities, in windows of 3 s.
    HeardSong& hear(double seconds, const std::array<float, 3>& chances) {
        for (int i = 0; i < static_cast<int>(seconds * kHopsPerSecond); ++i) {
            add_hop().is_silent = false;
            chances_.push_back(chances);
            if (states_.size() % 10 == 0) {
                say();
            }
        }
        return *this;
    }
    HeardSong& be_silent(double seconds) {
        for (int i = 0; i < static_cast<int>(seconds * kHopsPerSecond); ++i) {
            add_hop();
            chances_.push_back(chances_.back());
        }
        return *this;
    }
    // A patch of the tagger that ends at the end of what was heard so far.
    HeardSong& tag(const std::array<float, 3>& chances) {
        SongJudgement::Patch patch{
            static_cast<std::int64_t>(patches_.size()) + 1, states_.back().time, {}};
        for (std::size_t c = 0; c < chances.size(); ++c) {
            patch.logs[c] = std::log(chances[c]);
        }
        patches_.push_back(patch);
        return *this;
    }
    [[nodiscard]] std::vector<SongSection> sections(const GenreLogProbabilities& prior = {}) const {
        return find_sections(
            {.states = states_, .beats = beats, .moments = moments_, .patches = patches_},
            small_recognizer(),
            prior);
    }
    std::vector<SongBeat> beats;

 private:
    MusicState& add_hop() {
        MusicState& state = states_.emplace_back();
        state.hop = static_cast<HopIndex>(states_.size()) - 1;
        state.time = time_of_hop(state.hop);
        state.is_silent = true;
        return state;
    }
    // A window says the mean of what is in it.
    void say() {
        constexpr std::size_t kWindow = 300;
        const std::size_t count = std::min(kWindow, chances_.size());
        SongRecording::Moment moment;
        moment.hop = states_.size() - 1;
        moment.said.number = static_cast<std::int64_t>(moments_.size()) + 1;
        moment.said.seconds = static_cast<double>(count) / kHopsPerSecond;
        moment.said.sureness = static_cast<double>(count) / kWindow;
        for (std::size_t c = 0; c < 3; ++c) {
            float sum = 0.0F;
            for (std::size_t i = chances_.size() - count; i < chances_.size(); ++i) {
                sum += std::log(chances_[i][c]);
            }
            moment.said.logs[c] = sum / static_cast<float>(count);
        }
        moments_.push_back(moment);
    }

    std::vector<MusicState> states_;
    std::vector<std::array<float, 3>> chances_;  // by hop
    std::vector<SongRecording::Moment> moments_;
    std::vector<SongJudgement::Patch> patches_;
};

TEST(SongDances, one_class_holds_through_a_passage_that_looks_like_another) {
    const auto sections = HeardSong()
                              .hear(40.0, {0.7F, 0.2F, 0.1F})
                              .hear(8.0, {0.2F, 0.7F, 0.1F})
                              .hear(40.0, {0.7F, 0.2F, 0.1F})
                              .sections();
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_EQ(sections[0].first_hop, 0U);
    EXPECT_EQ(sections[0].genre_class, kSalsaClass);
}

TEST(SongDances, each_song_of_a_medley_is_another_section) {
    const auto sections = HeardSong()
                              .hear(30.0, {0.9F, 0.05F, 0.05F})
                              .hear(30.0, {0.05F, 0.9F, 0.05F})
                              .hear(30.0, {0.9F, 0.05F, 0.05F})
                              .sections();
    ASSERT_EQ(sections.size(), 3U);
    EXPECT_EQ(sections[1].genre_class, kHouseClass);
    EXPECT_EQ(sections[2].genre_class, kSalsaClass);
    EXPECT_NEAR(static_cast<double>(sections[1].first_hop), 3'000.0, 100.0);
    EXPECT_NEAR(static_cast<double>(sections[2].first_hop), 6'000.0, 100.0);
}

// What is heard across the border belongs to neither.
TEST(SongDances, each_is_judged_by_itself) {
    const auto sections =
        HeardSong().hear(60.0, {0.9F, 0.05F, 0.05F}).hear(20.0, {0.05F, 0.9F, 0.05F}).sections();
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_GT(std::exp(sections[0].log_chances[kSalsaClass]), 0.85F);
    EXPECT_GT(std::exp(sections[1].log_chances[kHouseClass]), 0.85F);
}

TEST(SongDances, a_section_begins_on_a_bar_line) {
    HeardSong song;
    song.hear(30.0, {0.9F, 0.05F, 0.05F}).hear(30.0, {0.05F, 0.9F, 0.05F});
    for (int beat = 0; beat < 120; ++beat) {
        song.beats.push_back({.time = stream_time_from_seconds(0.3 + 0.5 * beat),
                              .place = {4, beat % 4},
                              .confidence = 1.0F,
                              .rival = {}});
    }
    const auto sections = song.sections();
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ((sections[1].first_hop - 30) % 200, 0U) << sections[1].first_hop;
}

TEST(SongDances, a_section_begins_where_the_metre_changes) {
    HeardSong song;
    song.hear(30.0, {0.9F, 0.05F, 0.05F}).hear(30.0, {0.05F, 0.9F, 0.05F});
    for (int beat = 0; beat < 120; ++beat) {
        const int in_threes = beat - 60;
        song.beats.push_back(
            {.time = stream_time_from_seconds(0.5 * beat),
             .place = beat < 60 ? BarPlace{4, beat % 4} : BarPlace{3, in_threes % 3},
             .confidence = 1.0F,
             .rival = {}});
    }
    const auto sections = song.sections();
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[1].first_hop, 3'000U);
}

TEST(SongDances, a_song_begins_with_its_sound_after_a_silence) {
    const auto sections = HeardSong()
                              .hear(20.0, {0.5F, 0.3F, 0.2F})
                              .be_silent(2.0)
                              .hear(20.0, {0.3F, 0.5F, 0.2F})
                              .sections();
    ASSERT_EQ(sections.size(), 2U) << "after a silence less evidence is enough";
    EXPECT_EQ(sections[1].first_hop, 2'200U);
}

TEST(SongDances, the_same_without_a_silence_is_one_song) {
    const auto sections =
        HeardSong().hear(20.0, {0.5F, 0.3F, 0.2F}).hear(20.0, {0.3F, 0.5F, 0.2F}).sections();
    EXPECT_EQ(sections.size(), 1U);
}

TEST(SongDances, the_first_seconds_get_the_class_of_the_song) {
    const auto sections =
        HeardSong().hear(3.0, {0.2F, 0.2F, 0.6F}).hear(60.0, {0.8F, 0.1F, 0.1F}).sections();
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_EQ(sections[0].genre_class, kSalsaClass);
}

TEST(SongDances, the_tagger_is_asked_too) {
    HeardSong song;
    for (int i = 0; i < 7; ++i) {
        song.hear(3.0, {0.4F, 0.35F, 0.25F}).tag({0.1F, 0.8F, 0.1F});
    }
    const auto sections = song.sections();
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_EQ(sections[0].genre_class, kHouseClass);
}

TEST(SongDances, tags_decide_between_likely_dances_and_it_is_said) {
    HeardSong song;
    song.hear(20.0, {0.45F, 0.4F, 0.15F});
    EXPECT_EQ(song.sections()[0].genre_class, kSalsaClass);
    const auto told = song.sections({0.0F, 1.5F});
    EXPECT_EQ(told[0].genre_class, kHouseClass);
    EXPECT_TRUE(told[0].is_told);
    EXPECT_FALSE(song.sections({1.5F, 0.0F})[0].is_told) << "heard as well";
}

TEST(SongDances, what_is_likely_for_no_dance_is_none_of_them) {
    const auto sections = HeardSong().hear(20.0, {0.35F, 0.33F, 0.32F}).sections();
    EXPECT_EQ(sections[0].genre_class, kNoneClass);
}

TEST(SongDances, silence_and_shortness_are_no_evidence) {
    EXPECT_TRUE(HeardSong().sections().empty());
    const auto shortest = HeardSong().hear(0.05, {0.9F, 0.05F, 0.05F}).sections();
    ASSERT_EQ(shortest.size(), 1U);
    EXPECT_EQ(shortest[0].genre_class, kNoneClass);
}

}  // namespace
}  // namespace raks::audio
