#include "audio/music/generator/song_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "audio/music/generator/music_generator.hpp"

namespace raks::audio {
namespace {

using Kind = MusicEvent::Kind;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kEveryStyle{Style::clicks,
                                 Style::drums,
                                 Style::montuno,
                                 Style::maqsum,
                                 Style::four_on_the_floor,
                                 Style::backbeat,
                                 Style::boom_bap,
                                 Style::oom_pah_pah};

std::vector<FormSection> form_from(std::string_view text) {
    auto form = parse_form(text);
    EXPECT_TRUE(form) << form.error().message;
    return std::move(form).value();
}

GeneratedMusic play(const MusicPlan& plan) {
    auto music = generate(plan);
    EXPECT_TRUE(music) << music.error().message;
    return std::move(music).value();
}

// Root mean square of [from, to) seconds of a piece with one channel.
double level(const GeneratedMusic& music, double from, double to) {
    double sum = 0.0;
    const auto first = static_cast<std::size_t>(from * music.rate.hertz());
    const auto last = static_cast<std::size_t>(to * music.rate.hertz());
    for (std::size_t i = first; i < last; ++i) {
        sum += std::pow(static_cast<double>(music.samples[i]), 2.0);
    }
    return std::sqrt(sum / static_cast<double>(last - first));
}

std::vector<Kind> kinds_of(const std::vector<MusicEvent>& events) {
    std::vector<Kind> kinds;
    for (const MusicEvent& event : events) {
        kinds.push_back(event.kind);
    }
    return kinds;
}

// At 120 BPM, two beats a second: full 0-8 s, breakdown 8-16, stop 16-18, drop 18-26, ending 26-30,
// nothing to 34.
MusicPlan plan_of_all(Style style) {
    const int bar = beats_per_bar(style);
    MusicPlan plan{.style = style, .tempo = {{0.0, 30.0 * bar}}, .seconds = 34.0, .channels = 1};
    for (const auto& [kind, bars] : {std::pair{SectionKind::full, 4},
                                     {SectionKind::breakdown, 4},
                                     {SectionKind::stop, 1},
                                     {SectionKind::drop, 4},
                                     {SectionKind::ending, 2}}) {
        plan.form.push_back({kind, bars * bar});
    }
    return plan;
}

TEST(SongForm, events_lie_on_the_first_beat_of_their_section) {
    for (const Style style : kEveryStyle) {
        const auto music = play(plan_of_all(style));
        const std::vector<std::pair<Kind, double>> expected{{Kind::entry, 0.0},
                                                            {Kind::breakdown, 8.0},
                                                            {Kind::stop, 16.0},
                                                            {Kind::drop, 18.0},
                                                            {Kind::end, 26.0}};
        ASSERT_EQ(music.events.size(), expected.size()) << name_of(style);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(music.events[i].kind, expected[i].first);
            EXPECT_NEAR(to_seconds(music.events[i].time), expected[i].second, 1e-9);
        }
        EXPECT_EQ(music.sections.size(), 5U);
    }
}

TEST(SongForm, a_stop_and_what_follows_the_end_are_digital_silence) {
    for (const Style style : kEveryStyle) {
        const auto music = play(plan_of_all(style));
        for (const auto& [from, to] : {std::pair{16.0, 18.0}, {30.0, 34.0}}) {
            const auto first = static_cast<std::size_t>(from * 48'000.0);
            const auto last = static_cast<std::size_t>(to * 48'000.0);
            EXPECT_TRUE(std::all_of(music.samples.begin() + static_cast<std::ptrdiff_t>(first),
                                    music.samples.begin() + static_cast<std::ptrdiff_t>(last),
                                    [](float sample) { return sample == 0.0F; }))
                << name_of(style) << " from " << from;
        }
        for (const ReferenceBeat& beat : music.beats) {
            const double t = to_seconds(beat.time) + 1e-6;
            const bool is_silent = (t > 16.0 && t < 18.0) || t > 26.1;
            EXPECT_EQ(beat.is_audible, !is_silent) << t;
        }
    }
}

TEST(SongForm, a_breakdown_is_quieter_and_a_drop_begins_louder_than_the_band_plays_on_average) {
    for (const Style style : kEveryStyle) {
        const auto music = play(plan_of_all(style));
        EXPECT_LT(level(music, 8.5, 15.5), 0.7 * level(music, 0.0, 8.0)) << name_of(style);
        EXPECT_GT(level(music, 8.5, 15.5), 0.001) << name_of(style);
        EXPECT_GT(level(music, 18.0, 18.2), level(music, 18.0, 26.0)) << name_of(style);
        // The last chord rings out: it is loudest at its start, and falls.
        EXPECT_GT(level(music, 26.0, 26.3), 2.0 * level(music, 28.5, 29.5)) << name_of(style);
    }
}

TEST(SongForm, a_build_up_rises_and_a_fade_falls_all_the_way) {
    for (const Style style : kEveryStyle) {
        const int bar = beats_per_bar(style);
        const auto music = play({.style = style,
                                 .tempo = {{0.0, 30.0 * bar}},
                                 .seconds = 24.0,
                                 .channels = 1,
                                 .form = {{SectionKind::build_up, 4 * bar},
                                          {SectionKind::drop, 4 * bar},
                                          {SectionKind::fade_out, 4 * bar}}});
        EXPECT_GT(level(music, 6.0, 8.0), 1.5 * level(music, 0.0, 2.0)) << name_of(style);
        EXPECT_LT(level(music, 22.0, 24.0), 0.3 * level(music, 16.0, 18.0)) << name_of(style);
        // Music that begins with a build-up has an entry there.
        EXPECT_THAT(kinds_of(music.events), ElementsAre(Kind::entry, Kind::drop, Kind::end));
        EXPECT_NEAR(to_seconds(music.events.back().time), 24.0, 1e-9);
    }
}

TEST(SongForm, a_filtered_section_has_no_treble) {
    const auto music = play({.style = Style::four_on_the_floor,
                             .tempo = {{0.0, 120.0}},
                             .seconds = 16.0,
                             .channels = 1,
                             .form = parse_form("full:16,filtered:16").value()});
    // Differences of neighbours weigh treble.
    const auto treble = [&](double from, double to) {
        double sum = 0.0;
        for (auto i = static_cast<std::size_t>(from * 48e3);
             i < static_cast<std::size_t>(to * 48e3);
             ++i) {
            sum += std::pow(static_cast<double>(music.samples[i + 1] - music.samples[i]), 2.0);
        }
        return std::sqrt(sum / (48e3 * (to - from)));
    };
    EXPECT_LT(treble(9.0, 15.0) / level(music, 9.0, 15.0),
              0.3 * treble(1.0, 7.0) / level(music, 1.0, 7.0));
}

TEST(SongForm, the_return_after_a_stop_is_an_entry_and_after_a_breakdown_a_drop) {
    const auto music =
        play({.style = Style::drums,
              .tempo = {{0.0, 120.0}},
              .seconds = 20.0,
              .form = form_from("full:8,hit-stop:4,full:8,filtered:4,stop:4,verse:8")});
    EXPECT_THAT(kinds_of(music.events),
                ElementsAre(Kind::entry,
                            Kind::stop,
                            Kind::entry,
                            Kind::breakdown,
                            Kind::stop,
                            Kind::drop,
                            Kind::end));
}

TEST(SongForm, without_a_form_silences_are_stops_and_phrases_have_eight_bars) {
    const auto music = play({.style = Style::drums,
                             .tempo = {{0.0, 120.0}},
                             .seconds = 40.0,
                             .first_beat_seconds = 1.0,
                             .silences = {{5.0, 7.0}}});
    EXPECT_THAT(kinds_of(music.events),
                ElementsAre(Kind::entry, Kind::stop, Kind::entry, Kind::end));
    ASSERT_EQ(music.phrases.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(to_seconds(music.phrases[i]), 1.0 + 16.0 * static_cast<double>(i), 1e-9);
    }
}

TEST(SongForm, drawn_songs_fill_their_bars_with_phrases_and_have_a_breakdown_a_drop_and_a_stop) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        for (const int bars : {24, 32, 50, 64, 100}) {
            const FormDraw draw{bars, seed % 2 == 0 ? 3 : 4, seed % 3 == 0 ? 1.3 : 2.1, seed};
            const auto form = draw_form(draw);
            int beats = 0;
            std::set<SectionKind> kinds;
            for (const FormSection& section : form) {
                // All but stops begin at a bar line.
                if (part_of(section.kind) != MusicPart::stopped) {
                    EXPECT_EQ(beats % draw.beats_per_bar, 0);
                }
                beats += section.beats;
                kinds.insert(section.kind);
            }
            EXPECT_LE(beats, bars * draw.beats_per_bar);
            EXPECT_GE(beats, (bars - 3) * draw.beats_per_bar);
            EXPECT_TRUE(kinds.count(SectionKind::breakdown) + kinds.count(SectionKind::filtered) >
                        0);
            EXPECT_TRUE(kinds.count(SectionKind::drop) > 0);
            EXPECT_TRUE(kinds.count(SectionKind::stop) + kinds.count(SectionKind::hit_stop) > 0)
                << seed << " " << bars;
        }
    }
}

TEST(SongForm, drawn_songs_of_two_seeds_differ_and_of_one_seed_are_equal) {
    std::set<std::string> forms;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        std::string text;
        for (const FormSection& section : draw_form({.bars = 64, .seed = seed})) {
            text += std::to_string(static_cast<int>(section.kind)) + ":" +
                    std::to_string(section.beats) + " ";
        }
        forms.insert(text);
    }
    EXPECT_GE(forms.size(), 15U);
    EXPECT_EQ(song_form_of({.seed = 5}).size(), song_form_of({.seed = 5}).size());
}

TEST(SongForm, wrong_forms_are_refused_in_words) {
    EXPECT_THAT(parse_form("full:8,brakedown:8").error().message, HasSubstr("breakdown"));
    for (const std::string text : {"full", "full:", "full:0", "full:x", "full:8x", "full:10001"}) {
        EXPECT_THAT(parse_form(text).error().message, HasSubstr("1 to 10000")) << text;
    }
    EXPECT_FALSE(parse_form(""));
    EXPECT_FALSE(parse_form("full:8,"));
    const auto both = generate({.silences = {{1.0, 2.0}}, .form = {{SectionKind::full, 8}}});
    EXPECT_THAT(both.error().message, HasSubstr("cannot both be given"));
}

}  // namespace
}  // namespace raks::audio
