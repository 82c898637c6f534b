#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "engine/setup/dance_files.hpp"
#include "motion/dancer.hpp"
#include "motion/repertoire.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/dances.hpp"

/// Every shipped dance, every figure of it, and every change from one dance to another, on a
/// perfect beat: what is seen stays whole.
namespace raks::engine {
namespace {

using motion::Bone;
using motion::Dancer;
using motion::DancerCommand;
using motion::Pose;
using motion::PoseTrack;
using motion::Side;
using motion::Skeleton;
using motion::WorldPose;

struct ShippedDance {
    DanceId genre = DanceId::none;
    double bpm = 120.0;  // that it is danced to here
    int beats_per_bar = 4;
    std::shared_ptr<const motion::DanceLibrary> library;
};

const std::vector<ShippedDance>& shipped_dances() {
    static const std::vector<ShippedDance> dances = [] {
        std::vector<ShippedDance> all;
        for (const DanceInfo& dance : installed::dances().list()->all()) {
            const DanceId id = installed::dances().list()->id_of(dance.name);
            all.push_back(
                {id, dance.likely.bpm(), dance.beats_per_bar, installed::library_of(dance.name)});
        }
        return all;
    }();
    return dances;
}

/// Music that goes over to another tempo and bar at a hop, its beat going on.
class PerfectMusic {
 public:
    MusicState hear(HopIndex hop, const ShippedDance& dance) {
        const StreamTime now = time_of_hop(hop);
        if (grid_.tempo.bpm() != dance.bpm || grid_.beats_per_bar != dance.beats_per_bar) {
            grid_.anchor_beat = grid_.beats_at(now);
            grid_.anchor_time = now;
            grid_.tempo = Bpm(dance.bpm);
            grid_.beats_per_bar = dance.beats_per_bar;
        }
        grid_.confidence = 1.0F;
        MusicState state;
        state.hop = hop;
        state.time = state.audio_end = now;
        state.grid = grid_;
        state.genre = dance.genre;
        state.is_silent = false;
        state.loudness_lufs = -16.0F;
        return state;
    }

 private:
    BeatGrid grid_;
};

/// What must hold of any row of poses.
class Watch {
 public:
    void see(const Pose& pose) {
        const WorldPose world = world_pose(skeleton_, pose);
        for (const Side side : motion::kSides) {
            for (const glm::vec3& point : {skeleton_.ball, skeleton_.heel}) {
                lowest = std::min(lowest, foot_point(world, side, point).y);
            }
        }
        if (has_seen_) {
            for (const Bone bone : {Bone::hips,
                                    Bone::head,
                                    Bone::left_hand,
                                    Bone::right_hand,
                                    Bone::left_foot,
                                    Bone::right_foot}) {
                largest_step = std::max(
                    largest_step, glm::distance(world.position(bone), before_.position(bone)));
            }
        }
        before_ = world;
        has_seen_ = true;
    }
    float lowest = 0.0F;        // of a sole, metres
    float largest_step = 0.0F;  // of any of these joints in a hop, metres

 private:
    const Skeleton& skeleton_ = motion::mannequin_skeleton();
    WorldPose before_;
    bool has_seen_ = false;
};

std::shared_ptr<motion::Repertoire> everything() {
    const auto& dances = shipped_dances();
    auto repertoire = std::make_shared<motion::Repertoire>(dances[0].genre, dances[0].library);
    for (std::size_t i = 1; i < dances.size(); ++i) {
        repertoire->add(dances[i].genre, dances[i].library);
    }
    return repertoire;
}

/// A row in which every ordered pair of n follows one another.
std::vector<std::size_t> all_pairs(std::size_t n) {
    std::vector<std::size_t> row = {0};
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a + 1; b < n; ++b) {
            row.push_back(b);
            row.push_back(a);
        }
        row.push_back((a + 1) % n);
    }
    return row;
}

TEST(DanceChanges, six_dances_or_more_are_shipped) { EXPECT_GE(shipped_dances().size(), 6U); }

TEST(DanceChanges, each_dance_goes_over_to_each_other_within_three_bars) {
    constexpr HopIndex kHops = 1000;  // for each: over three bars of the slowest
    const auto& dances = shipped_dances();
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(everything(), motion::mannequin_skeleton(), motion::DancerPart{}));
    const auto track = std::make_unique<PoseTrack>();
    PerfectMusic music;
    Watch watch;
    HopIndex hop = 0;
    for (const std::size_t next : all_pairs(dances.size())) {
        const ShippedDance& dance = dances[next];
        const HopIndex from = hop;
        HopIndex begun = -1;
        for (; hop < from + kHops; ++hop) {
            dancer.advance(music.hear(hop, dance), *track);
            watch.see(track->at_hop(hop));
            if (begun < 0 && dancer.status().dance == dance.genre) {
                begun = hop;
            }
        }
        const double bar = dance.beats_per_bar * 60.0 / dance.bpm;
        ASSERT_GE(begun, from) << installed::dances().list()->name_of(dance.genre)
                               << " was not taken up";
        EXPECT_LT(static_cast<double>(begun - from) / 100.0, 3.0 * bar + 0.7)
            << installed::dances().list()->name_of(dance.genre);
    }
    // As within a figure: a hand in a side walk of house comes to 10.2 m/s.
    EXPECT_LT(watch.largest_step, 0.12F);
    EXPECT_GT(watch.lowest, -0.005F) << "5 mm under the floor";
}

TEST(DanceChanges, every_figure_of_every_dance_is_danced_whole) {
    for (const ShippedDance& dance : shipped_dances()) {
        const auto names = dance.library->figure_names();
        // Takes are danced in parts, as they follow one another.
        const bool is_of_cells = dance.library->cells() != nullptr;
        for (std::size_t figure = 0; figure < (is_of_cells ? 1 : names.size()); ++figure) {
            Dancer dancer;
            ASSERT_TRUE(dancer.prepare(dance.library, motion::mannequin_skeleton(), 7));
            dancer.command({DancerCommand::Kind::select_figure, {}, static_cast<double>(figure)});
            dancer.command({DancerCommand::Kind::lock_figure, {}, 1.0});
            const auto track = std::make_unique<PoseTrack>();
            PerfectMusic music;
            Watch watch;
            for (HopIndex hop = 0; hop < 1200; ++hop) {  // at least once whole
                dancer.advance(music.hear(hop, dance), *track);
                watch.see(track->at_hop(hop));
            }
            if (!is_of_cells) {
                EXPECT_EQ(std::string_view(dancer.status().figure.data()), names[figure]);
            }
            EXPECT_LT(watch.largest_step, 0.12F) << names[figure];
            EXPECT_GT(watch.lowest, -0.005F) << names[figure];
        }
    }
}

}  // namespace
}  // namespace raks::engine
