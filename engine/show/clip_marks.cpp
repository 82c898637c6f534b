#include "engine/show/clip_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace raks::engine {
namespace {

constexpr double kTrailSeconds = 1.0;
constexpr std::size_t kMostSteps = 40;       // of a trail
constexpr std::size_t kMostSegments = 8000;  // of all trails

// By StickPart: a little brighter than the themes' sticks, so that fine lines are seen.
constexpr std::array<std::uint32_t, 3> kTrailColours = {0xFFB454, 0x4FD0C7, 0xF0763F};

// Where a place is in the picture, pixels; none: behind the camera, or not seen.
std::optional<glm::vec2> pixel_of(const glm::vec3& place,
                                  const glm::mat4& clip_from_world,
                                  const render::FrameTarget& target) {
    const glm::vec4 at = clip_from_world * glm::vec4(place, 1.0F);
    if (!(at.w > 0.05F)) {  // also what is not seen, which is NaN
        return std::nullopt;
    }
    return glm::vec2((0.5F + 0.5F * at.x / at.w) * static_cast<float>(target.width),
                     (0.5F - 0.5F * at.y / at.w) * static_cast<float>(target.height));
}

}  // namespace

// A short bar of the colour before each name.
void ClipMarks::place_keys(const std::vector<MarkKey>& keys, const render::FrameTarget& target) {
    const float unit = std::max(static_cast<float>(target.height) / 720.0F, 0.5F);
    float y = 30.0F * unit;
    for (const MarkKey& key : keys) {
        const std::uint32_t colour = kTrailColours[static_cast<std::size_t>(key.part)];
        for (float across = -2.0F; across <= 2.0F; across += 0.5F) {
            const float at = y + across * unit;
            lines_.push_back({24.0F * unit, at, 48.0F * unit, at, colour, 1.0F});
        }
        labels_.push_back({48.0F * unit, y, key.name});
        y += 22.0F * unit;
    }
}

void ClipMarks::place(const render::RecordedBodies& recorded,
                      std::size_t frame,
                      double frames_per_second,
                      const ShownMarks& shown,
                      const render::Camera& camera,
                      const render::FrameTarget& target) {
    lines_.clear();
    labels_.clear();
    place_keys(shown.keys, target);
    const glm::mat4 clip_from_world = camera.clip_from_world(
        static_cast<float>(target.width) / static_cast<float>(std::max(target.height, 1)));
    std::vector<render::BodyPoint> now = recorded.points(frame);
    if (shown.has_names) {
        for (const render::BodyPoint& point : now) {
            if (const auto at = pixel_of(point.place, clip_from_world, target)) {
                labels_.push_back({at->x, at->y, point.name});
            }
        }
    }
    if (!shown.has_trails || now.empty()) {
        return;
    }
    // From the frame back in even steps.
    const auto length =
        std::min(frame, static_cast<std::size_t>(std::lround(kTrailSeconds * frames_per_second)));
    const std::size_t most = std::clamp<std::size_t>(kMostSegments / now.size(), 1, kMostSteps);
    const std::size_t step = std::max<std::size_t>(1, (length + most - 1) / most);
    for (std::size_t back = step; back <= length; back += step) {
        const std::vector<render::BodyPoint> before = recorded.points(frame - back);
        const float age = static_cast<float>(back) / static_cast<float>(length + 1);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const auto from = pixel_of(before[i].place, clip_from_world, target);
            const auto to = pixel_of(now[i].place, clip_from_world, target);
            if (from && to) {
                lines_.push_back({from->x,
                                  from->y,
                                  to->x,
                                  to->y,
                                  kTrailColours[static_cast<std::size_t>(now[i].part)],
                                  0.9F * (1.0F - age)});
            }
        }
        now = before;
    }
}

}  // namespace raks::engine
