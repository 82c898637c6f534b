// Light that moves with the music, and hurts nobody.
#include "render/scene/light_show.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "tests/render/scene/staged_music.hpp"

namespace raks::render {
namespace {

using Band = MusicAccent::Band;
using EventKind = MusicEvent::Kind;

/// Factors of one light at each hop, for at most `hops`.
template <typename Each>
std::vector<LightLevels> lit(int hops, Each each, Liveliness liveliness = Liveliness::usual) {
    LightShow show(liveliness);
    StagedMusic music;
    std::vector<LightLevels> levels;
    for (int i = 0; i < hops; ++i) {
        each(music);
        levels.push_back(show.advance(music.state()));
    }
    return levels;
}

/// What no music would dare: an accent in every hop, drops, parts that change all the time.
void rage(StagedMusic& music) {
    const CounterRandom random(7);
    const auto i = static_cast<std::uint64_t>(music.hop());
    music.next.accent = {.time = time_of_hop(music.hop()),
                         .strength = 1.0F,
                         .band = static_cast<Band>(random.below(3 * i, 3))};
    if (random.below(3 * i + 1, 20) == 0) {
        music.next.part = static_cast<MusicPart>(random.below(3 * i + 2, 4));
        music.next.event.kind = EventKind::drop;
    }
    music.next.energy.now = music.next.energy.lately =
        static_cast<float>(random.uniform(1'000'000 + i));
}

/// Most flashes in any second: pairs of opposite changes by at least `least` of the level.
int most_flashes(const std::vector<float>& levels, float least) {
    std::vector<std::size_t> turns;
    float extreme = levels.front();
    int direction = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const float change = levels[i] - extreme;
        if (direction != 0 && change * static_cast<float>(direction) > 0.0F) {
            extreme = levels[i];  // further the same way
        } else if (std::abs(change) >= least) {
            direction = change > 0.0F ? 1 : -1;
            extreme = levels[i];
            turns.push_back(i);
        }
    }
    int most = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const auto end = std::find_if(turns.begin() + static_cast<std::ptrdiff_t>(i),
                                      turns.end(),
                                      [&](std::size_t turn) { return turn >= turns[i] + 100; });
        most = std::max(
            most, static_cast<int>(end - (turns.begin() + static_cast<std::ptrdiff_t>(i))) / 2);
    }
    return most;
}

std::vector<float> of(const std::vector<LightLevels>& levels, float LightLevels::*light) {
    std::vector<float> values;
    for (const LightLevels& now : levels) {
        values.push_back(now.*light);
    }
    return values;
}

constexpr float LightLevels::*kLights[] = {
    &LightLevels::key, &LightLevels::rim, &LightLevels::floor, &LightLevels::backdrop};

TEST(LightShow, counts_flashes_as_the_guideline_does) {
    std::vector<float> square;
    for (int i = 0; i < 300; ++i) {
        square.push_back(i / 10 % 2 == 0 ? 0.2F : 0.8F);  // five times a second
    }
    EXPECT_EQ(most_flashes(square, 0.1F), 5);
    EXPECT_EQ(most_flashes(std::vector<float>(300, 0.4F), 0.1F), 0);
}

TEST(LightShow, no_music_makes_more_than_three_flashes_a_second_of_any_light) {
    const auto levels = lit(6000, rage);
    for (float LightLevels::*const light : kLights) {
        EXPECT_LE(most_flashes(of(levels, light), 0.05F), 3);
        for (const LightLevels& now : levels) {
            EXPECT_GE(now.*light, LightShow::kDarkest);
            EXPECT_LE(now.*light, LightShow::kBrightest);
        }
    }
    EXPECT_GE(most_flashes(of(levels, &LightLevels::rim), 0.05F), 1) << "it does move";
}

TEST(LightShow, calm_light_never_flashes) {
    const auto levels = lit(6000, rage, Liveliness::calm);
    for (float LightLevels::*const light : kLights) {
        EXPECT_EQ(most_flashes(of(levels, light), 0.05F), 0);
    }
}

TEST(LightShow, is_the_brighter_the_fuller_the_music_and_darkest_in_silence) {
    const auto at_end = [](float energy, MusicPart part) {
        return lit(800,
                   [&](StagedMusic& music) {
                       music.next.energy = {energy, energy, energy};
                       music.next.part = part;
                   })
            .back();
    };
    const LightLevels calm = at_end(0.1F, MusicPart::playing);
    const LightLevels usual = at_end(0.5F, MusicPart::playing);
    const LightLevels full = at_end(0.9F, MusicPart::playing);
    const LightLevels silent = at_end(0.0F, MusicPart::stopped);
    const LightLevels breakdown = at_end(0.3F, MusicPart::breakdown);
    for (float LightLevels::*const light : kLights) {
        EXPECT_LT(calm.*light, usual.*light);
        EXPECT_LT(usual.*light, full.*light);
        EXPECT_LT(silent.*light, usual.*light);
        EXPECT_NEAR(usual.*light, 1.0F, 0.03F) << "as the theme has it";
    }
    EXPECT_LT(breakdown.backdrop, usual.backdrop);
    EXPECT_GT(breakdown.rim, usual.rim) << "an outline before the dark";
}

/// Levels at the end of a breakdown of 6 s, of a build-up of 6 s, and 1 s after the drop.
struct Turn {
    LightLevels breakdown;
    LightLevels risen;
    LightLevels opened;
    LightLevels later;  ///< 30 s after it
};
Turn turned(Liveliness liveliness) {
    const auto levels = lit(
        4800,
        [](StagedMusic& music) {
            const HopIndex hop = music.hop();
            music.next.part = hop < 600    ? MusicPart::breakdown
                              : hop < 1200 ? MusicPart::build_up
                                           : MusicPart::playing;
            if (hop == 1200) {
                music.next.event.kind = EventKind::drop;
            }
        },
        liveliness);
    return {levels[590], levels[1190], levels[1300], levels[4200]};
}

TEST(LightShow, a_breakdown_dims_and_narrows_a_build_up_rises_and_a_drop_opens) {
    const Turn turn = turned(Liveliness::usual);
    EXPECT_LT(turn.breakdown.width, 0.7F);
    EXPECT_GT(turn.risen.width, turn.breakdown.width);
    EXPECT_GT(turn.opened.width, 1.3F);
    EXPECT_GT(turn.breakdown.breakdown, 0.95F);
    EXPECT_LT(turn.risen.breakdown, 0.5F);
    EXPECT_LT(turn.opened.breakdown, 0.2F);
    EXPECT_GT(turn.opened.drop, 0.8F);
    for (float LightLevels::*const light : {&LightLevels::floor, &LightLevels::backdrop}) {
        EXPECT_GT(turn.risen.*light, 1.5F * turn.breakdown.*light);
        EXPECT_GT(turn.opened.*light, 2.0F * turn.breakdown.*light);
        EXPECT_LT(turn.later.*light, turn.opened.*light - 0.1F) << "and it calms down";
    }
    EXPECT_LT(turn.later.drop, 0.2F);
}

TEST(LightShow, is_calm_about_a_drop_where_it_is_asked_to_be) {
    const Turn turn = turned(Liveliness::calm);
    EXPECT_LT(turn.opened.drop, 0.4F);
    EXPECT_GT(turn.breakdown.width, 0.8F);
}

TEST(LightShow, answers_an_accent_within_a_tenth_of_a_second_where_its_band_says) {
    const auto after = [](Band band) {
        const auto levels = lit(120, [&](StagedMusic& music) {
            if (music.hop() == 100) {
                music.next.accent = {.strength = 1.0F, .band = band};
            }
        });
        return LightLevels{levels[108].key - levels[99].key,
                           levels[108].rim - levels[99].rim,
                           levels[108].floor - levels[99].floor,
                           levels[108].backdrop - levels[99].backdrop};
    };
    EXPECT_GT(after(Band::low).floor, 0.1F);
    EXPECT_GT(after(Band::low).backdrop, 0.1F);
    EXPECT_NEAR(after(Band::low).rim, 0.0F, 1e-3F);
    EXPECT_GT(after(Band::middle).rim, 0.15F);
    EXPECT_GT(after(Band::high).key, 0.03F);
}

TEST(LightShow, the_same_music_gives_the_same_light) {
    EXPECT_EQ(lit(2000, rage), lit(2000, rage));
}

}  // namespace
}  // namespace raks::render
