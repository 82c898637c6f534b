#include "motion/capture/camera/qualisys_rig.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "base/printable.hpp"

#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

constexpr std::size_t kLongestXml = std::size_t{16} << 20U;
constexpr std::size_t kMostXmlCameras = 1000;
constexpr double kSubPixels = 64.0;  // parts of a pixel in which lenses are told

// Numbers of the attributes of a camera's parts, and the first that is missing.
class PartReader {
 public:
    explicit PartReader(const pugi::xml_node& camera) : camera_(camera) {}

    double number(const char* part, const char* key) {
        const std::string_view text = camera_.child(part).attribute(key).as_string();
        double value = 0.0;
        const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_number = result.ec == std::errc() &&
                               result.ptr == text.data() + text.size() && std::isfinite(value);
        if (!is_number && fault_.empty()) {
            fault_ =
                text.empty()
                    ? fmt::format("has no {} {}", part, key)
                    : fmt::format("{} {} is \"{}\", not a number", part, key, printable(text, 40));
        }
        return is_number ? value : 0.0;
    }

    [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
    pugi::xml_node camera_;
    std::string fault_;
};

Lens lens_of(PartReader& part, std::string& fault) {
    const double left = part.number("fov_video", "left");
    const double top = part.number("fov_video", "top");
    const double width = part.number("fov_video", "right") - left + 1.0;
    const double height = part.number("fov_video", "bottom") - top + 1.0;
    constexpr double kLargest = 65'535.0;
    if (!(width >= 1.0 && height >= 1.0 && width <= kLargest && height <= kLargest)) {
        fault = "fov_video does not give the size of a picture";
        return {};
    }
    if (part.number("intrinsic", "skew") != 0.0) {
        fault = "has a skewed lens, which cannot be used";
    }
    Lens lens;
    lens.width = static_cast<int>(width);
    lens.height = static_cast<int>(height);
    lens.fx = part.number("intrinsic", "focalLengthU") / kSubPixels;
    lens.fy = part.number("intrinsic", "focalLengthV") / kSubPixels;
    lens.cx = part.number("intrinsic", "centerPointU") / kSubPixels - left;
    lens.cy = part.number("intrinsic", "centerPointV") / kSubPixels - top;
    lens.distortion[0] = part.number("intrinsic", "radialDistortion1");
    lens.distortion[1] = part.number("intrinsic", "radialDistortion2");
    lens.distortion[2] = part.number("intrinsic", "tangentalDistortion1");
    lens.distortion[3] = part.number("intrinsic", "tangentalDistortion2");
    lens.distortion[4] = part.number("intrinsic", "radialDistortion3");
    return lens;
}

// r11..r33 are listed by columns: read as rows they are camera from world, y up and z backward;
// half a turn about x makes that OpenCV's.
void place(PartReader& part, Camera& camera) {
    constexpr const char* kNames[3][3] = {
        {"r11", "r12", "r13"}, {"r21", "r22", "r23"}, {"r31", "r32", "r33"}};
    glm::dmat3 rotation{};
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column) {
            const double value = part.number("transform", kNames[row][column]);
            rotation[column][row] = row == 0 ? value : -value;
        }
    }
    const glm::dvec3 centre(part.number("transform", "x"),
                            part.number("transform", "y"),
                            part.number("transform", "z"));
    camera.rotation = rotation;
    camera.translation = -(rotation * centre);
}

}  // namespace

Expected<RigFile> parse_qualisys_rig(std::string_view text,
                                     const std::string& name,
                                     const RigReading& reading) {
    if (text.size() > kLongestXml) {
        return fail(fmt::format("{}: has {} bytes, more than {}", name, text.size(), kLongestXml));
    }
    pugi::xml_document document;
    const auto parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
        return fail(fmt::format("{}: at byte {}: {}", name, parsed.offset, parsed.description()));
    }
    RigFile file;
    for (const pugi::xml_node& node :
         document.child("calibration").child("cameras").children("camera")) {
        if (file.rig.cameras.size() == kMostXmlCameras) {
            return fail(fmt::format("{}: has more than {} cameras", name, kMostXmlCameras));
        }
        Camera& camera = file.rig.cameras.emplace_back();
        camera.name = node.attribute("serial").as_string();
        PartReader part(node);
        std::string fault;
        camera.lens = lens_of(part, fault);
        place(part, camera);
        fault = part.fault().empty() ? fault : part.fault();
        if (!fault.empty() || camera.name.empty()) {
            return fail(fmt::format("{}: camera {} \"{}\": {}",
                                    name,
                                    file.rig.cameras.size(),
                                    printable(camera.name, 40),
                                    fault.empty() ? "has no serial" : fault));
        }
    }
    if (file.rig.cameras.empty()) {
        return fail(fmt::format(
            "{}: has no <calibration><cameras><camera>: is it a calibration of Qualisys?", name));
    }
    return settled_rig(std::move(file), {.metres_per_unit = 0.001, .up = UpAxis::z}, reading, name);
}

}  // namespace raks::capture
