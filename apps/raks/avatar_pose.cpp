#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/pose_file.hpp"
#include "motion/skeleton/bvh.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "render/avatar/animation_sampler.hpp"
#include "render/avatar/posed_text.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Poses a second of clips that have no rate of their own.
constexpr double kRate = 60.0;
// Frames of a table: an hour of a clip at its rate.
constexpr double kLongest = 3600.0;

// What is shown, as poses at times.
struct Motion {
    std::function<motion::Pose(double)> pose_at;  // seconds
    double duration = 0.0;                        // seconds to the last pose
    double rate = kRate;
    float hips_scale = 1.0F;
};

// A model that is posed.
struct Posed {
    render::Model model;
    render::AvatarRig rig;
};

Expected<Posed> load_posed(const std::string& name) {
    const auto file = engine::find_avatar(name);
    if (!file) {
        return fail(file.error());
    }
    if (file->empty()) {
        return fail("the mannequin is no file: it is made by Raks itself");
    }
    auto model = render::load_model(*file);
    if (!model) {
        return fail(model.error());
    }
    Posed posed{.model = std::move(*model), .rig = {}};
    posed.rig = render::build_rig(posed.model);
    if (posed.rig.humanoid.joint(motion::Bone::hips) < 0) {
        return fail(fmt::format("{}: no humanoid: it names no hips", printable(name)));
    }
    for (const std::vector<std::string>* list : {&posed.model.warnings, &posed.rig.warnings}) {
        for (const std::string& warning : *list) {
            say(fmt::format("{}: {}", printable(name), warning));
        }
    }
    return posed;
}

Expected<Motion> motion_of_bvh(const Path& path, const render::HumanoidRig& rig) {
    const auto clip = motion::read_bvh(path);
    if (!clip) {
        return fail(clip.error());
    }
    motion::Skeleton skeleton;
    skeleton.offsets[0] = rig.rest_hips();
    const auto retargeted = motion::retarget(*clip, skeleton);
    if (!retargeted) {
        return fail(fmt::format("{}: {}", printable(path.string()), retargeted.error().message));
    }
    const auto poses = std::make_shared<std::vector<motion::Pose>>(retargeted->poses);
    const double rate = retargeted->frames_per_second;
    const auto pose_at = [poses, rate](double seconds) {
        const double last = static_cast<double>(poses->size() - 1);
        const double frame = std::clamp(seconds * rate, 0.0, last);
        const auto before = static_cast<std::size_t>(frame);
        const std::size_t after = std::min(before + 1, poses->size() - 1);
        const auto part = static_cast<float>(frame - std::floor(frame));
        return motion::interpolate((*poses)[before], (*poses)[after], part);
    };
    return Motion{.pose_at = pose_at,
                  .duration = static_cast<double>(poses->size() - 1) / rate,
                  .rate = rate,
                  .hips_scale = 1.0F};
}

Expected<Motion> motion_of_model(const Path& path, const render::HumanoidRig& rig) {
    auto read = render::load_model(path);
    if (!read) {
        return fail(read.error());
    }
    if (read->animations.empty()) {
        return fail(fmt::format("{}: there is no clip in it", printable(path.string())));
    }
    const auto model = std::make_shared<const render::Model>(std::move(*read));
    const auto sampler = std::make_shared<const render::AnimationSampler>(*model, 0);
    // The sampler looks into the model, so both live as long as the motion.
    const glm::vec3 rest = rig.rest_hips();
    const bool travels = sampler->has_travel() && sampler->rest_hips().y > 0.0F;
    const auto pose_at = [model, sampler, rest, travels](double seconds) {
        motion::Pose pose = sampler->pose_at(static_cast<float>(seconds));
        if (!travels) {
            pose.hips_position = rest;
        }
        return pose;
    };
    return Motion{.pose_at = pose_at,
                  .duration = static_cast<double>(sampler->duration()),
                  .rate = kRate,
                  .hips_scale = travels ? rest.y / sampler->rest_hips().y : 1.0F};
}

Expected<Motion> find_motion(const AvatarPoseArguments& arguments, const render::HumanoidRig& rig) {
    if (!arguments.pose.empty()) {
        auto pose = engine::read_pose(arguments.pose);
        if (!pose) {
            return fail(pose.error());
        }
        pose->hips_position = rig.rest_hips();
        return Motion{.pose_at = [pose = *pose](double) { return pose; },
                      .duration = 0.0,
                      .rate = kRate,
                      .hips_scale = 1.0F};
    }
    return arguments.motion.extension() == ".bvh" ? motion_of_bvh(arguments.motion, rig)
                                                  : motion_of_model(arguments.motion, rig);
}

// The times to show. Errors: neither a number nor "all", later than the clip ends.
Expected<std::vector<double>> times_of(const std::string& text, const Motion& motion) {
    std::vector<double> times;
    if (text == "all") {
        const double end = std::min(motion.duration, kLongest);
        for (std::size_t i = 0; static_cast<double>(i) <= end * motion.rate + 1e-6; ++i) {
            times.push_back(static_cast<double>(i) / motion.rate);
        }
        return times;
    }
    double seconds = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, seconds);
    if (error != std::errc() || rest != end || !(seconds >= 0.0) || seconds > kLongest) {
        return fail(fmt::format("--time is {}, must be seconds or all", printable(text)));
    }
    if (seconds > motion.duration + 1e-3) {
        return fail(fmt::format(
            "--time is {}, but the clip ends at {:.3f} s", printable(text), motion.duration));
    }
    times.push_back(seconds);
    return times;
}

// A model that moves by a motion.
class Mover {
 public:
    // `has_springs`: they swing with the motion; else they are at rest.
    Mover(const Posed& posed, const Motion& motion, bool has_springs)
        : posed_(posed), motion_(motion), has_springs_(has_springs), state_(posed.rig) {}

    // Goes on to a time; springs have swung since the start of the motion.
    const render::RigState& at(double seconds) {
        const auto pose_at = [&](StreamTime time) { return motion_.pose_at(to_seconds(time)); };
        // In steps that springs take for going on: after a longer one they would begin anew.
        constexpr double kStep = 0.1;
        for (; has_springs_ && reached_ < seconds; reached_ += kStep) {
            render::advance(posed_.rig,
                            stream_time_from_seconds(reached_),
                            motion_.hips_scale,
                            pose_at,
                            state_);
        }
        const StreamTime time = stream_time_from_seconds(seconds);
        if (has_springs_) {
            render::advance(posed_.rig, time, motion_.hips_scale, pose_at, state_);
        }
        render::pose_avatar(posed_.rig, pose_at(time), {}, motion_.hips_scale, state_);
        return state_;
    }

 private:
    const Posed& posed_;
    const Motion& motion_;
    bool has_springs_;
    render::RigState state_;
    double reached_ = 0.0;
};

// Errors: what can be said before anything is read.
Expected<void> check(const AvatarPoseArguments& arguments) {
    const std::string ending = arguments.output.extension().string();
    if (ending != ".obj" && ending != ".tsv") {
        return fail(fmt::format("{}: a posed avatar is written as .obj or .tsv",
                                printable(arguments.output.string())));
    }
    if (arguments.pose.empty() && arguments.motion.empty()) {
        return fail("give --pose FILE.json#NAME, or --motion with a clip");
    }
    if (ending == ".obj" && arguments.time == "all") {
        return fail("an .obj holds one time: give --time in seconds, or write a .tsv");
    }
    return check_output(arguments.output, {arguments.model, arguments.motion});
}

}  // namespace

ExitCode avatar_pose(const AvatarPoseArguments& arguments) {
    if (auto possible = check(arguments); !possible) {
        return fail(possible.error());
    }
    const auto posed = load_posed(arguments.model);
    if (!posed) {
        return fail(posed.error());
    }
    const auto motion = find_motion(arguments, posed->rig.humanoid);
    if (!motion) {
        return fail(motion.error());
    }
    const auto times = times_of(arguments.time, *motion);
    if (!times) {
        return fail(times.error());
    }
    Mover mover(*posed, *motion, arguments.pose.empty());
    if (arguments.output.extension() == ".obj") {
        return exit_code_of(
            write_file(arguments.output,
                       render::obj_text(
                           posed->model, posed->rig, mover.at(times->front()), posed->model.name)));
    }
    std::string text = render::joint_heads();
    for (std::size_t i = 0; i < times->size(); ++i) {
        text += render::joint_lines(posed->rig, mover.at((*times)[i]), i);
    }
    return exit_code_of(write_file(arguments.output, text));
}

}  // namespace raks::apps
