#include "apps/raks_capture/carried_board.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace raks::apps {
namespace {

constexpr double kHeld = 0.8;     // seconds
constexpr double kCarried = 0.2;  // on to the next place
constexpr double kOnFloor = 4.0;
constexpr int kPlacesOfAPair = 12;
constexpr int kPlacesOfACamera = 4;
constexpr double kSteepest = 0.5;  // cosine of 60 degrees: from farther aside nothing is read

// What all cameras look at: the point nearest to their lines of sight, at the height of a dancer's
// hips. Lines that are nearly parallel leave it between the cameras.
glm::dvec3 middle_of(const capture::Rig& rig) {
    constexpr double kLeaning = 1e-3;  // towards the cameras
    glm::dmat3 across(0.0);
    glm::dvec3 sum{};
    for (const capture::Camera& camera : rig.cameras) {
        const glm::dvec3 sight = glm::transpose(camera.rotation)[2];
        const glm::dmat3 beside = glm::dmat3(1.0 + kLeaning) - glm::outerProduct(sight, sight);
        across += beside;
        sum += beside * camera.centre();
    }
    const glm::dvec3 middle = glm::inverse(across) * sum;
    return {middle.x, 1.0, middle.z};
}

// The cameras in the order in which they stand around the middle.
std::vector<std::size_t> around(const capture::Rig& rig, const glm::dvec3& middle) {
    const auto angle = [&](std::size_t i) {
        const glm::dvec3 from = rig.cameras[i].centre() - middle;
        return std::atan2(from.x, from.z);
    };
    std::vector<std::size_t> order(rig.cameras.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return angle(a) < angle(b); });
    return order;
}

// A board at `middle` whose printed side looks at `towards`, its rows level, then turned by `tilt`.
glm::dmat3 facing(const glm::dvec3& middle, const glm::dvec3& towards, const glm::dvec3& tilt) {
    const capture::Camera viewer = capture::looking_at({}, {}, towards, middle);
    return glm::transpose(viewer.rotation) * capture::rotation_of(tilt);
}

// Whether a camera sees the middle of a board, well within its picture and not too flat.
bool sees(const capture::Camera& camera, const glm::dmat3& rotation, const glm::dvec3& middle) {
    const glm::dvec3 view = glm::normalize(middle - camera.centre());
    const auto pixel = capture::project(camera, middle);
    const double margin = 0.12 * camera.lens.width;
    return pixel && glm::dot(view, rotation[2]) > kSteepest && pixel->x > margin &&
           pixel->y > margin && pixel->x < camera.lens.width - margin &&
           pixel->y < camera.lens.height - margin;
}

struct Place {
    glm::dmat3 rotation;
    glm::dvec3 middle;
};

glm::dvec3 draw_tilt(Dice& dice) {
    constexpr double kTilt = 0.45;  // radians
    constexpr double kRoll = 0.6;
    const double x = dice.uniform(-kTilt, kTilt);
    const double y = dice.uniform(-kTilt, kTilt);
    return {x, y, dice.uniform(-kRoll, kRoll)};
}

// In the space of the dance, for two cameras at once.
Place place_for(const capture::Camera& one,
                const capture::Camera& other,
                const glm::dvec3& centre,
                Dice& dice) {
    constexpr int kTries = 500;
    const glm::dvec3 between = 0.5 * (one.centre() + other.centre());
    const glm::dvec3 out = glm::dvec3(between.x - centre.x, 0.0, between.z - centre.z);
    const glm::dvec3 across(out.z, 0.0, -out.x);
    Place place{};
    for (int i = 0; i < kTries; ++i) {
        const double along = dice.uniform(-0.1, 0.5);
        const double aside = dice.uniform(-0.3, 0.3);
        place.middle = centre + along * out + aside * across;
        place.middle.y = dice.uniform(0.5, 1.7);
        place.rotation = facing(place.middle, between, draw_tilt(dice));
        if (sees(one, place.rotation, place.middle) && sees(other, place.rotation, place.middle)) {
            break;
        }
    }
    return place;
}

// Near one camera, in a part of its picture.
Place place_near(const capture::Camera& camera, const capture::Board& board, int part, Dice& dice) {
    constexpr double kShare = 0.4;  // of the picture's width that the board has
    const capture::Lens& lens = camera.lens;
    const double depth =
        lens.fx * board.square * board.columns / (kShare * lens.width) * dice.uniform(0.9, 1.2);
    const glm::dvec2 pixel((part % 2 == 0 ? 0.3 : 0.7) * lens.width,
                           (part / 2 % 2 == 0 ? 0.32 : 0.68) * lens.height);
    const glm::dvec2 direction = capture::direction_of(lens, pixel);
    const glm::dvec3 in_camera = depth * glm::dvec3(direction, 1.0);
    Place place{};
    place.middle = glm::transpose(camera.rotation) * (in_camera - camera.translation);
    place.rotation = facing(place.middle, camera.centre(), draw_tilt(dice));
    return place;
}

// Printed side up: z goes down into the floor.
Place on_floor() { return {glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}), {}}; }

}  // namespace

CarriedBoard::CarriedBoard(const capture::Rig& rig, const capture::Board& board, std::uint64_t seed)
    : half_(0.5 * board.square * glm::dvec2(board.columns, board.rows)) {
    Dice dice(seed, 500);
    const glm::dvec3 centre = middle_of(rig);
    const std::vector<std::size_t> order = around(rig, centre);
    const auto hold = [this](const Place& place) {
        holds_.push_back({glm::quat_cast(place.rotation), place.middle});
    };
    for (std::size_t i = 0; i < order.size(); ++i) {
        const capture::Camera& camera = rig.cameras[order[i]];
        const capture::Camera& next = rig.cameras[order[(i + 1) % order.size()]];
        for (int k = 0; k < kPlacesOfACamera; ++k) {
            hold(place_near(camera, board, k, dice));
        }
        for (int k = 0; k < kPlacesOfAPair; ++k) {
            hold(place_for(camera, next, centre, dice));
        }
    }
    hold(on_floor());
}

double CarriedBoard::seconds() const noexcept {
    return static_cast<double>(holds_.size() - 1) * (kHeld + kCarried) + kOnFloor;
}

double CarriedBoard::floor_time() const noexcept { return seconds() - 0.5 * kOnFloor; }

capture::RigidMotion CarriedBoard::place_at(double time) const {
    const double holds =
        std::clamp(time / (kHeld + kCarried), 0.0, static_cast<double>(holds_.size() - 1));
    const auto index = static_cast<std::size_t>(holds);
    const Hold& from = holds_[index];
    const Hold& to = holds_[std::min(index + 1, holds_.size() - 1)];
    const double carried = (holds - static_cast<double>(index)) * (kHeld + kCarried) - kHeld;
    const double share = std::clamp(carried / kCarried, 0.0, 1.0);
    const double eased = share * share * (3.0 - 2.0 * share);
    const glm::dmat3 rotation(glm::slerp(from.rotation, to.rotation, eased));
    const glm::dvec3 middle = from.middle + eased * (to.middle - from.middle);
    return {rotation, middle - rotation * glm::dvec3(half_, 0.0)};
}

}  // namespace raks::apps
