#include "tests/end_to_end/filmed_board.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/capture/calibration/board_drawing.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace raks::test {
namespace {

constexpr int kMoments = 12;
constexpr int kSquare = 24;  // pixels of the painted board
constexpr int kSamples = 2;  // of a pixel, along each side
constexpr std::uint8_t kWall = 120;

/// Where a board is: its axes in the world, and its middle.
struct BoardPlace {
    glm::dmat3 world_from_board{1.0};
    glm::dvec3 middle{};
};

// Turned towards between both cameras, tilted another way at each moment; at last on the floor.
BoardPlace place_at(int moment) {
    if (moment == kMoments - 1) {
        return {glm::dmat3({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}), {0.0, 0.0, 0.0}};
    }
    const auto turned = [](double angle, const glm::dvec3& axis) {
        return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
    };
    const double t = moment;
    const glm::dmat3 upright({1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0});
    return {turned(0.35 * std::sin(2.1 * t), {0.0, 1.0, 0.0}) *
                turned(-0.3 + 0.4 * std::cos(1.7 * t), {1.0, 0.0, 0.0}) *
                turned(0.5 * std::sin(0.9 * t), {0.0, 0.0, 1.0}) * upright,
            {0.25 * std::sin(1.3 * t), 0.9 + 0.25 * std::cos(1.1 * t), 0.2 * std::sin(0.7 * t)}};
}

// What a ray from a camera meets: the board, or the wall behind.
double light_of(const capture::Camera& camera,
                const capture::Board& board,
                const capture::BoardPicture& print,
                const BoardPlace& place,
                const glm::dvec2& pixel) {
    const glm::dvec2 direction = capture::direction_of(camera.lens, pixel);
    const glm::dvec3 ray = glm::transpose(camera.rotation) * glm::dvec3(direction, 1.0);
    const glm::dmat3 board_from_world = glm::transpose(place.world_from_board);
    const glm::dvec3 from = board_from_world * (camera.centre() - place.middle);
    const glm::dvec3 along = board_from_world * ray;
    const double distance = -from.z / along.z;
    if (!(distance > 0.0)) {
        return kWall;
    }
    const glm::dvec3 at = from + distance * along;
    const double scale = kSquare / board.square;
    const auto x = static_cast<int>(std::floor(at.x * scale + 0.5 * print.width));
    const auto y = static_cast<int>(std::floor(at.y * scale + 0.5 * print.height));
    return x < 0 || y < 0 || x >= print.width || y >= print.height
               ? kWall
               : print.pixels[static_cast<std::size_t>(y * print.width + x)];
}

}  // namespace

capture::Rig two_cameras() {
    const capture::Lens lens{640, 480, 620.0, 620.0, 319.5, 239.5, {}};
    const double side = 2.4 * std::sqrt(0.5);
    return {{capture::looking_at("left", lens, {-side, 1.6, side}, {0.0, 0.7, 0.0}),
             capture::looking_at("right", lens, {side, 1.6, side}, {0.0, 0.7, 0.0})}};
}

void film_board(const capture::Rig& rig,
                const capture::Board& board,
                const std::filesystem::path& folder) {
    const auto print = capture::draw_board(board, kSquare);
    ASSERT_TRUE(print) << print.error().message;
    for (const capture::Camera& camera : rig.cameras) {
        std::filesystem::create_directories(folder / camera.name);
        for (int moment = 0; moment < kMoments; ++moment) {
            const BoardPlace place = place_at(moment);
            std::vector<std::uint8_t> rgba;
            for (int y = 0; y < camera.lens.height; ++y) {
                for (int x = 0; x < camera.lens.width; ++x) {
                    double sum = 0.0;
                    for (int i = 0; i < kSamples * kSamples; ++i) {
                        const double u = x - 0.5 + (i % kSamples + 0.5) / kSamples;
                        const double v = y - 0.5 + (std::floor(i / kSamples) + 0.5) / kSamples;
                        sum += light_of(camera, board, *print, place, {u, v});
                    }
                    const auto grey =
                        static_cast<std::uint8_t>(std::lround(sum / (kSamples * kSamples)));
                    rgba.insert(rgba.end(), {grey, grey, grey, 255});
                }
            }
            ASSERT_TRUE(render::write_png(folder / camera.name / fmt::format("{:02}.png", moment),
                                          camera.lens.width,
                                          camera.lens.height,
                                          rgba));
        }
    }
}

}  // namespace raks::test
