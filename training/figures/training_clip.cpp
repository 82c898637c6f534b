#include "training/figures/training_clip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "motion/figures/phrase_tempo.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

// In frames 0-3 the hands move from the rest pose to the first real pose.
constexpr std::size_t kConversionFrames = 4;

/// Vector from the hips' joint to the middle between the hip sockets in the rest pose, units of the
/// file.
glm::dvec3 sockets_from_hips(const MotionClip& clip, const HumanoidMapping& mapping) {
    const std::vector<glm::dvec3> rest = rest_positions(clip);
    const glm::dvec3 middle = 0.5 * (rest[*mapping.joint(Bone::left_upper_leg)] +
                                     rest[*mapping.joint(Bone::right_upper_leg)]);
    return middle - rest[*mapping.joint(Bone::hips)];
}

/// Places the hips' joint of the source where that of the built-in skeleton is, relative to the hip
/// sockets, which stay in place. Skeletons put this joint at different heights of the pelvis (here
/// 2 cm under the hip sockets, in ours 4 cm over them); scaling one body to the other without this
/// step would stretch the legs.
void move_hips_joint(const MotionClip& motion,
                     const HumanoidMapping& mapping,
                     const RetargetedClip& body,
                     TrainingClip& clip) {
    const Skeleton& ours = mannequin_skeleton();
    const glm::vec3 our_sockets = 0.5F * (ours.offsets[index_of(Bone::left_upper_leg)] +
                                          ours.offsets[index_of(Bone::right_upper_leg)]);
    // How far the joint has to move, in the hips' frame at rest; metres.
    const glm::dvec3 up =
        sockets_from_hips(motion, mapping) * body.metres_per_unit - glm::dvec3(our_sockets);
    for (Pose& pose : clip.poses) {
        // Undoes the retargeting's scale: clips are learnt at the source's size. The offset turns
        // with the hips.
        const glm::dvec3 source = glm::dvec3(pose.hips_position) / body.hips_scale;
        pose.hips_position = glm::vec3(source + glm::dquat(pose.rotation(Bone::hips)) * up);
    }
    clip.hips_height = body.source_hips_height + up.y;
}

/// Keeps the body where it begins: takes the mean way over kWaySeconds away, of hips and feet
/// alike. At both ends that mean is of a shorter, symmetric stretch, which a steady way does not
/// bend.
void stay_in_place(TrainingClip& clip) {
    constexpr double kWaySeconds = 4.0;
    const std::size_t reach = static_cast<std::size_t>(0.5 * kWaySeconds * clip.frames_per_second);
    std::vector<glm::dvec3> sums(1);
    for (const Pose& pose : clip.poses) {
        sums.push_back(sums.back() + glm::dvec3(pose.hips_position));
    }
    glm::dvec3 begin{};
    for (std::size_t i = 0; i < clip.poses.size(); ++i) {
        const std::size_t near = std::min({reach, i, clip.poses.size() - 1 - i});
        const glm::dvec3 mean =
            (sums[i + near + 1] - sums[i - near]) / static_cast<double>(2 * near + 1);
        begin = i == 0 ? mean : begin;
        const glm::dvec3 away(begin.x - mean.x, 0.0, begin.z - mean.z);
        clip.poses[i].hips_position += glm::vec3(away);
        for (SourceFoot& foot : clip.feet[i]) {
            foot.ankle += away;
            foot.toe_tip += away;
        }
    }
}

}  // namespace

std::string take_name(const fs::path& clip) {
    const fs::path named = clip.has_filename() ? clip : clip.parent_path();
    const ClipAddress address = clip_address(named);
    const std::string stem = address.file.stem().string();
    return address.clip.empty() ? stem : stem + "#" + address.clip;
}

Expected<TrainingClip> load_clip(const fs::path& path,
                                 const ClipUnits& units,
                                 std::vector<std::string>& warnings) {
    Expected<MotionClip> motion = read_skeleton_motion(path, units.reading);
    if (!motion) {
        return fail(motion.error());
    }
    for (const std::string& warning : motion->warnings) {
        warnings.push_back(path.filename().string() + ": " + warning);
    }
    motion->labels = units.joints;
    // The rest pose is needed again, which retarget does not return.
    const Expected<StandingClip> standing =
        stand(*motion,
              {.up = units.up, .metres_per_unit = units.metres_per_unit, .height = units.height});
    if (!standing) {
        return fail(Error(standing.error()).in(path.filename().string()));
    }
    // No floor height given: retarget estimates it from the toe tips.
    Expected<RetargetedClip> body = retarget(*standing, mannequin_skeleton());
    if (!body) {
        return fail(std::move(body.error()).in(path.filename().string()));
    }
    std::vector<std::string> notes = standing->body.joints.notes;
    const std::vector<std::string> doubts = standing->body.notes();
    notes.insert(notes.end(), doubts.begin(), doubts.end());
    for (const std::string& note : notes) {
        warnings.push_back(path.filename().string() + ": " + note);
    }
    const bool is_unit_known = units.metres_per_unit || units.height || motion->metres_per_unit;
    if (!is_unit_known && !standing->body.is_unit_doubtful()) {
        warnings.push_back(path.filename().string() + ": " +
                           unit_note(body->metres_per_unit, standing->body.size.reason));
    }
    TrainingClip clip;
    clip.name = take_name(path);
    clip.frames_per_second = body->frames_per_second;
    clip.poses = std::move(body->poses);
    clip.feet = std::move(body->source_feet);
    move_hips_joint(standing->clip, standing->body.mapping(), *body, clip);
    if (units.travel == ClipTravel::none) {
        stay_in_place(clip);
    }
    // As a fault these frames are bridged with the first sound pose.
    if (is_rest_pose(clip.poses.front())) {
        clip.faults.push_back({0, std::min(kConversionFrames, clip.poses.size()) - 1});
    }
    return clip;
}

}  // namespace raks::motion
