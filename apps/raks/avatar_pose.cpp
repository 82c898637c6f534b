#include <algorithm>
#include <charconv>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/avatar_picture.hpp"
#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/avatar_model.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/pose_file.hpp"
#include "render/avatar/posed_text.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Frames of a table: an hour of a clip at its rate.
constexpr double kLongest = 3600.0;

// A model that is posed: with what is drawn of it where a picture is asked for.
struct Posed {
    engine::AvatarModel figure;
    std::shared_ptr<const render::AvatarRig> rig;
    std::shared_ptr<const render::Avatar> avatar;  // null: no picture is asked for
    glm::vec3 hips{0.0F};                          // where they rest
};

bool is_picture(const Path& output) { return output.extension() == ".png"; }

Expected<Path> file_of(const std::string& name) {
    auto file = engine::find_avatar(name);
    if (file && file->empty()) {
        return fail("the mannequin has no file, as Raks makes it itself: name the file of a model");
    }
    return file;
}

void say_warnings(const std::string& name, const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        say(fmt::format("{}: {}", printable(name), warning));
    }
}

// Texts are in the file's own metres, unless a height is asked for; pictures as it dances.
Expected<Posed> load_posed(const AvatarPoseArguments& arguments, const Path& file) {
    auto figure = engine::load_avatar_model(file, arguments.options);
    if (!figure) {
        return fail(figure.error());
    }
    Posed posed{.figure = std::move(*figure), .rig = {}, .avatar = {}, .hips = {}};
    if (is_picture(arguments.output)) {
        const auto avatar = engine::make_avatar(posed.figure, file.filename().string());
        say_warnings(arguments.model, avatar.warnings);
        posed.avatar = avatar.avatar;
        posed.rig = avatar.avatar->rig;
        posed.hips = avatar.avatar->skeleton.offsets[0];
        return posed;
    }
    if (!arguments.options.height) {
        posed.figure.options.scale = 1.0F;
    }
    posed.rig = std::make_shared<const render::AvatarRig>(
        render::build_rig(posed.figure.model, posed.figure.options));
    say_warnings(arguments.model, posed.figure.model.warnings);
    say_warnings(arguments.model, posed.rig->warnings);
    posed.hips = posed.rig->humanoid.rest_hips();
    return posed;
}

// What is shown, as poses and faces at times.
struct Motion {
    std::function<motion::Pose(double)> pose_at;  // seconds
    std::function<render::Face(double)> face_at;
    /// What the clip moves besides bones; none: nothing.
    std::function<void(double, const motion::Pose&, const render::JointTree&, render::JointState&)>
        move_others{};
    double duration = 0.0;  // seconds to the last pose
    double rate = 1.0;      // poses a second
};

// A picture of a posture stands on the floor; a mesh has the hips where they rest.
Expected<Motion> posture(const std::string& argument, const Posed& posed) {
    auto pose = engine::read_pose(argument);
    if (!pose) {
        return fail(pose.error());
    }
    pose->hips_position = posed.hips;
    if (posed.avatar != nullptr) {
        *pose = standing_on_floor(*posed.avatar, *pose);
    }
    return Motion{.pose_at = [pose = *pose](double) { return pose; },
                  .face_at = [](double) { return render::Face(); },
                  .duration = 0.0,
                  .rate = 1.0};
}

Expected<Motion> find_motion(const AvatarPoseArguments& arguments,
                             const Path& file,
                             const Posed& posed) {
    if (!arguments.pose.empty()) {
        return posture(arguments.pose, posed);
    }
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    auto clip = engine::AvatarClip::load(arguments.motion,
                                         posed.hips,
                                         {.avatar = file,
                                          .own_scale = posed.figure.options.scale,
                                          .labels = arguments.options.labels,
                                          .joints = std::move(*joints),
                                          .arm_angle = arguments.arm_angle,
                                          .others = render::OtherNodes::moved});
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    const double duration = clip->duration();
    const double rate = clip->rate();
    const auto shared = std::make_shared<const engine::AvatarClip>(std::move(*clip));
    return Motion{
        .pose_at = [shared](double seconds) { return shared->pose_at(seconds); },
        .face_at =
            [shared](double seconds) { return shared->face_at(seconds).value_or(render::Face()); },
        .move_others =
            [shared](double seconds,
                     const motion::Pose& pose,
                     const render::JointTree& tree,
                     render::JointState& state) {
                shared->move_others(seconds, pose, tree, state);
            },
        .duration = duration,
        .rate = rate};
}

// The times to show. Errors: neither a number nor "all", later than the clip ends.
Expected<std::vector<double>> times_of(const std::string& text, const Motion& motion) {
    std::vector<double> times;
    if (text == "all") {
        constexpr double kSlack = 1e-3;  // of a frame: clips have their times as floats
        const double end = std::min(motion.duration, kLongest);
        for (std::size_t i = 0; static_cast<double>(i) <= end * motion.rate + kSlack; ++i) {
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
    Mover(const render::AvatarRig& rig, const Motion& motion, bool has_springs)
        : rig_(rig), motion_(motion), has_springs_(has_springs), state_(rig) {}

    // Goes on to a time; springs have swung since the start of the motion.
    const render::RigState& at(double seconds) {
        // In steps that springs take for going on: after a longer one they would begin anew.
        constexpr double kStep = 0.1;
        for (; has_springs_ && reached_ < seconds; reached_ += kStep) {
            swing_to(reached_);
        }
        if (has_springs_) {
            swing_to(seconds);
        }
        const motion::Pose pose = motion_.pose_at(seconds);
        move_others(seconds, pose);
        render::pose_avatar(rig_, pose, motion_.face_at(seconds), kOwnBody, state_);
        return state_;
    }

 private:
    static constexpr float kOwnBody = 1.0F;  // poses are on this body already

    void move_others(double seconds, const motion::Pose& pose) {
        if (motion_.move_others) {
            motion_.move_others(seconds, pose, rig_.tree, state_.joints);
        }
    }

    void swing_to(double seconds) {
        move_others(seconds, motion_.pose_at(seconds));
        render::advance(
            rig_,
            stream_time_from_seconds(seconds),
            kOwnBody,
            [&](StreamTime time) { return motion_.pose_at(to_seconds(time)); },
            state_);
    }

    const render::AvatarRig& rig_;
    const Motion& motion_;
    bool has_springs_;
    render::RigState state_;
    double reached_ = 0.0;
};

// Errors: what can be said before anything is read.
Expected<void> check(const AvatarPoseArguments& arguments) {
    const std::string ending = arguments.output.extension().string();
    if (ending != ".obj" && ending != ".tsv" && ending != ".png") {
        return fail(fmt::format("{}: a posed avatar is written as .png, .obj or .tsv",
                                printable(arguments.output.string())));
    }
    if (arguments.pose.empty() && arguments.motion.empty()) {
        return fail("give --pose FILE.json#NAME, or --motion with a clip");
    }
    if (ending != ".tsv" && arguments.time == "all") {
        return fail(fmt::format(
            "{} holds one time: give --time in seconds, or write a .tsv (a film: raks render "
            "--motion)",
            ending == ".obj" ? "an .obj" : "a picture"));
    }
    return check_output(arguments.output,
                        {arguments.model, engine::AvatarClip::file_of(arguments.motion)});
}

Expected<void> write_table(const Path& output,
                           Mover& mover,
                           const Posed& posed,
                           const std::vector<double>& times) {
    std::string text = render::joint_heads();
    for (std::size_t i = 0; i < times.size(); ++i) {
        text += render::joint_lines(*posed.rig, mover.at(times[i]), i);
    }
    return write_file(output, text);
}

}  // namespace

ExitCode avatar_pose(const AvatarPoseArguments& arguments) {
    if (auto possible = check(arguments); !possible) {
        return fail(possible.error());
    }
    const auto file = file_of(arguments.model);
    if (!file) {
        return fail(file.error());
    }
    const auto posed = load_posed(arguments, *file);
    if (!posed) {
        return fail(posed.error());
    }
    const auto motion = find_motion(arguments, *file, *posed);
    if (!motion) {
        return fail(motion.error());
    }
    const auto times = times_of(arguments.time, *motion);
    if (!times) {
        return fail(times.error());
    }
    Mover mover(*posed->rig, *motion, arguments.pose.empty());
    if (arguments.output.extension() == ".tsv") {
        return exit_code_of(write_table(arguments.output, mover, *posed, *times));
    }
    const double time = times->front();
    const render::RigState& state = mover.at(time);
    if (posed->avatar != nullptr) {
        const motion::Pose pose = motion->pose_at(time);
        return exit_code_of(
            write_avatar_picture(arguments.output,
                                 *posed->avatar,
                                 pose,
                                 state,
                                 {.camera = whole_camera(posed->figure, *posed->avatar, pose)}));
    }
    const render::Model& model = posed->figure.model;
    return exit_code_of(
        write_file(arguments.output, render::obj_text(model, *posed->rig, state, model.name)));
}

}  // namespace raks::apps
