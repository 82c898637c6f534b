#include "motion/capture/camera/calibrated_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

// x' and y' of OpenCV's model.
glm::dvec2 distorted(const std::array<double, 8>& k, const glm::dvec2& d) noexcept {
    const double r2 = d.x * d.x + d.y * d.y;
    const double radial = (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
                          (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
    const double xy = 2.0 * d.x * d.y;
    return {d.x * radial + k[2] * xy + k[3] * (r2 + 2.0 * d.x * d.x),
            d.y * radial + k[2] * (r2 + 2.0 * d.y * d.y) + k[3] * xy};
}

// Radius in the picture of a radius r without distortion, tangential terms apart.
double radial_radius(const std::array<double, 8>& k, double r) noexcept {
    return distorted({k[0], k[1], 0.0, 0.0, k[4], k[5], k[6], k[7]}, {r, 0.0}).x;
}

// One of Newton's steps towards the direction whose distorted place is `goal`.
glm::dvec2 newton_step(const std::array<double, 8>& k,
                       const glm::dvec2& at,
                       const glm::dvec2& goal) noexcept {
    constexpr double kStep = 1e-6;
    const glm::dvec2 value = distorted(k, at);
    const glm::dvec2 by_x = (distorted(k, at + glm::dvec2(kStep, 0.0)) - value) / kStep;
    const glm::dvec2 by_y = (distorted(k, at + glm::dvec2(0.0, kStep)) - value) / kStep;
    const double determinant = by_x.x * by_y.y - by_y.x * by_x.y;
    if (std::abs(determinant) < 1e-12) {
        return at;
    }
    const glm::dvec2 miss = goal - value;
    return at + glm::dvec2(miss.x * by_y.y - by_y.x * miss.y, by_x.x * miss.y - miss.x * by_x.y) /
                    determinant;
}

glm::dmat3 cross_matrix(const glm::dvec3& t) noexcept {
    return {{0.0, t.z, -t.y}, {-t.z, 0.0, t.x}, {t.y, -t.x, 0.0}};
}

}  // namespace

glm::dvec3 Camera::centre() const noexcept { return -(glm::transpose(rotation) * translation); }

Camera looking_at(std::string name,
                  const Lens& lens,
                  const glm::dvec3& centre,
                  const glm::dvec3& target) {
    const glm::dvec3 forward = glm::normalize(target - centre);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 down = glm::cross(forward, right);
    Camera camera{std::move(name), lens, glm::transpose(glm::dmat3(right, down, forward)), {}};
    camera.translation = -(camera.rotation * centre);
    return camera;
}

glm::dvec2 distorted_pixel(const Lens& lens, const glm::dvec2& direction) noexcept {
    const glm::dvec2 d = distorted(lens.distortion, direction);
    return {lens.fx * d.x + lens.cx, lens.fy * d.y + lens.cy};
}

glm::dvec2 direction_of(const Lens& lens, const glm::dvec2& pixel) noexcept {
    const glm::dvec2 goal((pixel.x - lens.cx) / lens.fx, (pixel.y - lens.cy) / lens.fy);
    if (std::all_of(
            lens.distortion.begin(), lens.distortion.end(), [](double k) { return k == 0.0; })) {
        return goal;
    }
    const double enough = 1e-6 / std::max(lens.fx, lens.fy);
    const auto miss_of = [&](const glm::dvec2& at) {
        return glm::length(goal - distorted(lens.distortion, at));
    };
    constexpr int kFixedPointSteps = 10;
    constexpr int kSteps = 30;
    glm::dvec2 at = goal;
    glm::dvec2 best = goal;
    for (int i = 0; i < kSteps && miss_of(best) > enough; ++i) {
        at = i < kFixedPointSteps ? at + (goal - distorted(lens.distortion, at))
                                  : newton_step(lens.distortion, best, goal);
        if (miss_of(at) < miss_of(best)) {
            best = at;
        }
    }
    return best;
}

double folding_radius(const Lens& lens) noexcept {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const double x = std::max(lens.cx, lens.width - 1 - lens.cx) / lens.fx;
    const double y = std::max(lens.cy, lens.height - 1 - lens.cy) / lens.fy;
    const double corner = std::hypot(x, y);
    // Seen along the radius: until the corner of the picture is reached it must grow.
    constexpr int kSteps = 400;
    double before = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double r = 2.0 * corner * i / kSteps;
        const double radius = radial_radius(lens.distortion, r);
        if (!(radius > before)) {
            return 0.5 * (lens.fx + lens.fy) * before;
        }
        if (radius >= corner) {
            return kNowhere;
        }
        before = radius;
    }
    return kNowhere;
}

std::optional<glm::dvec2> project(const Camera& camera, const glm::dvec3& world) {
    const glm::dvec3 place = camera.in_camera(world);
    constexpr double kNearest = 1e-6;
    if (!(place.z > kNearest)) {
        return std::nullopt;
    }
    return distorted_pixel(camera.lens, {place.x / place.z, place.y / place.z});
}

bool is_in_picture(const Lens& lens, const glm::dvec2& pixel) noexcept {
    return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < lens.width - 0.5 &&
           pixel.y < lens.height - 0.5;
}

glm::dmat3 epipolar_matrix(const Camera& from, const Camera& to) noexcept {
    const glm::dmat3 turn = to.rotation * glm::transpose(from.rotation);
    const glm::dvec3 shift = to.translation - turn * from.translation;
    return cross_matrix(shift) * turn;
}

double epipolar_distance(const Camera& from,
                         const glm::dvec2& from_direction,
                         const Camera& to,
                         const glm::dvec2& to_direction) noexcept {
    const glm::dvec3 line = epipolar_matrix(from, to) * glm::dvec3(from_direction, 1.0);
    const double across = std::hypot(line.x, line.y);
    const double distance = std::abs(glm::dot(line, glm::dvec3(to_direction, 1.0)));
    return distance / std::max(across, 1e-12) * 0.5 * (to.lens.fx + to.lens.fy);
}

}  // namespace raks::capture
