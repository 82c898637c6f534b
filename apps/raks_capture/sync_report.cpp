#include "apps/raks_capture/sync_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/printable.hpp"
#include "base/toml_reader.hpp"

namespace raks::apps {
namespace {

// How a camera's clock came about, for people.
std::string origin_of(const CameraSync& camera) {
    if (!camera.clock) {
        return "not known";
    }
    if (camera.is_by_hand) {
        return "set by hand";
    }
    if (camera.is_by_motion) {
        return "by what moves";
    }
    if (camera.through.empty()) {
        return "the capture's clock";
    }
    if (camera.compared == 0) {
        return "told by " + printable(camera.through, 60);
    }
    return fmt::format("{} of {} stretches agree with {}",
                       camera.used,
                       camera.compared,
                       printable(camera.through, 60));
}

// Without the minus sign of what rounds to 0.
double shown(double seconds) { return std::abs(seconds) < 5e-5 ? 0.0 : seconds; }

nlohmann::json number_or_null(bool is_known, double number) {
    return is_known ? nlohmann::json(number) : nlohmann::json();
}

}  // namespace

std::string sync_table(const SyncResult& result, const SyncPlan& plan) {
    std::size_t width = 6;
    for (const CameraSync& camera : result.cameras) {
        width = std::max(width, printable(camera.camera, 40).size());
    }
    std::string text = fmt::format(
        "{:<{}} {:>10} {:>9} {:>10}\n", "camera", width, "offset s", "drift ppm", "confidence");
    for (const CameraSync& camera : result.cameras) {
        const std::string name = printable(camera.camera, 40);
        if (camera.clock) {
            text += fmt::format(
                "{:<{}} {:>10.4f} {:>9.1f} {:>10.2f}  {}\n",
                name,
                width,
                shown(camera.clock->offset),
                std::abs(camera.clock->drift_ppm) < 0.05 ? 0.0 : camera.clock->drift_ppm,
                camera.clock->confidence,
                origin_of(camera));
        } else {
            text += fmt::format(
                "{:<{}} {:>10} {:>9} {:>10}  {}\n", name, width, "-", "-", "-", origin_of(camera));
        }
    }
    if (result.song) {
        const double start = plan.start.value_or(0.0);
        text += fmt::format(
            "{} begins at {:.4f} s (confidence {:.2f}): a dance that begins at {:.4f} s has "
            "--offset {:.4f}\n",
            printable(plan.music->string(), 200),
            shown(result.song->line.offset),
            result.song->confidence,
            start,
            shown(result.song->song_time(start)));
    }
    return text;
}

std::string sync_json(const SyncResult& result, const SyncPlan& plan) {
    nlohmann::json document = {{"format", "raks-sync"}, {"version", 1}};
    document["cameras"] = nlohmann::json::array();
    for (std::size_t i = 0; i < result.cameras.size(); ++i) {
        const CameraSync& camera = result.cameras[i];
        const bool is_known = camera.clock.has_value();
        const capture::Clock clock = camera.clock.value_or(capture::Clock{});
        document["cameras"].push_back(
            {{"camera", camera.camera},
             {"file", plan.cameras[i].file.string()},
             {"offset", number_or_null(is_known, clock.offset)},
             {"drift_ppm", number_or_null(is_known, clock.drift_ppm)},
             {"confidence", number_or_null(is_known, clock.confidence)},
             {"by_hand", camera.is_by_hand},
             {"by_motion", camera.is_by_motion},
             {"through",
              camera.through.empty() ? nlohmann::json() : nlohmann::json(camera.through)},
             {"windows_used", camera.used},
             {"windows", camera.compared},
             {"disagreement", camera.disagreement}});
    }
    document["music"] = nlohmann::json();
    if (result.song) {
        document["music"] = {{"file", plan.music->string()},
                             {"begins", result.song->line.offset},
                             {"drift_ppm", result.song->line.drift_ppm},
                             {"confidence", result.song->confidence},
                             {"start", plan.start.value_or(0.0)},
                             {"offset", result.song->song_time(plan.start.value_or(0.0))}};
    }
    document["warnings"] = result.warnings;
    return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string music_text(const SongSync& clock, const SyncPlan& plan) {
    return fmt::format(
        "# capture time = begins + (1 + drift_ppm / 1e6) * the song's time, seconds\n"
        "# offset: seconds of the song at capture time 0\n"
        "format = \"raks-music\"\nversion = 1\n"
        "file = {}\nbegins = {}\ndrift_ppm = {}\nconfidence = {}\noffset = {}\n",
        toml_quoted(plan.music->string()),
        clock.line.offset + 0.0,  // no -0, which would be read as a whole number
        clock.line.drift_ppm + 0.0,
        clock.confidence + 0.0,
        clock.song_time(0.0) + 0.0);
}

Expected<SongSync> read_music(std::string_view text, const std::string& file) {
    constexpr std::array<std::string_view, 7> kKeys = {
        "format", "version", "file", "begins", "drift_ppm", "confidence", "offset"};
    constexpr double kLongestWait = 86400.0;  // seconds
    constexpr double kMostDrift = 5000.0;     // ppm
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    complaints.check_head(*root, "raks-music", 1);
    complaints.check_keys(*root, kKeys);
    SongSync song;
    song.confidence = 1.0;
    if (const toml::node* const begins = complaints.needed(*root, "begins", "begins = SECONDS")) {
        song.line.offset = complaints.number(*begins, "begins", {-kLongestWait, kLongestWait});
    }
    complaints.read(*root, "drift_ppm", {-kMostDrift, kMostDrift}, song.line.drift_ppm);
    complaints.read(*root, "confidence", {0.0, 1.0}, song.confidence);
    return complaints.is_sound() ? Expected<SongSync>(song) : fail(complaints.fault());
}

}  // namespace raks::apps
