// `raks capture compare`: how far two motions of the same dance are apart.
#include <fmt/format.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/json.hpp"
#include "motion/evaluate/motion_alignment.hpp"
#include "motion/evaluate/motion_comparison.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::apps {
namespace {

constexpr double kInMillimetres = 1000.0;

Expected<motion::BodyTrack> load_track(const Path& path) {
    const auto clip = motion::read_skeleton_motion(path, {});
    if (!clip) {
        return fail(clip.error());
    }
    auto track = motion::body_track(*clip, motion::guess_metres_per_unit(*clip));
    return track ? std::move(track) : fail(Error(track.error()).in(path.string()));
}

/// One joint as a row of the table.
std::string row_of(std::string_view name, const motion::JointDifference& joint) {
    return fmt::format("{:<16} {:>9.1f} {:>9.1f} {:>9}\n",
                       name,
                       kInMillimetres * joint.from_hips,
                       kInMillimetres * joint.world,
                       joint.angle ? fmt::format("{:.1f}", *joint.angle) : "");
}

/// Mean angle of the limbs' bones of one kind, both sides; degrees.
double limb_angle(const motion::MotionComparison& comparison,
                  std::initializer_list<motion::Bone> left_bones) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < comparison.joints.size(); ++i) {
        for (const motion::Bone left : left_bones) {
            const motion::Bone bone = motion::kBodyBones[i];
            const bool is_meant = bone == left || bone == motion::mirrored(left);
            if (is_meant && comparison.joints[i].angle) {
                sum += *comparison.joints[i].angle;
                count += 1.0;
            }
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

double leg_angle(const motion::MotionComparison& comparison) {
    return limb_angle(comparison, {motion::Bone::left_upper_leg, motion::Bone::left_lower_leg});
}

double arm_angle(const motion::MotionComparison& comparison) {
    return limb_angle(comparison, {motion::Bone::left_upper_arm, motion::Bone::left_lower_arm});
}

std::string table_of(const motion::MotionComparison& comparison) {
    std::string text =
        fmt::format("{:<16} {:>9} {:>9} {:>9}\n", "", "from hips", "world", "degrees");
    for (std::size_t i = 0; i < comparison.joints.size(); ++i) {
        text += row_of(motion::kBoneNames[index_of(motion::kBodyBones[i])], comparison.joints[i]);
    }
    text += row_of("leftToeTip", comparison.toes[0]) + row_of("rightToeTip", comparison.toes[1]);
    return text +
           fmt::format(
               "joints {:.1f} mm from the hips, {:.1f} mm in the world; feet {:.1f} mm from "
               "the hips; bones {:.1f} degrees, legs {:.1f}, arms {:.1f}; over {:.1f} s\n",
               kInMillimetres * comparison.from_hips,
               kInMillimetres * comparison.world,
               kInMillimetres * comparison.feet,
               comparison.angle,
               leg_angle(comparison),
               arm_angle(comparison),
               comparison.seconds) +
           (comparison.planted_toes
                ? fmt::format("toes of the other while those of the one stand: 9 of 10 moments "
                              "slower than {:.2f} m/s\n",
                              *comparison.planted_toes)
                : "");
}

std::string alignment_text(const motion::MotionAlignment& alignment) {
    return fmt::format(
        "turned by {:.1f} degrees about the vertical and moved by {:.2f} {:.2f} {:.2f} m; as they "
        "are: up off by {:.1f} degrees, scale {:.3f}\n",
        alignment.turn,
        alignment.move.x,
        alignment.move.y,
        alignment.move.z,
        alignment.tilt,
        alignment.scale);
}

std::string json_of(const motion::MotionComparison& comparison,
                    const std::optional<motion::MotionAlignment>& alignment) {
    const auto joint_json = [](const motion::JointDifference& joint) {
        Json json = {{"from_hips", joint.from_hips}, {"world", joint.world}};
        if (joint.angle) {
            json["angle"] = *joint.angle;
        }
        return json;
    };
    Json joints;
    for (std::size_t i = 0; i < comparison.joints.size(); ++i) {
        joints[std::string(motion::kBoneNames[index_of(motion::kBodyBones[i])])] =
            joint_json(comparison.joints[i]);
    }
    joints["leftToeTip"] = joint_json(comparison.toes[0]);
    joints["rightToeTip"] = joint_json(comparison.toes[1]);
    Json json = {{"format", "raks-comparison"},
                 {"version", 1},
                 {"seconds", comparison.seconds},
                 {"from_hips", comparison.from_hips},
                 {"world", comparison.world},
                 {"feet", comparison.feet},
                 {"angle", comparison.angle},
                 {"legs_angle", leg_angle(comparison)},
                 {"arms_angle", arm_angle(comparison)},
                 {"joints", joints}};
    if (comparison.planted_toes) {
        json["planted_toes"] = *comparison.planted_toes;
    }
    if (alignment) {
        json["alignment"] = {{"turn", alignment->turn},
                             {"move", {alignment->move.x, alignment->move.y, alignment->move.z}},
                             {"up_off", alignment->tilt},
                             {"scale", alignment->scale}};
    }
    return json.text(2) + "\n";
}

}  // namespace

ExitCode compare(const CompareArguments& arguments) {
    const auto one = load_track(arguments.one);
    if (!one) {
        return fail(one.error());
    }
    auto other = load_track(arguments.other);
    if (!other) {
        return fail(other.error());
    }
    std::optional<motion::MotionAlignment> alignment;
    if (arguments.is_aligned) {
        const auto found = motion::align_motion(*one, *other, arguments.shift);
        if (!found) {
            return fail(found.error());
        }
        alignment = *found;
    }
    const auto comparison = motion::compare_motions(*one, *other, arguments.shift);
    if (!comparison) {
        return fail(comparison.error());
    }
    if (arguments.as_json) {
        print_json(json_of(*comparison, alignment));
    } else {
        print_text(table_of(*comparison) + (alignment ? alignment_text(*alignment) : ""));
    }
    return kExitDone;
}

}  // namespace raks::apps
