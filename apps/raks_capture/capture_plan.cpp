#include "apps/raks_capture/capture_plan.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/file.hpp"
#include "base/plain_name.hpp"

namespace raks::apps {
namespace {

constexpr std::string_view kPlanFormat = "raks-capture";
constexpr std::size_t kMostCameras = 100;

void read_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 11> kKeys = {"format",
                                                        "version",
                                                        "height",
                                                        "body",
                                                        "method",
                                                        "music",
                                                        "markers",
                                                        "frames_per_second",
                                                        "start",
                                                        "board",
                                                        "camera"};
    complaints.check_keys(root, kKeys);
    complaints.check_head(root, kPlanFormat, 1);
}

capture::Board read_board(const toml::table& table, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 7> kKeys = {
        "kind", "columns", "rows", "square", "marker", "dictionary", "inverted"};
    constexpr std::array<std::string_view, 2> kKinds = {"charuco", "chessboard"};
    complaints.check_keys(table, kKeys);
    capture::Board board;
    if (const toml::node* const kind = table.get("kind")) {
        board.kind = complaints.word(*kind, "kind", kKinds) == 0 ? capture::BoardKind::charuco
                                                                 : capture::BoardKind::chessboard;
    }
    for (const auto& [key, target] :
         {std::pair("columns", &board.columns), std::pair("rows", &board.rows)}) {
        if (const toml::node* const node = table.get(key)) {
            *target = complaints.whole(*node, key, {3, 100});
        }
    }
    complaints.read(table, "square", {0.001, 2.0}, board.square);
    complaints.read(table, "marker", {0.001, 2.0}, board.marker);
    if (std::string name = complaints.text(table, "dictionary"); !name.empty()) {
        board.dictionary = std::move(name);
    }
    board.is_inverted = table["inverted"].value_or(false);
    if (const Expected<void> checked = capture::check_board(board); !checked) {
        complaints.complain(table, checked.error().message);
    }
    return board;
}

PlannedCamera read_camera(const toml::table& table,
                          const std::vector<PlannedCamera>& others,
                          TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {
        "name", "film", "calibration", "loudspeaker"};
    complaints.check_keys(table, kKeys);
    PlannedCamera camera;
    camera.name = complaints.text(table, "name");
    if (!is_plain_name(camera.name) || camera.name.find_first_of(",\t\"") != std::string::npos) {
        complaints.complain(table, "needs name = \"left\" or another short text without commas");
    }
    if (std::any_of(others.begin(), others.end(), [&](const PlannedCamera& other) {
            return other.name == camera.name;
        })) {
        complaints.complain(table, fmt::format("two cameras are called \"{}\"", camera.name));
    }
    camera.film = complaints.text(table, "film");
    camera.calibration = complaints.text(table, "calibration");
    complaints.read(table, "loudspeaker", {0.0, 100.0}, camera.loudspeaker);
    return camera;
}

void read_cameras(const toml::table& root, CapturePlan& plan, TomlComplaints& complaints) {
    const toml::array* const cameras = root["camera"].as_array();
    if (cameras == nullptr || cameras->empty() || cameras->size() > kMostCameras) {
        complaints.complain(
            fmt::format("needs [[camera]] with name and film, 1 to {}", kMostCameras));
        return;
    }
    for (const toml::node& node : *cameras) {
        if (const toml::table* const table = node.as_table()) {
            plan.cameras.push_back(read_camera(*table, plan.cameras, complaints));
        } else {
            complaints.complain(node, "a camera must be a table [[camera]]");
        }
    }
}

void read_take(const toml::table& root, CapturePlan& plan, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 2> kBodies = {"dance", "paper"};
    constexpr std::string_view kFileEnd = ".toml";
    complaints.read(root, "height", {0.3, 3.0}, plan.height);
    if (const toml::node* const body = root.get("body")) {
        plan.body = complaints.text(root, "body");
        if (!plan.body.ends_with(kFileEnd)) {
            plan.body = kBodies[complaints.word(*body, "body", kBodies)];
        }
    }
    constexpr std::array<std::string_view, 3> kMethods = {"positions", "angles", "markerless"};
    if (const toml::node* const method = root.get("method")) {
        constexpr std::array kTold = {TrackingMethod::positions, TrackingMethod::angles};
        const std::size_t which = complaints.word(*method, "method", kMethods);
        plan.is_markerless = which >= kTold.size();
        plan.method = plan.is_markerless ? std::nullopt : std::optional(kTold[which]);
    }
    plan.music = complaints.text(root, "music");
    plan.markers = complaints.text(root, "markers");
    complaints.read(root, "frames_per_second", {1.0, 1000.0}, plan.frames_per_second);
    if (const toml::node* const start = root.get("start")) {
        plan.start = complaints.number(*start, "start", {-86400.0, 86400.0});
    }
}

std::string board_text(const capture::Board& board) {
    return fmt::format(
        "\n[board]\nkind = \"{}\"\ncolumns = {}\nrows = {}\nsquare = {}\nmarker = {}\n"
        "dictionary = {}\ninverted = {}\n",
        board.kind == capture::BoardKind::charuco ? "charuco" : "chessboard",
        board.columns,
        board.rows,
        board.square,
        board.marker,
        toml_quoted(board.dictionary),
        board.is_inverted);
}

}  // namespace

Expected<CapturePlan> parse_capture_plan(std::string_view text,
                                         const std::string& file,
                                         const std::filesystem::path& folder) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    CapturePlan plan;
    plan.folder = folder;
    read_head(*root, complaints);
    read_take(*root, plan, complaints);
    if (const toml::table* const board = (*root)["board"].as_table()) {
        plan.board = read_board(*board, complaints);
    }
    read_cameras(*root, plan, complaints);
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return plan;
}

Expected<CapturePlan> load_capture_plan(const std::filesystem::path& folder) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    const std::filesystem::path file = folder / "capture.toml";
    if (!is_there(file)) {
        return fail(fmt::format("{}: no capture: it has no capture.toml (raks capture --help)",
                                folder.string()));
    }
    const Expected<std::string> text = read_text_file(file, kMostBytes);
    if (!text) {
        return fail(text.error());
    }
    return parse_capture_plan(*text, file.string(), folder);
}

std::string capture_plan_text(const CapturePlan& plan) {
    std::string text = fmt::format("format = \"{}\"\nversion = 1\n", kPlanFormat);
    if (plan.height > 0.0) {
        text += fmt::format("height = {}\n", plan.height);
    }
    text += fmt::format("body = {}\n", toml_quoted(plan.body));
    if (plan.is_markerless) {
        text += "method = \"markerless\"\n";
    } else if (plan.method) {
        text += fmt::format("method = \"{}\"\n",
                            *plan.method == TrackingMethod::angles ? "angles" : "positions");
    }
    for (const auto& [key, path] :
         {std::pair("music", &plan.music), std::pair("markers", &plan.markers)}) {
        if (!path->empty()) {
            text += fmt::format("{} = {}\n", key, toml_quoted(path->string()));
        }
    }
    text += fmt::format("frames_per_second = {}\n", plan.frames_per_second);
    if (plan.start) {
        text += fmt::format("start = {}\n", *plan.start + 0.0);
    }
    text += board_text(plan.board);
    for (const PlannedCamera& camera : plan.cameras) {
        text += fmt::format("\n[[camera]]\nname = {}\n", toml_quoted(camera.name));
        for (const auto& [key, path] :
             {std::pair("film", &camera.film), std::pair("calibration", &camera.calibration)}) {
            if (!path->empty()) {
                text += fmt::format("{} = {}\n", key, toml_quoted(path->string()));
            }
        }
        if (camera.loudspeaker > 0.0) {
            text += fmt::format("loudspeaker = {}\n", camera.loudspeaker);
        }
    }
    return text;
}

bool is_body_followed(std::optional<TrackingMethod> said,
                      const capture::MarkerSet& markers,
                      std::size_t films) {
    // Salsa with five colours, each marker by itself: 51 % of the places are wrong with three
    // cameras, 8 % with four, and by a body 0.6 and 0.5 % (docs/measurements/capture.md).
    constexpr std::size_t kEnoughCameras = 5;
    constexpr std::ptrdiff_t kMarkersOfTrunk = 3;
    if (said) {
        return *said == TrackingMethod::angles;
    }
    using motion::Bone;
    const auto of_trunk = std::count_if(
        markers.markers.begin(), markers.markers.end(), [](const capture::Marker& marker) {
            return marker.bone == Bone::hips || marker.bone == Bone::spine ||
                   marker.bone == Bone::chest || marker.bone == Bone::upper_chest;
        });
    return films < kEnoughCameras && markers.colours().size() < markers.markers.size() &&
           of_trunk >= kMarkersOfTrunk;
}

std::string too_few_for_colours(const capture::MarkerSet& markers, std::size_t films) {
    // Salsa, two cameras 90 degrees apart: 39 % of the places are wrong by the body, too
    // (docs/measurements/capture.md).
    constexpr std::size_t kFewest = 3;
    const std::size_t colours = markers.colours().size();
    if (films >= kFewest || colours == markers.markers.size()) {
        return {};
    }
    return fmt::format(
        "{} cameras are too few to follow {} markers of {} colours: {} or more are "
        "needed",
        films,
        markers.markers.size(),
        colours,
        kFewest);
}

Expected<void> check_cameras(const CapturePlan& plan) {
    return plan.cameras.size() > 1
               ? Expected<void>{}
               : fail(fmt::format("{}: one camera is too few: where something is, two or more "
                                  "tell; film from two places and name both films",
                                  plan.file("capture.toml").string()));
}

std::vector<std::string> plan_names(const CapturePlan& plan) {
    std::vector<std::string> names;
    for (const PlannedCamera& camera : plan.cameras) {
        names.push_back(camera.name);
    }
    return names;
}

Expected<capture::MarkerSet> load_markers(const CapturePlan& plan) {
    if (plan.markers.empty()) {
        return capture::default_markers();
    }
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    const std::filesystem::path file = plan.file(plan.markers);
    const Expected<std::string> text = read_text_file(file, kMostBytes);
    return text ? capture::read_marker_set(*text, file.string()) : fail(text.error());
}

}  // namespace raks::apps
