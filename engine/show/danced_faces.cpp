#include "engine/show/danced_faces.hpp"

#include <algorithm>
#include <utility>

#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

void CollectFaces::advance(const MusicState& music, std::span<const motion::PoseTrack> tracks) {
    if (tracks.empty()) {
        return;
    }
    faces_.resize(tracks.size());
    while (made_by_.size() < tracks.size()) {
        made_by_.emplace_back(made_by_.size(), habits_);
    }
    for (StreamTime time = stream_time_from_seconds(static_cast<double>(next_) / fps_);
         time <= time_of_hop(tracks.front().newest_final());
         time = stream_time_from_seconds(static_cast<double>(++next_) / fps_)) {
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            const motion::PoseTrack& track = tracks[i];
            faces_[i].push_back(made_by_[i].face_at({.time = time,
                                                     .level_dbfs = music.level_dbfs,
                                                     .loudness_lufs = music.loudness_lufs,
                                                     .head = head_turn_at(track, time),
                                                     .feeling = track.feeling_at(time)},
                                                    motion::mannequin_skeleton(),
                                                    track.at(time)));
        }
    }
}

std::vector<render::Face> CollectFaces::of(std::size_t dancer, std::size_t count) const {
    std::vector<render::Face> faces;
    if (dancer < faces_.size()) {
        faces = faces_[dancer];
    }
    faces.resize(count, faces.empty() ? render::Face() : faces.back());
    return faces;
}

std::vector<motion::ExpressionTrack> expression_tracks(std::span<const render::Face> faces) {
    std::vector<motion::ExpressionTrack> tracks;
    for (std::size_t i = 0; i < render::kFaceExpressionCount; ++i) {
        motion::ExpressionTrack track{.name = std::string(render::kFaceExpressionNames[i]),
                                      .is_preset = i < render::kPresetExpressionCount,
                                      .weights = {}};
        for (const render::Face& face : faces) {
            track.weights.push_back(std::clamp(face.weights[i], 0.0F, 1.0F));
        }
        if (std::any_of(track.weights.begin(), track.weights.end(), [](float weight) {
                return weight > 0.0F;
            })) {
            tracks.push_back(std::move(track));
        }
    }
    return tracks;
}

}  // namespace raks::engine
