#include "motion/capture/camera/rig_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "base/toml_reader.hpp"
#include "motion/capture/camera/easymocap_rig.hpp"
#include "motion/capture/camera/qualisys_rig.hpp"
#include "motion/capture/camera/rotation.hpp"

#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

constexpr NumberRange kAnyNumber{-1e12, 1e12};
constexpr NumberRange kPictureSize{1.0, 65'535.0};
constexpr std::size_t kMostCameras = 1000;

// A table of the file that holds a camera.
struct CameraTable {
    std::string key;    // "cam_0"; "0" where it stands in [cameras]
    bool is_in_list{};  // in [cameras]
    const toml::table* table = nullptr;
};

void add_camera_tables(const toml::table& all, bool is_in_list, std::vector<CameraTable>& found) {
    for (const auto& [key, value] : all) {
        const toml::table* const table = value.as_table();
        const bool is_called_so = is_in_list || key.str().starts_with("cam");
        if (table != nullptr && (table->contains("matrix") ||
                                 (is_called_so && key.str() != "cameras" && !table->empty()))) {
            found.push_back({std::string(key.str()), is_in_list, table});
        }
    }
}

// In the order of the file: the parser sorts by name, and cam_10 would come before cam_2.
std::vector<CameraTable> camera_tables(const toml::table& document) {
    std::vector<CameraTable> found;
    add_camera_tables(document, false, found);
    if (const toml::table* const list = document["cameras"].as_table()) {
        add_camera_tables(*list, true, found);
    }
    std::stable_sort(found.begin(), found.end(), [](const CameraTable& a, const CameraTable& b) {
        return a.table->source().begin.line < b.table->source().begin.line;
    });
    return found;
}

// Three rows of three numbers.
std::optional<glm::dmat3> read_rows(const toml::node& node,
                                    std::string_view name,
                                    TomlComplaints& complaints) {
    const std::string form = "three rows [[a, b, c], [d, e, f], [g, h, i]]";
    const toml::array* const rows = node.as_array();
    if (rows == nullptr || rows->size() != 3) {
        complaints.complain(node, fmt::format("{} must be {}", name, form));
        return std::nullopt;
    }
    glm::dmat3 matrix{};
    for (glm::length_t row = 0; row < 3; ++row) {
        const auto numbers =
            complaints.numbers<3>((*rows)[static_cast<std::size_t>(row)], name, kAnyNumber, form);
        for (glm::length_t column = 0; column < 3; ++column) {
            matrix[column][row] = numbers[static_cast<std::size_t>(column)];
        }
    }
    return matrix;
}

// Reads the cameras of one document.
class RigReader {
 public:
    RigReader(TomlComplaints& complaints, std::vector<std::string>& notes)
        : complaints_(complaints), notes_(notes) {}

    // None after a complaint, and where the file says that the camera is to be ignored.
    std::optional<Camera> camera(const CameraTable& from) {
        Camera camera;
        camera.name = name_of(from);
        complaints_.enter(fmt::format("camera \"{}\"", camera.name));
        if (from.table->get("ignore") != nullptr && from.table->get("ignore")->value_or(false)) {
            notes_.push_back(
                fmt::format("camera \"{}\" is marked `ignore`: left out", printable(camera.name)));
            return std::nullopt;
        }
        read_lens(*from.table, camera.lens);
        read_place(*from.table, camera);
        return complaints_.is_sound() ? std::optional(std::move(camera)) : std::nullopt;
    }

 private:
    std::string name_of(const CameraTable& from) {
        if (std::string name = complaints_.text(*from.table, "name"); !name.empty()) {
            return name;
        }
        return from.is_in_list ? "cam_" + from.key : from.key;
    }

    void read_lens(const toml::table& table, Lens& lens) {
        if (const toml::node* const size = complaints_.needed(table, "size", "size = [w, h]")) {
            const auto [width, height] =
                complaints_.numbers<2>(*size, "size", kPictureSize, "[width, height]");
            if (width != std::floor(width) || height != std::floor(height)) {
                complaints_.complain(*size, "size must be whole numbers of pixels");
            }
            lens.width = static_cast<int>(width);
            lens.height = static_cast<int>(height);
        }
        if (const toml::node* const matrix = complaints_.needed(
                table, "matrix", "matrix = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")) {
            read_matrix(*matrix, lens);
        }
        if (const toml::node* const fisheye = table.get("fisheye");
            fisheye != nullptr && fisheye->value_or(false)) {
            complaints_.complain(
                *fisheye,
                "a fisheye lens is described by other numbers; calibrate the camera "
                "anew, with 8 coefficients");
        }
        if (const toml::node* const distortions = table.get("distortions")) {
            read_distortion(*distortions, lens);
        }
    }

    void read_matrix(const toml::node& node, Lens& lens) {
        const auto matrix = read_rows(node, "matrix", complaints_);
        if (!matrix || !complaints_.is_sound()) {
            return;
        }
        const glm::dmat3& m = *matrix;
        if (m[1][0] != 0.0 || m[0][1] != 0.0 || m[0][2] != 0.0 || m[1][2] != 0.0 ||
            m[2][2] != 1.0) {
            complaints_.complain(node,
                                 "matrix must be [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]: a skewed "
                                 "lens cannot be used");
        }
        lens.fx = m[0][0];
        lens.fy = m[1][1];
        lens.cx = m[2][0];
        lens.cy = m[2][1];
    }

    void read_distortion(const toml::node& node, Lens& lens) {
        const toml::array* array = node.as_array();
        if (array != nullptr && array->size() == 1 && array->get(0)->is_array()) {
            array = array->get(0)->as_array();  // one row of a matrix, as OpenCV has it
        }
        const std::size_t count = array == nullptr ? 1 : array->size();
        if (count != 0 && count != 4 && count != 5 && count != 8) {
            complaints_.complain(node, "distortions must be 4, 5 or 8 numbers: k1 k2 p1 p2 k3 ...");
            return;
        }
        for (std::size_t i = 0; i < count; ++i) {
            lens.distortion[i] = complaints_.number((*array)[i], "distortions", kAnyNumber);
        }
    }

    void read_place(const toml::table& table, Camera& camera) {
        for (const char* const key : {"rotation", "translation"}) {
            const toml::node* const node = table.get(key);
            if (node == nullptr || node->is_string()) {  // Caliscope writes "null"
                complaints_.complain(
                    node == nullptr ? table : *node,
                    fmt::format("has no {}: it is not calibrated with the others", key));
                return;
            }
        }
        read_rotation(table, camera.rotation);
        const auto shift = complaints_.numbers<3>(
            *table.get("translation"), "translation", kAnyNumber, "[x, y, z]");
        camera.translation = {shift[0], shift[1], shift[2]};
    }

    void read_rotation(const toml::table& table, glm::dmat3& rotation) {
        const toml::node& node = *table.get("rotation");
        const toml::array* const array = node.as_array();
        if (array != nullptr && array->size() == 3 && array->get(0)->is_array()) {
            rotation = read_rows(node, "rotation", complaints_).value_or(rotation);
        } else {
            const auto vector = complaints_.numbers<3>(
                node, "rotation", {-100.0, 100.0}, "[x, y, z] or three rows");
            rotation = rotation_of({vector[0], vector[1], vector[2]});
        }
        const toml::node* const exact = table.get("rotation_matrix");
        if (exact == nullptr) {
            return;
        }
        const auto matrix = read_rows(*exact, "rotation_matrix", complaints_);
        constexpr double kSame = 5e-3;  // check_rig lets matrices be off by 1e-3
        double difference = 0.0;
        for (glm::length_t i = 0; matrix && i < 9; ++i) {
            difference =
                std::max(difference, std::abs((*matrix)[i / 3][i % 3] - rotation[i / 3][i % 3]));
        }
        if (difference > kSame) {
            complaints_.complain(*exact,
                                 "rotation and rotation_matrix differ: remove the one that is old");
        }
        rotation = matrix.value_or(rotation);
    }

    TomlComplaints& complaints_;
    std::vector<std::string>& notes_;
};

// What a file says of its own units, in [metadata].
RigReading stated(const toml::table& document, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 2> kUnits = {"m", "mm"};
    constexpr std::array<std::string_view, 2> kAxes = {"y", "z"};
    RigReading reading;
    const toml::table* const metadata = document["metadata"].as_table();
    if (metadata == nullptr) {
        return reading;
    }
    complaints.enter("[metadata]");
    if (const toml::node* const unit = metadata->get("unit")) {
        reading.metres_per_unit = complaints.word(*unit, "unit", kUnits) == 1 ? 0.001 : 1.0;
    }
    if (const toml::node* const up = metadata->get("up")) {
        reading.up = complaints.word(*up, "up axis", kAxes) == 1 ? UpAxis::z : UpAxis::y;
    }
    return reading;
}

// How a file of ours knows its floor.
FloorOrigin stated_floor(const toml::table& document, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 3> kOrigins = {"known", "unknown", "feet"};
    const toml::table* const metadata = document["metadata"].as_table();
    const toml::node* const floor = metadata != nullptr ? metadata->get("floor") : nullptr;
    return floor != nullptr ? static_cast<FloorOrigin>(complaints.word(*floor, "floor", kOrigins))
                            : FloorOrigin::known;
}

// Whether a file of ours can say what this camera is.
bool is_in_range(const Camera& camera) {
    const auto is_within = [](double value) {
        return value >= kAnyNumber.lowest && value <= kAnyNumber.highest;
    };
    const Lens& lens = camera.lens;
    const glm::dvec3& shift = camera.translation;
    return is_within(lens.fx) && is_within(lens.fy) && is_within(lens.cx) && is_within(lens.cy) &&
           is_within(shift.x) && is_within(shift.y) && is_within(shift.z) &&
           std::all_of(lens.distortion.begin(), lens.distortion.end(), is_within) &&
           lens.width <= kPictureSize.highest && lens.height <= kPictureSize.highest;
}

// The shortest text that reads back to the same bits, as TOML's floating point.
std::string number_text(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) {
        text += ".0";
    }
    return text;
}

std::string array_text(std::initializer_list<double> values) {
    std::string text = "[";
    for (const double value : values) {
        text += (text.size() > 1 ? ", " : "") + number_text(value);
    }
    return text + "]";
}

std::string rows_text(const glm::dmat3& m) {
    return fmt::format("[{}, {}, {}]",
                       array_text({m[0][0], m[1][0], m[2][0]}),
                       array_text({m[0][1], m[1][1], m[2][1]}),
                       array_text({m[0][2], m[1][2], m[2][2]}));
}

std::string distortion_text(const std::array<double, 8>& k) {
    return k[5] == 0.0 && k[6] == 0.0 && k[7] == 0.0
               ? array_text({k[0], k[1], k[2], k[3], k[4]})
               : array_text({k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]});
}

}  // namespace

Expected<RigFile> settled_rig(RigFile file,
                              const RigReading& said,
                              const RigReading& given,
                              const std::string& name) {
    const auto unit = given.metres_per_unit ? given.metres_per_unit : said.metres_per_unit;
    if (!unit) {
        file.notes.emplace_back("the rig does not say its unit: taken as metres");
    } else if (*unit != 1.0) {
        file.notes.push_back(fmt::format("the rig is in units of {} m: turned into metres", *unit));
        for (Camera& camera : file.rig.cameras) {
            camera.translation *= *unit;
        }
    }
    if ((given.up ? *given.up : said.up.value_or(UpAxis::y)) == UpAxis::z) {
        file.notes.emplace_back("the rig has z up: turned so that y is");
        const glm::dmat3 old_from_new({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0});
        for (Camera& camera : file.rig.cameras) {
            camera.rotation = camera.rotation * old_from_new;
        }
    }
    if (const Expected<void> checked = check_rig(file.rig); !checked) {
        return fail(Error(checked.error()).in(name));
    }
    for (const Camera& camera : file.rig.cameras) {
        if (!is_plain_name(camera.name) || !is_in_range(camera)) {
            return fail(fmt::format("{}: camera \"{}\": {}",
                                    name,
                                    printable(camera.name, 40),
                                    is_plain_name(camera.name)
                                        ? "a number is beyond all that cameras have"
                                        : "needs a name of letters, without control characters"));
        }
    }
    return file;
}

Expected<RigFile> parse_rig(std::string_view text,
                            const std::string& name,
                            const RigReading& reading) {
    const auto document = parse_toml(text, name);
    if (!document) {
        return fail(document.error());
    }
    const std::vector<CameraTable> tables = camera_tables(*document);
    if (tables.empty()) {
        return fail(
            fmt::format("{}: has no camera: a table [cam_0] with size, matrix, distortions, "
                        "rotation and translation is needed",
                        name));
    }
    if (tables.size() > kMostCameras) {
        return fail(
            fmt::format("{}: has {} cameras, more than {}", name, tables.size(), kMostCameras));
    }
    TomlComplaints complaints(name);
    RigFile file;
    RigReader reader(complaints, file.notes);
    const RigReading said = stated(*document, complaints);
    file.rig.floor = stated_floor(*document, complaints);
    for (const CameraTable& table : tables) {
        if (auto camera = reader.camera(table)) {
            file.rig.cameras.push_back(std::move(*camera));
        }
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return settled_rig(std::move(file), said, reading, name);
}

Expected<RigFile> read_rig(const std::filesystem::path& path, const RigReading& reading) {
    const Expected<std::string> text = read_text_file(path, kLongestToml);
    if (!text) {
        return fail(text.error());
    }
    if (text->starts_with("%YAML")) {
        return read_easymocap_rig(path, *text, reading);
    }
    return text->starts_with('<') ? parse_qualisys_rig(*text, path.string(), reading)
                                  : parse_rig(*text, path.string(), reading);
}

std::string rig_text(const Rig& rig) {
    std::string text;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        const Camera& camera = rig.cameras[i];
        const Lens& lens = camera.lens;
        const glm::dvec3 turn = rotation_vector(camera.rotation);
        const glm::dvec3& shift = camera.translation;
        text += fmt::format(
            "[cam_{}]\n"
            "name = {}\n"
            "size = [{}, {}]\n"
            "matrix = {}\n"
            "distortions = {}\n"
            "rotation = {}\n"
            "translation = {}\n"
            "rotation_matrix = {}\n"
            "fisheye = false\n\n",
            i,
            toml_quoted(camera.name),
            lens.width,
            lens.height,
            rows_text({{lens.fx, 0.0, 0.0}, {0.0, lens.fy, 0.0}, {lens.cx, lens.cy, 1.0}}),
            distortion_text(lens.distortion),
            array_text({turn.x, turn.y, turn.z}),
            array_text({shift.x, shift.y, shift.z}),
            rows_text(camera.rotation));
    }
    text += "[metadata]\nunit = \"m\"\nup = \"y\"\n";
    if (rig.floor != FloorOrigin::known) {
        text +=
            fmt::format("floor = \"{}\"\n", rig.floor == FloorOrigin::unknown ? "unknown" : "feet");
    }
    return text;
}

}  // namespace raks::capture
