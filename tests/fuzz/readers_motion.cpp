// What is done with recorded motion: drawn as sticks, brought onto our body, and learnt from.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/body/joint_report.hpp"
#include "motion/skeleton/formats/acclaim.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/json_arrays.hpp"
#include "motion/skeleton/formats/mmd/mmd_clip.hpp"
#include "motion/skeleton/formats/mmd/vmd_camera.hpp"
#include "motion/skeleton/formats/mmd/vpd.hpp"
#include "motion/skeleton/formats/npz.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "motion/skeleton/formats/smpl.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/points/guessed_edges.hpp"
#include "motion/skeleton/points/joint_points.hpp"
#include "motion/skeleton/points/point_edges.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/scene/clip_body.hpp"
#include "render/scene/point_body.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/training_clip.hpp"

namespace raks::fuzz {
namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The first, a middle and the last frame, as `raks stick` draws them.
void draw(const motion::MotionClip& clip) {
    const auto recorded = render::ClipBodies::create(clip);
    if (!recorded) {
        must_be_one_line(recorded.error().message);
        return;
    }
    for (const std::size_t frame : {std::size_t{0}, clip.frame_count / 2, clip.frame_count - 1}) {
        for (const render::StickVertex& vertex : recorded->at(frame).shape.vertices) {
            must(is_finite(vertex.position));
        }
    }
}

// A pose has turns that are none but turns.
void must_be_sound(const motion::Pose& pose) {
    must(is_finite(pose.hips_position));
    for (int bone = 0; bone < motion::kBoneCount; ++bone) {
        const glm::quat& turn = pose.rotation(static_cast<motion::Bone>(bone));
        must(std::abs(glm::length(turn) - 1.0F) < 1e-3F);
    }
}

// Learns a small figure from two repeats, as from labels at the clip's start and end.
void learn(const motion::TrainingClip& clip) {
    const auto last = static_cast<double>(clip.poses.size()) - 1.0;
    const std::vector<motion::FigureRepeat> repeats = {{0, {0.0, 0.25 * last, 0.5 * last}},
                                                       {0, {0.5 * last, 0.75 * last, last}}};
    motion::FigureTrainingOptions options;
    options.name = options.dance = "x";
    options.beats = 2;
    options.samples_per_beat = 4;
    options.states = 2;
    // One of the two kinds: learning takes nearly all of the time.
    options.features = clip.poses.size() % 2 == 0 ? motion::FigureFeatures::angles
                                                  : motion::FigureFeatures::positions;
    if (const auto learnt = motion::train_figure({&clip, 1}, repeats, options); !learnt) {
        must_be_one_line(learnt.error().message);
    }
}

// Whatever is found, the map of it says the same when it is read again.
void look_for_joints(motion::MotionClip clip) {
    const auto search = motion::search_joints(clip);
    must(search.has_value());
    for (const std::string& note : search->found.notes) {
        must_be_one_line(note);
    }
    if (search->refusal) {
        must_be_one_line(search->refusal->message);
    }
    const auto labels =
        motion::read_joint_map(motion::joint_map_text(clip, search->found.mapping), "x.toml");
    must(labels.has_value());
    clip.labels = *labels;
    if (const auto again = motion::search_joints(clip); !again) {
        must_be_one_line(again.error().message);
    }
}

// What a reader of a skeleton's motion promises.
void must_be_sound(const motion::MotionClip& clip) {
    must(clip.frame_count >= 1 && !clip.joints.empty() && clip.frames_per_second > 0.0);
    must(clip.rotations.size() == clip.frame_count * clip.joints.size());
    must(clip.positions.size() == clip.rotations.size());
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        must(clip.joints[joint].parent <= joint);
    }
    for (const glm::dquat& turn : clip.rotations) {
        must(std::abs(glm::length(turn) - 1.0) < 1e-6);
    }
    for (const glm::dvec3& place : clip.positions) {
        must(std::isfinite(place.x + place.y + place.z));
    }
    for (const std::string& warning : clip.warnings) {
        must_be_one_line(warning);
    }
    draw(clip);
}

// The same of points, which are drawn, too.
void must_be_sound(const motion::PointClip& clip) {
    must(clip.frame_count >= 1 && !clip.names.empty() && clip.frames_per_second > 0.0);
    must(clip.positions.size() == clip.frame_count * clip.names.size());
    for (const std::string& warning : clip.warnings) {
        must_be_one_line(warning);
    }
    const render::PointFrame lie = render::guess_point_frame(clip).frame;
    const auto recorded = render::PointBodies::create(
        {motion::world_points(clip, lie.metres_per_unit, lie.up, motion::guess_edges(clip))});
    must(recorded.has_value());
    for (const std::size_t frame : {std::size_t{0}, clip.frame_count - 1}) {
        for (const render::StickVertex& vertex : recorded->at(frame).shape.vertices) {
            must(is_finite(vertex.position));
        }
    }
}

// Whether it was read; what was read is sound, and what was not is said in one line.
template <typename Clip>
bool is_read(const Expected<Clip>& clip) {
    if (!clip) {
        must_be_one_line(clip.error().message);
        return false;
    }
    must_be_sound(*clip);
    return true;
}

bool read_smpl(const Expected<motion::NpzContent>& content) {
    if (!content) {
        must_be_one_line(content.error().message);
        return false;
    }
    return is_read(motion::smpl_clip(*content, std::nullopt));
}

}  // namespace

bool read_acclaim(std::string_view text) {
    // The skeleton, a line of its own, the motion: two files in one.
    constexpr std::string_view kCut = "\n%%\n";
    const std::size_t cut = std::min(text.find(kCut), text.size());
    const auto skeleton = motion::parse_asf(text.substr(0, cut), "x.asf");
    if (!skeleton) {
        must_be_one_line(skeleton.error().message);
        return false;
    }
    const std::string_view motion = text.substr(std::min(cut + kCut.size(), text.size()));
    return is_read(motion::parse_amc(motion, "x.amc", *skeleton, std::nullopt));
}

bool read_smpl_npz(std::string_view bytes) {
    return read_smpl(motion::read_npz(bytes, motion::kSmplArrays));
}
bool read_smpl_json(std::string_view text) {
    return read_smpl(motion::read_json_arrays(text, motion::kSmplArrays));
}
bool read_c3d(std::string_view bytes) {
    return is_read(motion::parse_c3d(bytes, "x.c3d", std::nullopt));
}
bool read_trc(std::string_view text) {
    return is_read(motion::parse_trc(text, "x.trc", std::nullopt));
}
bool read_points_csv(std::string_view text) {
    return is_read(motion::parse_points_csv(text, "x.csv", 60.0));
}

// As a body's and as a camera's, of which a file is one or the other.
bool read_vmd_file(std::string_view bytes) {
    const auto camera = motion::MmdCameraPath::parse(bytes, "x.vmd");
    if (camera) {
        for (const double seconds : {-1.0, 0.0, 0.37, camera->duration() + 1.0}) {
            const motion::MmdView view = camera->at(seconds);
            must(std::abs(glm::length(view.turn) - 1.0) < 1e-6 && is_finite(glm::vec3(view.eye())));
        }
    } else {
        must_be_one_line(camera.error().message);
    }
    const bool is_body = is_read(motion::parse_vmd(bytes, "x.vmd"));
    return is_body || camera.has_value();
}
bool read_vpd_file(std::string_view text) { return is_read(motion::parse_vpd(text, "x.vpd")); }

bool read_joint_map_file(std::string_view text) {
    auto labels = motion::read_joint_map(text, "x.toml");
    if (!labels) {
        must_be_one_line(labels.error().message);
        return false;
    }
    motion::MotionClip clip;
    clip.frame_count = 1;
    for (const std::string_view bone : motion::kBoneNames) {
        const std::size_t parent = motion::kBoneParents[clip.joints.size()];
        clip.joints.push_back({std::string(bone), parent, {0.0, 1.0, 0.0}, std::nullopt});
        clip.rotations.emplace_back(1.0, 0.0, 0.0, 0.0);
        clip.positions.emplace_back(0.0, 1.0, 0.0);
    }
    clip.labels = std::move(*labels);
    if (const auto search = motion::search_joints(clip); !search) {
        must_be_one_line(search.error().message);
    }
    return true;
}

bool read_edges(std::string_view text) {
    const auto edges = motion::parse_edges(text, "x.txt");
    if (!edges) {
        must_be_one_line(edges.error().message);
        return false;
    }
    const std::vector<std::string> points = {"RHip", "RKnee", "a b", "RAnkle"};
    const motion::FoundEdges found = motion::find_edges(*edges, points);
    must(found.edges.size() + found.left_out <= edges->size());
    must(found.unknown.empty() == (found.left_out == 0));
    for (const motion::PointEdge& edge : found.edges) {
        must(edge.from < edge.to && edge.to < points.size());
    }
    return true;
}

bool read_clip(std::string_view text) {
    const MemoryFile file(text);
    // With a given rate, as by --fps, the file's own may be anything.
    const auto clip = motion::read_bvh(file.path());
    const auto paced = motion::read_bvh(file.path(), {.frames_per_second = 60.0});
    must(!clip || paced);
    if (!paced) {
        must_be_one_line(paced.error().message);
        return false;
    }
    must(paced->frame_count >= 1 &&
         paced->rotations.size() == paced->frame_count * paced->joints.size());
    for (const std::string& warning : paced->warnings) {
        must_be_one_line(warning);
    }
    draw(*paced);
    look_for_joints(*paced);
    static_cast<void>(motion::leading_rest_frames(*paced));
    std::vector<std::string> warnings;
    const auto body =
        motion::load_clip(file.path(),
                          {.reading = {.frames_per_second = 60.0}, .metres_per_unit = std::nullopt},
                          warnings);
    if (body) {
        for (const motion::Pose& pose : body->poses) {
            must_be_sound(pose);
        }
        learn(*body);
    }
    return clip.has_value();
}

}  // namespace raks::fuzz
