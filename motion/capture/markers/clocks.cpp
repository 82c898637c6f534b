// The clocks of the cameras as a file.
#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "motion/capture/markers/observations.hpp"

namespace raks::capture {
namespace {

constexpr std::string_view kClocksFormat = "raks-clocks";

Clock read_clock(const toml::table& table,
                 const std::vector<Clock>& clocks,
                 TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {
        "camera", "offset", "drift_ppm", "confidence"};
    constexpr double kLongestOffset = 86400.0;
    constexpr double kLargestDrift = 5000.0;
    complaints.check_keys(table, kKeys);
    Clock clock;
    clock.camera = complaints.text(table, "camera");
    if (clock.camera.empty()) {
        complaints.complain(table, "needs camera = \"NAME\"");
    }
    if (std::any_of(clocks.begin(), clocks.end(), [&](const Clock& other) {
            return other.camera == clock.camera;
        })) {
        complaints.complain(table, fmt::format("camera \"{}\" has two clocks", clock.camera));
    }
    if (const toml::node* const offset = complaints.needed(table, "offset", "offset = SECONDS")) {
        clock.offset = complaints.number(*offset, "offset", {-kLongestOffset, kLongestOffset});
    }
    complaints.read(table, "drift_ppm", {-kLargestDrift, kLargestDrift}, clock.drift_ppm);
    complaints.read(table, "confidence", {0.0, 1.0}, clock.confidence);
    return clock;
}

}  // namespace

double common_start(const std::vector<Clock>& clocks) noexcept {
    double start = clocks.empty() ? 0.0 : clocks.front().capture_time(0.0);
    for (const Clock& clock : clocks) {
        start = std::max(start, clock.capture_time(0.0));
    }
    return start;
}

std::string clocks_text(const std::vector<Clock>& clocks) {
    std::string text = fmt::format(
        "# capture time = offset + (1 + drift_ppm / 1e6) * camera time, seconds\n"
        "format = \"{}\"\nversion = 1\n",
        kClocksFormat);
    for (const Clock& clock : clocks) {
        text +=
            fmt::format("\n[[clock]]\ncamera = {}\noffset = {}\ndrift_ppm = {}\nconfidence = {}\n",
                        toml_quoted(clock.camera),
                        clock.offset + 0.0,  // no -0, which would be read as a whole number
                        clock.drift_ppm + 0.0,
                        clock.confidence + 0.0);
    }
    return text;
}

Expected<std::vector<Clock>> read_clocks(std::string_view text, const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    constexpr std::array<std::string_view, 3> kKeys = {"format", "version", "clock"};
    complaints.check_keys(*root, kKeys);
    complaints.check_head(*root, kClocksFormat, 1);
    std::vector<Clock> clocks;
    const toml::array* const tables = (*root)["clock"].as_array();
    if (tables != nullptr && !tables->empty()) {
        for (const toml::node& node : *tables) {
            if (const toml::table* const table = node.as_table()) {
                clocks.push_back(read_clock(*table, clocks, complaints));
            } else {
                complaints.complain(node, "a clock must be a table [[clock]]");
            }
        }
    } else {
        complaints.complain("needs [[clock]] with camera and offset");
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return clocks;
}

}  // namespace raks::capture
