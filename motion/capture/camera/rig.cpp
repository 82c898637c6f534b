#include "motion/capture/camera/rig.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/printable.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

bool is_finite(const Camera& camera) noexcept {
    bool finite = std::isfinite(camera.lens.fx) && std::isfinite(camera.lens.fy) &&
                  std::isfinite(camera.lens.cx) && std::isfinite(camera.lens.cy);
    for (const double k : camera.lens.distortion) {
        finite = finite && std::isfinite(k);
    }
    for (int i = 0; i < 3; ++i) {
        finite = finite && std::isfinite(camera.translation[i]);
        for (int j = 0; j < 3; ++j) {
            finite = finite && std::isfinite(camera.rotation[i][j]);
        }
    }
    return finite;
}

// The greatest entry of R^T R - 1.
double rotation_error(const glm::dmat3& rotation) noexcept {
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    double worst = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            worst = std::max(worst, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
        }
    }
    return worst;
}

std::string fault_of(const Camera& camera) {
    if (camera.lens.width <= 0 || camera.lens.height <= 0) {
        return "its picture has no size";
    }
    if (!is_finite(camera)) {
        return "a number is not finite";
    }
    if (!(camera.lens.fx > 0.0) || !(camera.lens.fy > 0.0)) {
        return "its focal length is not positive";
    }
    constexpr double kLargestError = 1e-3;
    if (rotation_error(camera.rotation) > kLargestError) {
        return "its rotation is not one: columns of length 1 at right angles are needed";
    }
    if (glm::determinant(camera.rotation) < 0.0) {
        return "its rotation is a mirror image (determinant -1): is an axis turned round?";
    }
    return {};
}

std::string off_centre(const Lens& lens) {
    const auto is_outer = [](double centre, int size) {
        return centre < 0.25 * size || centre > 0.75 * size;
    };
    if (!is_outer(lens.cx, lens.width) && !is_outer(lens.cy, lens.height)) {
        return {};
    }
    return fmt::format(
        "its principal point ({:.0f}, {:.0f}) is far from the middle of its {} x {} "
        "picture: is it that of another picture size?",
        lens.cx,
        lens.cy,
        lens.width,
        lens.height);
}

// The two cameras that are furthest apart, and the two nearest ones, where that cannot be.
void add_distance_doubts(const Rig& rig, std::vector<std::string>& doubts) {
    constexpr double kFarthest = 50.0;
    constexpr double kNearest = 0.05;
    double most = kFarthest;
    double least = kNearest;
    std::string far;
    std::string near;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double apart = glm::distance(rig.cameras[i].centre(), rig.cameras[j].centre());
            const auto line = [&](const std::string& distance, const char* unit) {
                return fmt::format("cameras \"{}\" and \"{}\" stand {} m apart: {}",
                                   printable(rig.cameras[j].name),
                                   printable(rig.cameras[i].name),
                                   distance,
                                   unit);
            };
            if (apart > most) {
                most = apart;
                far = line(fmt::format("{:.0f}", apart), "is this in millimetres?");
            } else if (apart < least) {
                least = apart;
                near = line(fmt::format("{:.3g}", apart), "is this in another unit?");
            }
        }
    }
    for (std::string* const line : {&far, &near}) {
        if (!line->empty()) {
            doubts.push_back(std::move(*line));
        }
    }
}

}  // namespace

std::optional<std::size_t> Rig::index_of(std::string_view name) const noexcept {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (cameras[i].name == name) {
            return i;
        }
    }
    return std::nullopt;
}

Expected<void> check_rig(const Rig& rig) {
    if (rig.cameras.size() < 2) {
        return fail(rig.cameras.size() == 1
                        ? "one camera is too few: where something is, two or more tell"
                        : "the rig has no camera; two or more are needed");
    }
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        const Camera& camera = rig.cameras[i];
        if (rig.index_of(camera.name) != i) {
            return fail(fmt::format("two cameras are called \"{}\"", printable(camera.name)));
        }
        if (const std::string fault = fault_of(camera); !fault.empty()) {
            return fail(fmt::format("camera \"{}\": {}", printable(camera.name), fault));
        }
    }
    return {};
}

std::vector<std::string> rig_doubts(const Rig& rig) {
    std::vector<std::string> doubts;
    add_distance_doubts(rig, doubts);
    std::vector<std::string> below;
    double deepest = 0.0;
    for (const Camera& camera : rig.cameras) {
        const std::string name = printable(camera.name);
        if (const std::string fault = off_centre(camera.lens); !fault.empty()) {
            doubts.push_back(fmt::format("camera \"{}\": {}", name, fault));
        }
        if (camera.centre().y < 0.0) {
            below.push_back('"' + name + '"');
            deepest = std::max(deepest, -camera.centre().y);
        }
    }
    if (!below.empty()) {
        doubts.push_back(
            fmt::format("{} {} {} up to {:.2f} m under the floor: is the floor's board "
                        "mirrored, or does another axis point up?",
                        below.size() == 1 ? "camera" : "cameras",
                        fmt::join(below, ", "),
                        below.size() == 1 ? "stands" : "stand",
                        deepest));
    }
    return doubts;
}

std::vector<std::string> folding_doubts(const Rig& rig, const std::vector<double>& used) {
    std::vector<std::string> doubts;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        const double radius = folding_radius(rig.cameras[i].lens);
        if (used[i] > radius) {
            doubts.push_back(fmt::format(
                "camera \"{}\": its distortion folds over {:.0f} pixels from the middle, and what "
                "it sees reaches {:.0f}; calibrate with the board in its corners, too, and with 5 "
                "coefficients",
                printable(rig.cameras[i].name),
                radius,
                used[i]));
        }
    }
    return doubts;
}

double expected_error(double distance, double f, double sigma, double views) noexcept {
    return distance * sigma / f * std::sqrt(5.0 / views);
}

}  // namespace raks::capture
