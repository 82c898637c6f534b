#include "tests/motion/capture/calibration/studio.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <utility>

#include <Eigen/Dense>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"

#include <glm/geometric.hpp>

namespace raks::capture::test {

namespace {

Rig ring_of(int cameras, Dice& dice) {
    Rig rig;
    for (int i = 0; i < cameras; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / cameras;
        const double f = 600.0 * dice.uniform(0.96, 1.04);
        Lens lens{640, 480, f, f * dice.uniform(0.998, 1.002), 320.0, 240.0, {}};
        lens.cx += dice.uniform(-6.0, 6.0);
        lens.cy += dice.uniform(-6.0, 6.0);
        lens.distortion = {dice.uniform(-0.12, 0.02), dice.uniform(0.0, 0.05), 0.0, 0.0, 0.0};
        const double height = i % 2 == 0 ? 1.55 : 2.25;
        rig.cameras.push_back(looking_at("cam_" + std::to_string(i),
                                         lens,
                                         {4.0 * std::cos(angle), height, 4.0 * std::sin(angle)},
                                         {0.0, 0.95, 0.0}));
    }
    return rig;
}

// A board that faces the ring about `angle`, tilted by chance.
RigidMotion held_board(const Board& board, double angle, Dice& dice) {
    angle += dice.uniform(-0.3, 0.3);
    const glm::dvec3 facing(4.0 * std::cos(angle), dice.uniform(0.5, 3.0), 4.0 * std::sin(angle));
    const double away = dice.uniform(0.0, 2.0 * std::numbers::pi);
    const double distance = 0.9 * std::sqrt(dice.uniform());
    const glm::dvec3 middle(
        distance * std::cos(away), dice.uniform(0.6, 1.7), distance * std::sin(away));
    const Camera viewer = looking_at({}, {}, facing, middle);
    // x and y as who faces it sees them, z away from there; then tilted.
    const glm::dmat3 faced = glm::transpose(viewer.rotation);
    const glm::dvec3 tilt(
        dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), dice.uniform(-0.8, 0.8));
    RigidMotion place{faced * rotation_of(tilt), {}};
    const glm::dvec3 centre(
        0.5 * board.square * board.columns, 0.5 * board.square * board.rows, 0.0);
    place.translation = middle - place.rotation * centre;
    return place;
}

// What a camera sees of it; nothing where it does not see enough of it from the front.
std::vector<BoardCorner> seen_by(
    const Camera& camera, const Board& board, const RigidMotion& place, double noise, Dice& dice) {
    const glm::dvec3 middle =
        place({0.5 * board.square * board.columns, 0.5 * board.square * board.rows, 0.0});
    const glm::dvec3 view = glm::normalize(middle - camera.centre());
    constexpr double kSteepest = 0.42;  // cosine of 65 degrees
    constexpr std::size_t kFewest = 12;
    std::vector<BoardCorner> corners;
    if (glm::dot(view, place.rotation[2]) < kSteepest) {
        return corners;
    }
    for (std::size_t i = 0; i < corner_count(board); ++i) {
        const auto pixel = project(camera, place(glm::dvec3(corner_place(board, i), 0.0)));
        if (!pixel || !is_in_picture(camera.lens, *pixel)) {
            continue;
        }
        const double u = dice.normal(noise);
        const double v = dice.normal(noise);
        corners.push_back({i, *pixel + glm::dvec2(u, v)});
    }
    return corners.size() < kFewest ? std::vector<BoardCorner>() : corners;
}

Eigen::Vector3d eigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

Studio make_studio(const StudioPlan& plan) {
    Dice dice(plan.seed, 0);
    Studio studio;
    studio.board = {.columns = 10, .rows = 7, .square = 0.08};
    studio.rig = ring_of(plan.cameras, dice);
    for (std::size_t moment = 0; moment < static_cast<std::size_t>(plan.poses); ++moment) {
        // To two neighbours of the ring in turn.
        const double angle = 2.0 * std::numbers::pi * (static_cast<double>(moment) + 0.5) /
                             static_cast<double>(plan.cameras);
        const RigidMotion place = held_board(studio.board, angle, dice);
        studio.places[moment] = place;
        for (std::size_t camera = 0; camera < studio.rig.cameras.size(); ++camera) {
            auto corners =
                seen_by(studio.rig.cameras[camera], studio.board, place, plan.noise, dice);
            if (!corners.empty()) {
                studio.sightings.push_back({camera, moment, std::move(corners)});
            }
        }
    }
    return studio;
}

std::vector<Sighting> share_of(const std::vector<Sighting>& sightings, Share share) {
    std::vector<Sighting> some;
    std::copy_if(sightings.begin(),
                 sightings.end(),
                 std::back_inserter(some),
                 [share](const Sighting& sighting) {
                     return (sighting.moment % 5 == 4) == (share == Share::held_out);
                 });
    return some;
}

RigidMotion best_motion(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& onto) {
    const auto count = static_cast<Eigen::Index>(from.size());
    Eigen::Matrix3Xd a(3, count);
    Eigen::Matrix3Xd b(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        a.col(i) = eigen(from[static_cast<std::size_t>(i)]);
        b.col(i) = eigen(onto[static_cast<std::size_t>(i)]);
    }
    const Eigen::Matrix4d m = Eigen::umeyama(a, b, false);
    RigidMotion motion;
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column) {
            motion.rotation[column][row] = m(row, column);
        }
        motion.translation[row] = m(row, 3);
    }
    return motion;
}

std::vector<Sighting> read_sightings(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    std::map<std::string, std::size_t> columns;
    const auto cells_of = [](const std::string& text) {
        std::vector<std::string> cells;
        std::istringstream stream(text);
        for (std::string cell; std::getline(stream, cell, ',');) {
            cells.push_back(cell);
        }
        return cells;
    };
    for (const std::string& name : cells_of(line)) {
        columns.emplace(name, columns.size());
    }
    std::map<std::pair<std::size_t, std::size_t>, std::vector<BoardCorner>> seen;
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = cells_of(line);
        const auto number = [&](const char* name) { return std::stod(cells[columns.at(name)]); };
        seen[{static_cast<std::size_t>(number("sync_index")),
              static_cast<std::size_t>(number("cam_id"))}]
            .push_back({static_cast<std::size_t>(number("keypoint_id")),
                        {number("img_loc_x"), number("img_loc_y")}});
    }
    std::vector<Sighting> sightings;
    for (auto& [key, corners] : seen) {
        sightings.push_back({key.second, key.first, std::move(corners)});
    }
    return sightings;
}

}  // namespace raks::capture::test
