// Music and dancers made by hand, for whoever stages them.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <utility>
#include <vector>

#include "base/music_state.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::render {

/// States of hops in a row: 4/4 from stream time 0 on.
class StagedMusic {
 public:
    explicit StagedMusic(Bpm tempo = Bpm(120.0)) {
        next.grid.tempo = tempo;
        next.grid.confidence = 1.0F;
        next.part = MusicPart::playing;
    }
    /// `next`, at the next hop; its event and accent are then gone.
    MusicState state() {
        MusicState now = next;
        now.hop = hop_;
        now.time = time_of_hop(hop_);
        if (now.event.kind != MusicEvent::Kind::none && now.event.time == StreamTime{}) {
            now.event.time = now.time;
        }
        ++hop_;
        next.event = {};
        next.accent = {};
        return now;
    }
    [[nodiscard]] HopIndex hop() const { return hop_; }

    MusicState next;  ///< what the next state says besides hop and time

 private:
    HopIndex hop_ = 0;
};

/// People in T-pose, their arms to both sides, at these places of the floor.
inline std::vector<motion::WorldPose> people_at(std::initializer_list<glm::vec3> places) {
    std::vector<motion::WorldPose> people;
    for (const glm::vec3 place : places) {
        motion::Pose pose;
        pose.hips_position =
            place + glm::vec3(0.0F, motion::mannequin_skeleton().hips_height(), 0.0F);
        people.push_back(motion::world_pose(motion::mannequin_skeleton(), pose));
    }
    return people;
}

}  // namespace raks::render
