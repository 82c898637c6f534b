// `raks capture compare`: how far two motions of the same dance are apart.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/json.hpp"
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

std::string table_of(const motion::MotionComparison& comparison) {
    std::string text =
        fmt::format("{:<16} {:>9} {:>9} {:>9}\n", "", "from hips", "world", "degrees");
    for (std::size_t i = 0; i < comparison.joints.size(); ++i) {
        text += row_of(motion::kBoneNames[index_of(motion::kBodyBones[i])], comparison.joints[i]);
    }
    text += row_of("leftToeTip", comparison.toes[0]) + row_of("rightToeTip", comparison.toes[1]);
    return text + fmt::format(
                      "joints {:.1f} mm from the hips, {:.1f} mm in the world; feet {:.1f} mm from "
                      "the hips; bones {:.1f} degrees; over {:.1f} s\n",
                      kInMillimetres * comparison.from_hips,
                      kInMillimetres * comparison.world,
                      kInMillimetres * comparison.feet,
                      comparison.angle,
                      comparison.seconds);
}

std::string json_of(const motion::MotionComparison& comparison) {
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
    const Json json = {{"format", "raks-comparison"},
                       {"version", 1},
                       {"seconds", comparison.seconds},
                       {"from_hips", comparison.from_hips},
                       {"world", comparison.world},
                       {"feet", comparison.feet},
                       {"angle", comparison.angle},
                       {"joints", joints}};
    return json.text(2) + "\n";
}

}  // namespace

ExitCode compare(const CompareArguments& arguments) {
    const auto one = load_track(arguments.one);
    if (!one) {
        return fail(one.error());
    }
    const auto other = load_track(arguments.other);
    if (!other) {
        return fail(other.error());
    }
    const auto comparison = motion::compare_motions(*one, *other, arguments.shift);
    if (!comparison) {
        return fail(comparison.error());
    }
    if (arguments.as_json) {
        print_json(json_of(*comparison));
    } else {
        print_text(table_of(*comparison));
    }
    return kExitDone;
}

}  // namespace raks::apps
