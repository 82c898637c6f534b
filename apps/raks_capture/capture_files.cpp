#include "apps/raks_capture/capture_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/suggest.hpp"
#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "motion/capture/solving/body_file.hpp"

namespace raks::apps {
namespace {

constexpr std::size_t kLargestTable = std::size_t{1} << 30U;  // bytes

// The text of a file that a step makes; `step` is named where it is missing.
Expected<std::string> made_by(const std::filesystem::path& file, const char* step) {
    if (!is_there(file)) {
        return fail(
            fmt::format("{}: is not there; run raks capture {} first", file.string(), step));
    }
    return read_text_file(file, kLargestTable);
}

// What a table says; nothing where there is none.
template <typename Row>
Expected<std::vector<Row>> read_if_made(const std::filesystem::path& file,
                                        Expected<std::vector<Row>> (*read)(std::string_view,
                                                                           const std::string&)) {
    if (!is_there(file)) {
        return std::vector<Row>{};
    }
    const Expected<std::string> text = read_text_file(file, kLargestTable);
    return text ? read(*text, file.string()) : fail(text.error());
}

}  // namespace

Expected<capture::Rig> load_capture_rig(const CapturePlan& plan) {
    const std::filesystem::path file = plan.file("rig.toml");
    const Expected<std::string> text = made_by(file, "calibrate");
    if (!text) {
        return fail(text.error());
    }
    auto read = capture::parse_rig(*text, file.string());
    if (!read) {
        return fail(std::move(read.error()));
    }
    for (const std::string& note : read->notes) {
        say(file.string() + ": " + note);
    }
    for (const std::string& doubt : capture::rig_doubts(read->rig)) {
        say(file.string() + ": " + doubt);
    }
    if (read->rig.floor == capture::FloorOrigin::feet) {
        say(file.string() + ": the floor is guessed from the dancer's feet");
    }
    return std::move(read->rig);
}

Expected<std::vector<capture::Clock>> load_clocks(const CapturePlan& plan) {
    const std::filesystem::path file = plan.file("clocks.toml");
    const Expected<std::string> text = made_by(file, "sync");
    auto clocks = text ? capture::read_clocks(*text, file.string()) : fail(text.error());
    if (!clocks) {
        return clocks;
    }
    constexpr double kMostDrift = 500.0;  // ppm: no clock is worse
    for (const capture::Clock& clock : *clocks) {
        if (std::abs(clock.drift_ppm) > kMostDrift) {
            say(fmt::format(
                "{}: the clock of camera {} drifts by {:.0f} ppm: is its film of another rate than "
                "it says?",
                file.string(),
                clock.camera,
                clock.drift_ppm));
        }
    }
    return clocks;
}

Expected<capture::Observations> load_observations(const CapturePlan& plan) {
    const std::filesystem::path file = plan.file("detections.csv");
    const Expected<std::string> text = made_by(file, "track");
    return text ? capture::read_observations(*text, file.string()) : fail(text.error());
}

Expected<std::vector<capture::MarkerLabel>> load_labels(const std::filesystem::path& file) {
    const Expected<std::string> text = made_by(file, "label");
    return text ? capture::read_labels(*text, file.string()) : fail(text.error());
}

Expected<std::vector<capture::Edit>> load_edits(const CapturePlan& plan) {
    return read_if_made(plan.file("edits.jsonl"), &capture::read_edits);
}

Expected<std::vector<capture::CameraMove>> load_moves(const CapturePlan& plan) {
    return read_if_made(plan.file("moved.tsv"), &capture::read_moves);
}

Expected<capture::BodyModel> load_body(const CapturePlan& plan, const std::string& told) {
    const std::string& body = told.empty() ? plan.body : told;
    if (body == "dance" || body == "paper") {
        return capture::BodyModel(body == "paper" ? capture::BodyKind::paper
                                                  : capture::BodyKind::dance);
    }
    if (!body.ends_with(".toml")) {
        constexpr std::array<std::string_view, 2> kBodies = {"dance", "paper"};
        return fail(unknown_name("body", body, kBodies) + ", or name a file of joints, X.toml");
    }
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    const std::filesystem::path file = told.empty() ? plan.file(body) : std::filesystem::path(told);
    const Expected<std::string> text = read_text_file(file, kMostBytes);
    return text ? capture::read_body_model(*text, file.string()) : fail(text.error());
}

Expected<std::optional<capture::AngleTrack>> load_angle_track(const CapturePlan& plan,
                                                              const capture::BodyModel& body) {
    const std::filesystem::path file = plan.file("angles.csv");
    if (!is_there(file)) {
        return std::optional<capture::AngleTrack>();
    }
    const Expected<std::string> text = read_text_file(file, kLargestTable);
    if (!text) {
        return fail(text.error());
    }
    if (!capture::is_of_body(*text, body)) {
        return std::optional<capture::AngleTrack>();
    }
    auto angles = capture::read_angles(*text, file.string(), body);
    return angles ? Expected<std::optional<capture::AngleTrack>>(std::move(*angles))
                  : fail(std::move(angles.error()));
}

Expected<std::vector<capture::BodyState>> load_angles(const CapturePlan& plan,
                                                      const capture::BodyModel& body) {
    auto track = load_angle_track(plan, body);
    if (!track) {
        return fail(std::move(track.error()));
    }
    if (!*track && is_there(plan.file("angles.csv"))) {
        say(plan.file("angles.csv").string() + ": is of another body; postures are found anew");
    }
    return *track ? std::move((*track)->states) : std::vector<capture::BodyState>{};
}

Expected<capture::Tracks> load_tracks(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "tracks.csv";
    const Expected<std::string> text = made_by(file, "track");
    auto tracks = text ? capture::read_tracks(*text, file.string()) : fail(text.error());
    const std::filesystem::path flags = folder / "flags.tsv";
    if (tracks && is_there(flags)) {
        const Expected<std::string> table = read_text_file(flags, kLargestTable);
        const Expected<void> read =
            table ? capture::read_flags(*table, flags.string(), *tracks) : fail(table.error());
        if (!read) {
            return fail(read.error());
        }
    }
    return tracks;
}

}  // namespace raks::apps
