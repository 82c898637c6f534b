#include "engine/show/avatar_clip.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/avatar_model.hpp"
#include "engine/show/written_figure.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "motion/skeleton/text_lines.hpp"
#include "render/avatar/animation_sampler.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/avatar/node_clip.hpp"
#include "render/import/bind_places.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_motion.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/standing_body.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

/// The T-pose of a body that stands.
render::BoneRest rest_of(const render::Model& model, const render::StandingBody& standing) {
    render::BoneRest rest;
    rest.turn = standing.turn;
    rest.parents = standing.parents;
    for (std::size_t bone = 0; bone < rest.world.size(); ++bone) {
        const int node = model.character.humanoid.nodes[bone];
        rest.world[bone] = motion::kNoRotation;
        rest.above[bone] = motion::kNoRotation;
        if (node < 0) {
            continue;
        }
        rest.world[bone] = standing.straighten[bone] *
                           render::rotation_of(standing.world[static_cast<std::size_t>(node)]);
        const int above = standing.parents[static_cast<std::size_t>(node)];
        const int upper = render::mapped_parent(model.character.humanoid, static_cast<int>(bone));
        if (above >= 0 && upper >= 0) {
            // What hangs between two bones stands with the upper one.
            rest.above[bone] = standing.straighten[static_cast<std::size_t>(upper)] *
                               render::rotation_of(standing.world[static_cast<std::size_t>(above)]);
        }
    }
    return rest;
}

}  // namespace

/// Makes clips of the kinds of files.
class AvatarClipReader {
 public:
    AvatarClipReader(fs::path file,
                     std::string name,
                     const glm::vec3& hips,
                     render::OtherNodes others)
        : file_(std::move(file)), name_(std::move(name)), hips_(hips), others_(others) {}

    Expected<AvatarClip> read_skeleton(const AvatarClipOptions& options) const {
        motion::MotionReadOptions reading;
        reading.arm_angle = options.arm_angle;
        auto clip = motion::read_skeleton_motion(file_, reading);
        if (!clip) {
            return fail(clip.error());
        }
        clip->labels = options.joints;
        motion::Skeleton body;
        body.offsets[0] = hips_;
        auto retargeted = motion::retarget(*clip, body);
        if (!retargeted) {
            return fail(std::move(retargeted.error()).in(printable(file_.string())));
        }
        if (retargeted->poses.empty()) {
            return fail(printable(file_.string()) + ": there are no poses in it");
        }
        AvatarClip read = clip_of(std::move(retargeted->poses), retargeted->frames_per_second);
        if (!clip->expressions.empty()) {
            read.face_ = face_of(std::move(clip->expressions), clip->frames_per_second);
        }
        read.warnings_ = std::move(clip->warnings);
        return read;
    }

    // A figure of a written dance, which the mannequin dances, as large as the body is.
    Expected<AvatarClip> read_written() const {
        const auto dance = load_written_dance(file_);
        if (!dance) {
            return fail(dance.error());
        }
        const auto figure = find_figure(*dance, name_);
        if (!figure) {
            return fail(figure.error());
        }
        const auto danced = std::make_shared<const motion::EvaluatedFigure>(
            danced_figure(*dance, *figure, dance->written));
        const double beats_a_second = dance->written.beats_per_second();
        AvatarClip clip;
        clip.duration_ = danced->repeats * danced->beats / beats_a_second;
        clip.rate_ = danced->frames_per_second;
        clip.bpm_ = dance->written.bpm();
        clip.pose_ = [danced,
                      beats_a_second,
                      end = clip.duration_,
                      scale = hips_.y / motion::mannequin_skeleton().offsets[0].y](double seconds) {
            const double beat = std::clamp(seconds, 0.0, end) * beats_a_second;
            motion::Pose pose = motion::pose_between(danced->poses, danced->frame_of(beat));
            pose.hips_position *= scale;
            return pose;
        };
        return clip;
    }

    // `own_scale`: of AvatarClipOptions; none: the ratio of hips heights.
    Expected<AvatarClip> read_model(const fs::path& labels,
                                    const std::optional<render::BoneLabels>& own,
                                    std::optional<float> own_scale) const {
        auto read = render::load_model(file_);
        if (!read) {
            return fail(read.error());
        }
        auto model = std::make_shared<render::Model>(std::move(*read));
        auto clip = clip_of(*model, labels, own, own_scale, model);
        if (!clip) {
            return fail(std::move(clip.error()).in(printable(file_.string())));
        }
        if (const std::string line = render::first_of_several(*model, name_); !line.empty()) {
            clip->choice_ = printable(file_.filename().string()) + " " + line;
        }
        return clip;
    }

 private:
    static AvatarClip clip_of(std::vector<motion::Pose> list, double rate) {
        AvatarClip clip;
        clip.duration_ = static_cast<double>(list.size() - 1) / rate;
        clip.rate_ = rate;
        clip.pose_ = [poses = std::move(list), rate](double seconds) {
            return motion::pose_between(poses, seconds * rate);
        };
        return clip;
    }

    // Faces of expressions by frame, in a straight line between two frames.
    static std::function<render::Face(double)> face_of(std::vector<motion::ExpressionTrack> tracks,
                                                       double rate) {
        return [tracks = std::move(tracks), rate](double seconds) {
            render::Face face;
            for (const motion::ExpressionTrack& track : tracks) {
                const auto* const name = std::find(render::kFaceExpressionNames.begin(),
                                                   render::kFaceExpressionNames.end(),
                                                   track.name);
                if (name == render::kFaceExpressionNames.end() || track.weights.empty()) {
                    continue;
                }
                const double last = static_cast<double>(track.weights.size() - 1);
                const double at = std::clamp(seconds * rate, 0.0, last);
                const auto from = static_cast<std::size_t>(at);
                const std::size_t to = std::min(from + 1, track.weights.size() - 1);
                face.weights[static_cast<std::size_t>(name -
                                                      render::kFaceExpressionNames.begin())] =
                    std::lerp(track.weights[from],
                              track.weights[to],
                              static_cast<float>(at - static_cast<double>(from)));
            }
            return face;
        };
    }

    // `keeper` keeps the model alive, into which clips look.
    Expected<AvatarClip> clip_of(render::Model& model,
                                 const fs::path& labels,
                                 const std::optional<render::BoneLabels>& own,
                                 std::optional<float> own_scale,
                                 const std::shared_ptr<render::Model>& keeper) const {
        const auto index = render::find_animation(model, name_);
        if (!index) {
            return fail(index.error());
        }
        if (model.animated_face.is_vrma) {
            return vrma_clip(keeper, *index);
        }
        auto found = own ? render::map_humanoid(model, &*own)
                         : find_bones(model, find_labels(file_, labels));
        if (!found) {
            return fail(found.error());
        }
        return own_clip(keeper, *index, own_scale);
    }

    AvatarClip vrma_clip(const std::shared_ptr<render::Model>& model, std::size_t index) const {
        const auto sampler = std::make_shared<const render::AnimationSampler>(*model, index);
        const bool travels = sampler->has_travel() && sampler->rest_hips().y > 0.0F;
        const float scale = travels ? hips_.y / sampler->rest_hips().y : 1.0F;
        AvatarClip clip;
        clip.duration_ = static_cast<double>(sampler->duration());
        clip.pose_ = [model, sampler, travels, scale, hips = hips_](double seconds) {
            motion::Pose pose = sampler->pose_at(static_cast<float>(seconds));
            pose.hips_position = travels ? pose.hips_position * scale : hips;
            return pose;
        };
        if (sampler->has_face()) {
            clip.face_ = [model, sampler](double seconds) {
                return sampler->face_at(static_cast<float>(seconds));
            };
        }
        clip.warnings_ = model->warnings;
        return clip;
    }

    AvatarClip own_clip(const std::shared_ptr<render::Model>& model,
                        std::size_t index,
                        std::optional<float> own_scale) const {
        const render::StandingBody standing = render::stand_up(*model);
        const auto sampler =
            std::make_shared<render::NodeClip>(*model, index, rest_of(*model, standing), others_);
        const auto hips_node = static_cast<std::size_t>(model->character.humanoid.nodes[0]);
        const glm::vec3 rest(standing.world[hips_node][3]);
        const float height = rest.y - render::mesh_box(*model, standing.world).lowest.y;
        const float scale = own_scale.value_or(height > 0.0F ? hips_.y / height : 1.0F);
        AvatarClip clip;
        clip.duration_ = static_cast<double>(sampler->duration());
        // From where the hips rest, wherever the file has that: a scene around a figure may reach
        // below its floor.
        clip.pose_ = [model, sampler, rest, scale, hips = hips_](double seconds) {
            motion::Pose pose = sampler->pose_at(static_cast<float>(seconds));
            pose.hips_position = hips + scale * (pose.hips_position - rest);
            return pose;
        };
        if (others_ == render::OtherNodes::moved) {
            clip.others_ = [model, sampler](double seconds,
                                            const glm::vec3& hips,
                                            const render::JointTree& tree,
                                            render::JointState& state) {
                sampler->move_others(static_cast<float>(seconds), hips, tree, state);
            };
        }
        clip.warnings_ = model->warnings;
        return clip;
    }

    fs::path file_;
    std::string name_;
    glm::vec3 hips_;
    render::OtherNodes others_;
};

fs::path AvatarClip::file_of(const std::string& argument) {
    return motion::clip_address(argument).file;
}

Expected<AvatarClip> AvatarClip::load(const std::string& argument,
                                      const glm::vec3& hips,
                                      const AvatarClipOptions& options) {
    const auto [file, name] = motion::clip_address(argument);
    std::error_code ignored;
    const bool is_own = !options.avatar.empty() && fs::equivalent(file, options.avatar, ignored);
    const AvatarClipReader reader(
        file, name, hips, is_own ? options.others : render::OtherNodes::folded);
    // Faces and VRM's own bones are more than a motion clip holds, so models have a way of their
    // own.
    const auto start = read_file_start(file, motion::kMotionFormatBytes);
    if (!start) {
        return fail(start.error());
    }
    if (motion::lower(file.extension().string()) == ".toml") {
        return reader.read_written();
    }
    const auto format = motion::motion_format(*start, file);
    if (format != motion::MotionFormat::model) {
        if (!name.empty()) {
            return fail(file.string() + ": holds one clip, which has no name");
        }
        auto clip = reader.read_skeleton(options);
        if (clip) {
            clip->is_of_one_song_ = format == motion::MotionFormat::vmd;
        }
        return clip;
    }
    if (!options.joints.joints.empty()) {
        return fail(file.string() +
                    ": is a model, whose bones --labels says; leave --joint and --joints out");
    }
    return is_own ? reader.read_model(options.labels, options.own_labels, options.own_scale)
                  : reader.read_model({}, {}, {});
}

}  // namespace raks::engine
