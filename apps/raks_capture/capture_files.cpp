#include "apps/raks_capture/capture_files.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "motion/capture/camera/rig_file.hpp"

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
    return std::move(read->rig);
}

Expected<std::vector<capture::Clock>> load_clocks(const CapturePlan& plan) {
    const std::filesystem::path file = plan.file("clocks.toml");
    const Expected<std::string> text = made_by(file, "sync");
    return text ? capture::read_clocks(*text, file.string()) : fail(text.error());
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
    const std::filesystem::path file = plan.file("edits.jsonl");
    if (!is_there(file)) {
        return std::vector<capture::Edit>{};
    }
    const Expected<std::string> text = read_text_file(file, kLargestTable);
    return text ? capture::read_edits(*text, file.string()) : fail(text.error());
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
