// Which shots follow one another.
#include "render/scene/director.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <map>
#include <vector>

#include "tests/render/scene/staged_music.hpp"

namespace raks::render {
namespace {

using EventKind = MusicEvent::Kind;
using People = std::vector<motion::WorldPose>;

constexpr float kWide = 16.0F / 9.0F;
constexpr float kTall = 9.0F / 16.0F;
constexpr int kMinute = 6000;  // hops

struct Seen {
    HopIndex hop;
    DirectedView view;
};

People alone(HopIndex hop) {
    const float t = 0.01F * static_cast<float>(hop);
    return people_at({{0.4F * std::sin(0.7F * t), 0, 0.4F * std::sin(0.3F * t)}});
}
/// A couple that turns round once in 20 s.
People couple(HopIndex hop) {
    const float t = 0.01F * static_cast<float>(hop);
    const glm::vec3 half(0.35F * std::cos(0.3F * t), 0, 0.35F * std::sin(0.3F * t));
    const glm::vec3 middle(0.3F * std::sin(0.2F * t), 0, 0);
    return people_at({middle + half, middle - half});
}
People three(HopIndex hop) {
    const float x = 0.2F * std::sin(0.01F * static_cast<float>(hop));
    return people_at({{x, 0, 0}, {x - 1.3F, 0, 0}, {x + 1.3F, 0, 0}});
}

/// `each`: called before each hop, may change what the music does.
template <typename Each>
std::vector<Seen> directed(std::uint64_t seed,
                           float aspect,
                           People (*people)(HopIndex),
                           int hops,
                           Each each,
                           Liveliness liveliness = Liveliness::usual) {
    Director director(seed, liveliness);
    director.set_picture(aspect, 1.0F);
    StagedMusic music;
    std::vector<Seen> seen;
    for (int i = 0; i < hops; ++i) {
        each(music);
        const MusicState state = music.state();
        seen.push_back({state.hop, director.advance(state, people(state.hop))});
    }
    return seen;
}
std::vector<Seen> directed(std::uint64_t seed, float aspect, People (*people)(HopIndex)) {
    return directed(seed, aspect, people, 2 * kMinute, [](StagedMusic&) {});
}

/// Hops at which another shot begins, cut to or glided to.
std::vector<HopIndex> changes(const std::vector<Seen>& seen) {
    std::vector<HopIndex> hops;
    for (std::size_t i = 1; i < seen.size(); ++i) {
        const bool begins_glide = seen[i].view.is_gliding && !seen[i - 1].view.is_gliding;
        if (seen[i].view.cuts != seen[i - 1].view.cuts || begins_glide) {
            hops.push_back(seen[i].hop);
        }
    }
    return hops;
}

constexpr HopIndex kBar = 200;  // 4/4 at 120 BPM

TEST(Director, changes_shots_on_bar_lines_and_never_twice_a_bar) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto hops = changes(directed(seed, kWide, alone));
        EXPECT_GE(hops.size(), 10U) << "in two minutes";
        for (std::size_t i = 0; i < hops.size(); ++i) {
            EXPECT_EQ(hops[i] % kBar, 0) << seed;
            EXPECT_TRUE(i == 0 || hops[i] - hops[i - 1] >= kBar) << seed;
        }
    }
}

TEST(Director, finds_bar_lines_wherever_bars_are_counted_from) {
    const auto hops = changes(directed(1, kWide, alone, kMinute, [](StagedMusic& music) {
        // As of a song that is known: each bar is the first.
        const auto bar = static_cast<double>(music.hop() / kBar);
        music.next.grid.bar_origin = Beats(4.0 * bar);
    }));
    EXPECT_GE(hops.size(), 4U);
}

TEST(Director, shows_shots_the_longer_the_calmer_the_music) {
    const auto count = [](float energy, Liveliness liveliness) {
        std::size_t sum = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            sum += changes(directed(
                               seed,
                               kWide,
                               alone,
                               2 * kMinute,
                               [energy](StagedMusic& music) { music.next.energy.lately = energy; },
                               liveliness))
                       .size();
        }
        return sum;
    };
    const std::size_t calm = count(0.1F, Liveliness::usual);
    const std::size_t usual = count(0.5F, Liveliness::usual);
    const std::size_t full = count(0.9F, Liveliness::usual);
    EXPECT_LT(4 * calm, 3 * usual);
    EXPECT_LT(6 * usual, 5 * full);
    EXPECT_LT(2 * count(0.9F, Liveliness::calm), full + full / 2);
}

TEST(Director, a_single_dancer_is_filmed_from_one_side_of_the_line_to_the_audience) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto seen = directed(seed, kWide, alone);
        const bool side = seen.front().view.camera.yaw > 0.0F;
        for (const Seen& now : seen) {
            EXPECT_EQ(now.view.camera.yaw > 0.0F, side) << seed << " " << now.hop;
            EXPECT_LT(std::abs(now.view.camera.yaw), glm::radians(80.0F)) << "before the stage";
        }
    }
}

TEST(Director, no_cut_and_no_glide_crosses_a_couples_line) {
    int changed = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const auto seen = directed(seed, kWide, couple);
        for (std::size_t i = 1; i < seen.size(); ++i) {
            EXPECT_LT(std::abs(seen[i].view.camera.yaw), glm::radians(80.0F));
            if (seen[i].view.cuts == seen[i - 1].view.cuts) {
                continue;
            }
            // The couple as it is at the cut, before and after it.
            const auto before =
                Director::side_of_line(seen[i - 1].view.camera.yaw, couple(seen[i].hop));
            const auto after = Director::side_of_line(seen[i].view.camera.yaw, couple(seen[i].hop));
            if (before && after) {
                EXPECT_EQ(*before, *after) << seed << " " << seen[i].hop;
                ++changed;
            }
        }
    }
    EXPECT_GT(changed, 60);
}

TEST(Director, keeps_heads_in_every_picture_and_feet_where_the_shot_means_them) {
    for (People (*const people)(HopIndex) : {alone, couple, three}) {
        for (const float aspect : {kWide, 1.0F, kTall}) {
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                for (const Seen& now : directed(seed, aspect, people)) {
                    if (now.hop % 10 != 0) {
                        continue;
                    }
                    const glm::mat4 clip = now.view.camera.clip_from_world(aspect);
                    const auto seen_at = [&](glm::vec3 at) {
                        const glm::vec4 p = clip * glm::vec4(at, 1.0F);
                        return glm::vec2(p.x / p.w, p.y / p.w);
                    };
                    const Shot shot = now.view.shot;
                    const bool has_head = shot != Shot::feet && !now.view.is_gliding;
                    const bool has_feet = shot == Shot::wide || shot == Shot::full ||
                                          shot == Shot::side || shot == Shot::orbit;
                    for (const motion::WorldPose& dancer : people(now.hop)) {
                        const glm::vec2 top = seen_at(dancer.position(motion::Bone::head) +
                                                      glm::vec3(0.0F, 0.18F, 0.0F));
                        const glm::vec2 sole = seen_at(dancer.position(motion::Bone::left_foot) -
                                                       glm::vec3(0.0F, 0.08F, 0.0F));
                        // The face shown is one of two, or that of the first.
                        if (has_head && (shot != Shot::face || people(now.hop).size() == 1)) {
                            ASSERT_LT(std::abs(top.x), 1.0F) << name_of(shot) << " " << now.hop;
                            ASSERT_LT(top.y, 1.0F) << name_of(shot) << " " << now.hop;
                        }
                        if (has_feet && !now.view.is_gliding) {
                            ASSERT_LT(std::abs(sole.x), 1.0F) << name_of(shot) << " " << now.hop;
                            ASSERT_GT(sole.y, -1.0F) << name_of(shot) << " " << now.hop;
                        }
                    }
                }
            }
        }
    }
}

TEST(Director, no_shot_of_a_part_is_on_for_longer_than_it_may_whatever_the_tempo) {
    for (const double bpm : {62.0, 88.0, 120.0, 176.0}) {
        for (const Liveliness liveliness : {Liveliness::usual, Liveliness::calm}) {
            for (std::uint64_t seed = 1; seed <= 6; ++seed) {
                const auto seen = directed(
                    seed,
                    kWide,
                    alone,
                    3 * kMinute,
                    [bpm](StagedMusic& music) {
                        music.next.grid.tempo = Bpm(bpm);
                        music.next.energy.lately = 0.8F;
                    },
                    liveliness);
                int feet = 0;
                int face = 0;
                for (const Seen& now : seen) {
                    feet = now.view.shot == Shot::feet ? feet + 1 : 0;
                    face = now.view.shot == Shot::face ? face + 1 : 0;
                    ASSERT_LE(feet, 402) << bpm << " " << seed << " " << now.hop;
                    ASSERT_LE(face, 502) << bpm << " " << seed << " " << now.hop;
                }
            }
        }
    }
}

TEST(Director, shows_a_face_in_every_minute) {
    for (People (*const people)(HopIndex) : {alone, couple, three}) {
        for (const float aspect : {kWide, kTall}) {
            for (const float energy : {0.1F, 0.5F, 0.9F}) {
                for (const Liveliness liveliness : {Liveliness::usual, Liveliness::calm}) {
                    HopIndex last = 0;
                    for (const Seen& now : directed(
                             2,
                             aspect,
                             people,
                             4 * kMinute,
                             [energy](StagedMusic& music) { music.next.energy.lately = energy; },
                             liveliness)) {
                        last = now.view.shot == Shot::face ? now.hop : last;
                        ASSERT_LT(now.hop - last, kMinute) << now.hop << " " << energy;
                    }
                }
            }
        }
    }
}

TEST(Director, sees_who_dances_fore_and_aft_from_three_quarters) {
    const auto mean_yaw = [](People (*people)(HopIndex)) {
        double sum = 0.0;
        int count = 0;
        for (const Seen& now : directed(4, kWide, people)) {
            const bool is_whole = now.view.shot == Shot::full || now.view.shot == Shot::knees_up;
            if (now.hop > 1500 && is_whole && !now.view.is_gliding) {
                sum += std::abs(static_cast<double>(now.view.camera.yaw));
                ++count;
            }
        }
        return glm::degrees(sum / std::max(count, 1));
    };
    const auto sideways = [](HopIndex hop) {
        return people_at({{0.3F * std::sin(0.04F * static_cast<float>(hop)), 0, 0}});
    };
    const auto fore_and_aft = [](HopIndex hop) {
        return people_at({{0, 0, 0.3F * std::sin(0.04F * static_cast<float>(hop))}});
    };
    EXPECT_LT(mean_yaw(sideways), 28.0);
    EXPECT_GT(mean_yaw(fore_and_aft), 30.0);
    EXPECT_LT(mean_yaw(fore_and_aft), 50.0);
}

TEST(Director, cuts_nearer_or_lower_on_a_drop) {
    for (const float aspect : {kWide, kTall}) {
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            constexpr HopIndex kDrop = 2400;
            const auto seen = directed(seed, aspect, alone, 2500, [](StagedMusic& music) {
                if (music.hop() == kDrop) {
                    music.next.event = {EventKind::drop, time_of_hop(kDrop)};
                }
            });
            const DirectedView& before = seen[kDrop - 1].view;
            const DirectedView& after = seen[kDrop].view;
            const auto height_of = [](const Camera& camera) {
                return camera.distance * std::tan(0.5F * camera.vertical_fov);
            };
            EXPECT_NE(after.cuts, before.cuts);
            EXPECT_TRUE(height_of(after.camera) < 0.85F * height_of(before.camera) ||
                        after.camera.pitch < before.camera.pitch)
                << seed;
        }
    }
}

TEST(Director, moves_the_camera_smoothly_between_cuts) {
    for (People (*const people)(HopIndex) : {alone, couple}) {
        const auto seen = directed(3, kWide, people);
        for (std::size_t i = 2; i < seen.size(); ++i) {
            if (seen[i].view.cuts != seen[i - 2].view.cuts) {
                continue;
            }
            const Camera& one = seen[i - 2].view.camera;
            const Camera& two = seen[i - 1].view.camera;
            const Camera& three = seen[i].view.camera;
            EXPECT_LT(std::abs(two.yaw - one.yaw), glm::radians(0.4F)) << "40 degrees a second";
            const glm::vec3 jerk = three.position() - 2.0F * two.position() + one.position();
            EXPECT_LT(glm::length(jerk), 0.002F) << seen[i].hop << ": 20 m/s^2";
        }
    }
}

TEST(Director, cuts_on_a_drop_and_keeps_quiet_before_one_that_is_known) {
    constexpr HopIndex kDrop = 2450;  // between two bar lines
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto seen = directed(seed, kWide, alone, 4000, [](StagedMusic& music) {
            music.next.energy.lately = 0.9F;
            music.next.ahead.is_known = true;
            music.next.ahead.events[0] = {};
            if (music.hop() < kDrop) {
                music.next.ahead.events[0] = {EventKind::drop, time_of_hop(kDrop)};
            } else if (music.hop() == kDrop) {
                music.next.event = {EventKind::drop, time_of_hop(kDrop)};
            }
        });
        const auto hops = changes(seen);
        EXPECT_EQ(std::count(hops.begin(), hops.end(), kDrop), 1) << seed;
        EXPECT_TRUE(std::none_of(hops.begin(), hops.end(), [](HopIndex hop) {
            return hop > kDrop - kBar && hop < kDrop;
        })) << seed;
    }
}

TEST(Director, a_drop_that_was_heard_late_is_answered_on_the_next_beat) {
    const auto seen = directed(1, kWide, alone, 4000, [](StagedMusic& music) {
        if (music.hop() == 2430) {
            music.next.event = {EventKind::drop, time_of_hop(2400)};
        }
    });
    const auto hops = changes(seen);
    EXPECT_EQ(std::count(hops.begin(), hops.end(), 2450), 1) << "beats are 50 hops apart";
}

TEST(Director, keeps_the_shot_while_nothing_sounds_and_without_a_beat) {
    const auto silent = directed(1, kWide, alone, 3 * kMinute, [](StagedMusic& music) {
        music.next.part = MusicPart::stopped;
    });
    EXPECT_TRUE(changes(silent).empty());
    const auto lost = directed(
        1, kWide, alone, kMinute, [](StagedMusic& music) { music.next.grid.confidence = 0.0F; });
    EXPECT_TRUE(changes(lost).empty());
    EXPECT_EQ(lost.back().view.shot, Shot::wide);
}

TEST(Director, goes_slowly_nearer_in_a_build_up) {
    const auto seen = directed(2, kWide, alone, 2200, [](StagedMusic& music) {
        if (music.hop() == 1010) {
            music.next.event.kind = EventKind::build_up;
        }
        music.next.part = music.hop() >= 1010 ? MusicPart::build_up : MusicPart::playing;
    });
    EXPECT_EQ(seen[1210].view.shot, Shot::push);
    EXPECT_LT(seen[2100].view.camera.distance, 0.8F * seen[1210].view.camera.distance);
}

TEST(Director, shows_every_shot_to_one_and_only_whole_bodies_where_the_picture_is_narrow) {
    std::map<Shot, int> wide;
    std::map<Shot, int> narrow;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        for (const Seen& now : directed(seed, kWide, alone)) {
            ++wide[now.view.shot];
        }
        for (const Seen& now : directed(seed, kTall, three)) {
            ++narrow[now.view.shot];
        }
    }
    EXPECT_EQ(wide.size(), kShots);
    for (const auto& [shot, hops] : narrow) {
        EXPECT_TRUE(shot == Shot::wide || shot == Shot::full || shot == Shot::orbit ||
                    shot == Shot::low || shot == Shot::face)
            << name_of(shot);
    }
}

TEST(Director, the_same_seed_music_and_dancers_give_the_same_views_and_another_seed_others) {
    const auto one = directed(5, kWide, couple);
    const auto same = directed(5, kWide, couple);
    const auto other = directed(6, kWide, couple);
    bool differs = false;
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(one[i].view.camera, same[i].view.camera) << i;
        differs = differs || !(one[i].view.camera == other[i].view.camera);
    }
    EXPECT_TRUE(differs);
}

TEST(Director, shows_larger_bodies_as_large_from_further_away) {
    Director small(1);
    Director large(1);
    small.set_picture(1.0F, 1.0F);
    large.set_picture(1.0F, 1.3F);
    StagedMusic music;
    const MusicState state = music.state();
    const auto people = people_at({{0.2F, 0, 0.1F}});
    const Camera one = small.advance(state, people).camera;
    const Camera other = large.advance(state, people).camera;
    EXPECT_NEAR(other.distance, 1.3F * one.distance, 1e-4F);
    EXPECT_NEAR(other.target.y, 1.3F * one.target.y, 1e-4F);
}

}  // namespace
}  // namespace raks::render
