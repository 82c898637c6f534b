// `raks capture simulate`: the test studio.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks_capture/commands.hpp"
#include "apps/raks_capture/drawn_films.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/formats/bvh.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

/// Arguments of `raks capture simulate`.
struct SimulateArguments {
    Path motion;
    Path output;
    Path rig;      ///< empty: the studio's
    Path markers;  ///< empty: the shipped set
    bool points = false;
    bool is_draft = false;  ///< of the films
    Path music;             ///< that sounds in the room; empty: none
    bool unique = false;    ///< each marker has a colour of its own
    int cameras = 6;        ///< of the studio's rig
    double fps = 0.0;       ///< of the motion; 0: the file's
    double rate = 0.0;      ///< of the cameras; 0: the motion's
    double seconds = 0.0;   ///< of the motion to film; 0: all
    double tempo = 1.0;     ///< how much faster than recorded the dance is danced
    capture::StudioOptions studio;
    BodyArguments body;
};

/// The motion on the mannequin.
struct FilmedMotion {
    std::vector<motion::Pose> poses;
    double frames_per_second = 0.0;
};

// The fastest of the ends of the limbs between two frames; metres a second.
double fastest_end(const FilmedMotion& filmed, std::size_t frame) {
    using motion::Bone;
    const auto& skeleton = motion::mannequin_skeleton();
    const motion::WorldPose before = motion::world_pose(skeleton, filmed.poses[frame - 1]);
    const motion::WorldPose after = motion::world_pose(skeleton, filmed.poses[frame]);
    double farthest = 0.0;
    for (const Bone bone :
         {Bone::left_hand, Bone::right_hand, Bone::left_foot, Bone::right_foot, Bone::head}) {
        farthest = std::max(
            farthest,
            static_cast<double>(glm::distance(after.position(bone), before.position(bone))));
    }
    return farthest * filmed.frames_per_second;
}

// Many recordings begin with a T-pose that the dance leaves by a jump within a few frames, which no
// dancer makes and no camera could follow: the pose behind it is held in its place.
void hold_before_jump(FilmedMotion& filmed) {
    constexpr double kLongest = 0.5;      // seconds
    constexpr double kFastestHand = 7.0;  // metres a second
    const auto last = std::min(filmed.poses.size() - 1,
                               static_cast<std::size_t>(kLongest * filmed.frames_per_second));
    std::size_t jump = 0;
    for (std::size_t frame = 1; frame <= last; ++frame) {
        jump = fastest_end(filmed, frame) > kFastestHand ? frame : jump;
    }
    std::fill_n(filmed.poses.begin(), jump, filmed.poses[jump]);
}

Expected<FilmedMotion> read_filmed_motion(const SimulateArguments& arguments) {
    auto clip = motion::read_skeleton_motion(arguments.motion, clip_reading(arguments.fps));
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    motion::RetargetOptions options;
    options.body = arguments.body.options();
    auto danced = motion::retarget(*clip, motion::mannequin_skeleton(), options);
    if (!danced) {
        return fail(std::move(danced.error()).in(arguments.motion.string()));
    }
    FilmedMotion filmed{std::move(danced->poses), danced->frames_per_second * arguments.tempo};
    hold_before_jump(filmed);
    if (arguments.seconds > 0.0) {
        const auto count =
            static_cast<std::size_t>(arguments.seconds * filmed.frames_per_second) + 1;
        filmed.poses.resize(std::min(filmed.poses.size(), count));
    }
    return filmed;
}

Expected<capture::Rig> studio_rig_of(const SimulateArguments& arguments) {
    if (arguments.rig.empty()) {
        return capture::studio_rig(arguments.cameras);
    }
    auto file = capture::read_rig(arguments.rig);
    if (!file) {
        return fail(std::move(file.error()));
    }
    for (const std::string& note : file->notes) {
        say(arguments.rig.string() + ": " + note);
    }
    for (const std::string& doubt : capture::rig_doubts(file->rig)) {
        say(arguments.rig.string() + ": " + doubt);
    }
    return std::move(file->rig);
}

Expected<capture::MarkerSet> markers_of(const SimulateArguments& arguments) {
    if (arguments.markers.empty()) {
        return capture::default_markers(arguments.unique ? capture::MarkerColours::unique
                                                         : capture::MarkerColours::five);
    }
    CapturePlan plan;
    plan.markers = std::filesystem::absolute(arguments.markers);
    return load_markers(plan);
}

// What sounds in the room, as the films want it.
Expected<std::vector<float>> music_of(const SimulateArguments& arguments) {
    constexpr int kFilmRate = 48'000;
    if (arguments.music.empty()) {
        return std::vector<float>{};
    }
    auto music = audio::read_all_mono(arguments.music);
    if (!music) {
        return fail(std::move(music.error()));
    }
    if (music->rate.hertz() != kFilmRate) {
        return fail(
            fmt::format("{}: has {} Hz, must have 48000: convert it with ffmpeg -i {} -ar "
                        "48000 NEW.wav",
                        arguments.music.string(),
                        music->rate.hertz(),
                        arguments.music.filename().string()));
    }
    return std::move(music->samples);
}

std::string film_name(const capture::Camera& camera) { return camera.name + ".mp4"; }

// The films of all cameras, into the capture's folder.
Expected<void> draw_take(const SimulateArguments& arguments,
                         const Path& folder,
                         const capture::StudioTake& take,
                         const capture::StudioMotion& motion,
                         const capture::Rig& rig,
                         const capture::MarkerSet& markers) {
    const auto music = music_of(arguments);
    if (!music) {
        return fail(music.error());
    }
    ProgressLine progress("drawing films");
    DrawnFilmOptions options;
    options.frames_per_second = take.truth.frames_per_second;
    options.is_draft = arguments.is_draft;
    options.music = *music;
    options.seed = arguments.studio.seed;
    options.tell_progress = [&](std::size_t camera, std::size_t done, std::size_t all) {
        progress.show(
            (static_cast<double>(camera) + static_cast<double>(done) / static_cast<double>(all)) /
            static_cast<double>(rig.cameras.size()));
    };
    options.is_stop_requested = [] { return stop_signal().has_value(); };
    const auto films = draw_films(motion, rig, markers, take.clocks, folder, options);
    return films ? Expected<void>{} : fail(films.error());
}

CapturePlan plan_of(const capture::Rig& rig, double frames_per_second, bool has_films) {
    CapturePlan plan;
    plan.height = 1.714;  // the mannequin's
    plan.markers = "markers.toml";
    plan.frames_per_second = frames_per_second;
    plan.start = 0.0;
    for (const capture::Camera& camera : rig.cameras) {
        plan.cameras.push_back(
            {camera.name, has_films ? Path(film_name(camera)) : Path(), {}, 0.0});
    }
    return plan;
}

// The clocks that the capture is given: what a synchronisation by sound would leave open stays
// unknown, so the offsets are those of the plan, nought.
std::vector<capture::Clock> assumed_clocks(const std::vector<capture::Clock>& clocks) {
    std::vector<capture::Clock> assumed = clocks;
    for (capture::Clock& clock : assumed) {
        clock.offset = 0.0;
        clock.drift_ppm = 0.0;
    }
    return assumed;
}

Expected<void> write_take(const Path& folder,
                          const capture::StudioTake& take,
                          const capture::Rig& rig,
                          const capture::MarkerSet& markers,
                          const FilmedMotion& filmed,
                          bool has_films) {
    const double rate = take.truth.frames_per_second;
    const std::pair<const char*, std::string> files[] = {
        {"capture.toml", capture_plan_text(plan_of(rig, rate, has_films))},
        {"markers.toml", capture::marker_set_text(markers)},
        {"rig.toml", capture::rig_text(rig)},
        {"clocks.toml", capture::clocks_text(assumed_clocks(take.clocks))},
        {"labels.tsv", capture::labels_text(take.labels)},
        // Of films it is to be found, and what would have been is true.
        {has_films ? "truth/detections.csv" : "detections.csv",
         capture::observations_text(take.seen)},
        {"truth/clocks.toml", capture::clocks_text(take.clocks)},
        {"truth/tracks.csv", capture::tracks_text(take.truth)},
        {"truth/rig.toml", capture::rig_text(rig)},
    };
    std::filesystem::create_directory(folder / "truth");
    for (const auto& [name, text] : files) {
        if (auto written = write_file(folder / name, text); !written) {
            return written;
        }
    }
    std::vector<motion::Pose> poses;
    for (std::size_t i = 0; i < take.truth.frame_count; ++i) {
        poses.push_back(
            motion::pose_between(filmed.poses, take.truth.time_of(i) * filmed.frames_per_second));
    }
    return motion::write_bvh(folder / "truth/dance.bvh", motion::mannequin_skeleton(), poses, rate);
}

// The error to expect from where the cameras stand, by the formula, with as many views as see a
// marker on average.
std::string expectation(const capture::Rig& rig,
                        const capture::StudioTake& take,
                        const capture::StudioOptions& options) {
    double views = 0.0;
    for (const capture::MarkerPlace& place : take.truth.places) {
        views += place.views;
    }
    views /= static_cast<double>(take.truth.places.size());
    double distance = 0.0;
    double f = 0.0;
    for (const capture::Camera& camera : rig.cameras) {
        distance += camera.in_camera({0.0, 0.95, 0.0}).z / static_cast<double>(rig.cameras.size());
        f += camera.lens.fx / static_cast<double>(rig.cameras.size());
    }
    return fmt::format(
        "{} cameras, {} frames; a marker is seen by {:.1f} of them, so that {:.1f} mm are to be "
        "expected (RMS, {:.1f} px)",
        rig.cameras.size(),
        take.truth.frame_count,
        views,
        1000.0 * capture::expected_error(distance, f, options.noise, std::max(views, 1.0)),
        options.noise);
}

ExitCode simulate(const SimulateArguments& arguments) {
    const auto rig = studio_rig_of(arguments);
    const auto markers = markers_of(arguments);
    if (!rig || !markers) {
        return fail(rig ? markers.error() : rig.error());
    }
    const auto filmed = read_filmed_motion(arguments);
    if (!filmed) {
        return fail(filmed.error());
    }
    capture::StudioOptions options = arguments.studio;
    options.frames_per_second = arguments.rate > 0.0 ? arguments.rate : filmed->frames_per_second;
    const capture::StudioMotion motion{
        motion::mannequin_skeleton(), filmed->poses, filmed->frames_per_second};
    const capture::StudioTake take = capture::film_points(motion, *rig, *markers, options);
    auto folder = PendingFile::create_folder(arguments.output);
    if (!folder) {
        return fail(std::move(folder.error()));
    }
    if (auto written = write_take(folder->part(), take, *rig, *markers, *filmed, !arguments.points);
        !written) {
        return fail(std::move(written.error()));
    }
    if (!arguments.points) {
        if (auto drawn = draw_take(arguments, folder->part(), take, motion, *rig, *markers);
            !drawn) {
            return stop_signal() ? ExitCode(exit_code_after_signals(kExitDone))
                                 : fail(std::move(drawn.error()));
        }
    }
    if (auto done = folder->commit(); !done) {
        return fail(std::move(done.error()));
    }
    say(expectation(*rig, take, options));
    return kExitDone;
}

}  // namespace

void add_simulate(CommandTable& table) {
    const auto [app, arguments] = table.add<SimulateArguments>(
        table.app(), "simulate", "film a known dance with cameras that there are not", &simulate);
    app->add_option("motion", arguments->motion, "motion file")->required();
    app->add_option("-o,--out", arguments->output, "folder to make")->required();
    app->add_flag("--points", arguments->points, "points in pictures, without the pictures");
    app->add_flag("--draft", arguments->is_draft, "draw films at single size, without blur");
    app->add_option("--music", arguments->music, "what sounds in the films; 48,000 Hz");
    app->add_option("--rig", arguments->rig, "cameras (TOML); without: a ring of 4 m");
    app->add_option("--cameras", arguments->cameras, "how many the ring has")
        ->check(in_range(2, 32));
    app->add_option("--markers", arguments->markers, "marker set (TOML)");
    app->add_flag("--unique", arguments->unique, "give each marker a colour of its own");
    app->add_option("--fps", arguments->fps, "frames a second of the motion")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--rate", arguments->rate, "pictures a second of the cameras")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--tempo", arguments->tempo, "danced so many times as fast")
        ->check(in_range(0.1, 10.0));
    app->add_option("--duration", arguments->seconds, "seconds to film")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
    app->add_option("--noise", arguments->studio.noise, "of a point, pixels")
        ->check(in_range(0.0, 20.0));
    app->add_option("--drop", arguments->studio.drop, "share of the points that is missed")
        ->check(in_range(0.0, 1.0));
    app->add_option("--clutter", arguments->studio.clutter, "false points in each picture")
        ->check(in_range(0, 1000));
    app->add_option("--clock-error", arguments->studio.clock_error, "of each camera, seconds")
        ->check(in_range(0.0, 60.0));
    app->add_option("--drift", arguments->studio.drift_ppm, "of each clock, parts in a million")
        ->check(in_range(0.0, 1000.0));
    app->add_option("--seed", arguments->studio.seed, "of all that is drawn");
    add_body_options(*app, arguments->body);
}

}  // namespace raks::apps
