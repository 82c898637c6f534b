#include "apps/raks/stick_pair.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/raks/stick_film.hpp"
#include "apps/raks/stick_points.hpp"
#include "apps/terminal/say.hpp"
#include "base/json.hpp"
#include "base/printable.hpp"
#include "motion/evaluate/point_alignment.hpp"
#include "motion/evaluate/point_comparison.hpp"
#include "render/scene/point_body.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr double kMillimetres = 1000.0;

motion::PointAlignment alignment_of(const std::string& name) {
    if (name == "rigid") {
        return motion::PointAlignment::rigid;
    }
    if (name == "hips") {
        return motion::PointAlignment::hips;
    }
    return name == "both" ? motion::PointAlignment::both : motion::PointAlignment::none;
}

// What joints and points have in common: places by name. Skeletons bring their own edges.
Expected<JoinedPoints> points_of(const StickArguments& arguments,
                                 const std::string& name,
                                 motion::MotionFile file) {
    if (const auto* const clip = std::get_if<motion::MotionClip>(&file)) {
        return JoinedPoints{motion::joint_points(*clip, arguments.body.options()), false};
    }
    return join_points(arguments, name, std::move(std::get<motion::PointClip>(file)));
}

std::string table_of(const motion::PointComparison& comparison) {
    std::string text = fmt::format(
        "{:<24} {:>9} {:>9} {:>9} {:>9}\n", "point", "RMS mm", "worst mm", "at frame", "frames");
    for (const motion::PointDistance& point : comparison.points) {
        text += point.frames == 0
                    ? fmt::format("{:<24} never seen in both\n", printable(point.name, 60))
                    : fmt::format("{:<24} {:>9.1f} {:>9.1f} {:>9} {:>9}\n",
                                  printable(point.name, 60),
                                  kMillimetres * point.rms,
                                  kMillimetres * point.worst,
                                  point.worst_frame,
                                  point.frames);
    }
    const motion::PointDistance& worst = comparison.points[comparison.worst_point];
    return text +
           fmt::format(
               "all: RMS {:.1f} mm over {} frames; worst point {}: {:.1f} mm; worst frame {}: "
               "{:.1f} mm\n",
               kMillimetres * comparison.rms,
               comparison.frames,
               printable(worst.name, 60),
               kMillimetres * worst.rms,
               comparison.worst_frame,
               kMillimetres * comparison.worst_frame_rms);
}

// Numbers by frame; null where nothing was seen.
Json over_time(const std::vector<float>& values) {
    auto list = Json::array();
    for (const float value : values) {
        if (std::isnan(value)) {
            list.push_back(nullptr);
        } else {
            list.push_back(std::round(static_cast<double>(value) * 1e6) / 1e6);
        }
    }
    return list;
}

std::string comparison_document(const StickArguments& arguments,
                                const motion::PointComparison& comparison) {
    Json points = Json::array();
    for (const motion::PointDistance& point : comparison.points) {
        Json row = {{"name", printable(point.name)}, {"frames", point.frames}};
        if (point.frames > 0) {
            row["rms"] = point.rms;
            row["worst"] = point.worst;
            row["worst_frame"] = point.worst_frame;
            row["distance"] = over_time(point.over_time);
        }
        points.push_back(std::move(row));
    }
    const Json document = {
        {"format", "raks-point-comparison"},
        {"version", 1},
        {"one", printable(arguments.input.string())},
        {"other", printable(arguments.other.string())},
        {"align", arguments.align},
        {"rms", comparison.rms},
        {"frames", comparison.frames},
        {"worst_point", printable(comparison.points[comparison.worst_point].name)},
        {"worst_frame", comparison.worst_frame},
        {"worst_frame_rms", comparison.worst_frame_rms},
        {"rms_by_frame", over_time(comparison.rms_over_time)},
        {"points", points}};
    return document.text(1) + "\n";
}

// The curve over the bar: the worst frame is as high as it goes.
engine::ClipHighlight highlight_of(const motion::PointComparison& comparison) {
    engine::ClipHighlight highlight{comparison.worst_frame, "worst", comparison.rms_over_time};
    const auto highest = static_cast<float>(std::max(comparison.worst_frame_rms, 1e-9));
    for (float& value : highlight.curve) {
        value /= highest;
    }
    return highlight;
}

// Both turned by what makes the first face us, as a single motion is.
void face_us(motion::WorldPoints& one, motion::WorldPoints& other) {
    const double facing = motion::facing_of(one);
    for (motion::WorldPoints* const points : {&one, &other}) {
        motion::turn_about_y(*points, -facing);
    }
}

// What tells two files apart: their folders too where their own names do not.
std::pair<std::string, std::string> names_of(const StickArguments& arguments) {
    const std::filesystem::path& one = arguments.input;
    const std::filesystem::path& other = arguments.other;
    if (one.filename() != other.filename()) {
        return {one.filename().string(), other.filename().string()};
    }
    const auto with_folder = [](const std::filesystem::path& file) {
        return (file.parent_path().filename() / file.filename()).string();
    };
    return {with_folder(one), with_folder(other)};
}

Expected<void> show_pair(const StickArguments& arguments,
                         motion::WorldPoints one,
                         motion::WorldPoints other,
                         const motion::PointComparison& comparison) {
    const auto [name, other_name] = names_of(arguments);
    const ShownClip shown{
        name + " and " + other_name,
        one.clip.frame_count,
        one.clip.frames_per_second,
        highlight_of(comparison),
        {{name, render::StickPart::left}, {other_name, render::StickPart::right}}};
    face_us(one, other);
    std::vector<motion::WorldPoints> motions;
    motions.push_back(std::move(one));
    motions.push_back(std::move(other));
    const auto recorded =
        render::PointBodies::create(std::move(motions),
                                    arguments.is_side_by_side ? render::Arrangement::side_by_side
                                                              : render::Arrangement::overlaid);
    if (!recorded) {
        return fail(shown.name + ": " + recorded.error().message);
    }
    return show_recorded(arguments, shown, *recorded);
}

}  // namespace

ExitCode stick_pair(const StickArguments& arguments,
                    motion::MotionFile one,
                    motion::MotionFile other) {
    const bool has_points = std::holds_alternative<motion::PointClip>(one) ||
                            std::holds_alternative<motion::PointClip>(other);
    if (!arguments.edges.empty() && !has_points) {
        return fail(
            "both motions have a hierarchy, which joins their joints; --edges is for points");
    }
    auto first = points_of(arguments, arguments.input.string(), std::move(one));
    if (!first) {
        return fail(std::move(first.error()));
    }
    auto second = points_of(arguments, arguments.other.string(), std::move(other));
    if (!second) {
        return fail(std::move(second.error()));
    }
    const std::string names = arguments.input.string() + " and " + arguments.other.string();
    const auto pairs = motion::common_points(first->points, second->points);
    motion::WorldPoints laid = motion::at_frames_of(first->points, second->points, arguments.shift);
    auto comparison = motion::compare_points(first->points, laid, pairs);
    if (comparison && arguments.align != "none") {
        if (auto aligned = motion::align(first->points, laid, pairs, alignment_of(arguments.align));
            !aligned) {
            return fail(std::move(aligned.error()).in(names));
        }
        comparison = motion::compare_points(first->points, laid, pairs);
    }
    if (!comparison) {
        return fail(std::move(comparison.error()).in(names));
    }
    const int done = first->is_partly || second->is_partly ? kExitPartly : kExitDone;
    if (arguments.as_json) {
        print_json(comparison_document(arguments, *comparison));
        return done;
    }
    print_text(table_of(*comparison));
    if (auto shown = show_pair(arguments, std::move(first->points), std::move(laid), *comparison);
        !shown) {
        return fail(std::move(shown.error()));
    }
    return done;
}

}  // namespace raks::apps
