#include "render/panes/name_tags.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr float kHeight = 16.0F;
constexpr float kGap = 10.0F;   // between a point and its box
constexpr float kPoint = 6.0F;  // radius of what must stay free around a point
constexpr int kRings = 9;       // of places farther and farther away

bool overlap(const Box& one, const Box& other) {
    return one.x < other.right() && other.x < one.right() && one.y < other.bottom() &&
           other.y < one.bottom();
}

// The places around a point, the best first.
std::vector<Box> places_around(const glm::vec2& point, float width, float height) {
    std::vector<Box> places;
    for (int ring = 0; ring < kRings; ++ring) {
        const float away = static_cast<float>(ring) * (height + 2.0F);
        const float right = point.x + kGap;
        const float left = point.x - kGap - width;
        const float middle = point.y - height / 2.0F;
        for (const float x : {right, left}) {
            for (const float y : {middle - away, middle + away}) {
                places.push_back({x, y, width, height});
            }
        }
        places.push_back({point.x - width / 2.0F, point.y - kGap - height - away, width, height});
        places.push_back({point.x - width / 2.0F, point.y + kGap + away, width, height});
    }
    return places;
}

bool is_free(const Box& box, const std::vector<glm::vec2>& points, const std::vector<Box>& taken) {
    const auto covers = [&box](const glm::vec2& point) {
        return overlap(box, {point.x - kPoint, point.y - kPoint, 2.0F * kPoint, 2.0F * kPoint});
    };
    return std::none_of(points.begin(), points.end(), covers) &&
           std::none_of(taken.begin(), taken.end(), [&](const Box& b) { return overlap(box, b); });
}

bool lies_in(const Box& box, const Box& area) {
    return box.x >= area.x && box.right() <= area.right() && box.y >= area.y &&
           box.bottom() <= area.bottom();
}

// What is drawn on now, units.
Box drawn_area(const Pen& pen) {
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 low = list.GetClipRectMin();
    const ImVec2 high = list.GetClipRectMax();
    const float unit = pen.unit();
    return {low.x / unit, low.y / unit, (high.x - low.x) / unit, (high.y - low.y) / unit};
}

}  // namespace

std::vector<Box> place_tags(const std::vector<glm::vec2>& points,
                            const std::vector<float>& widths,
                            float height,
                            const Box& area) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<Box> places = places_around(points[i], widths[i], height);
        // Those that are seen whole first.
        std::stable_partition(
            places.begin(), places.end(), [&](const Box& place) { return lies_in(place, area); });
        const auto free = std::find_if(places.begin(), places.end(), [&](const Box& place) {
            return is_free(place, points, boxes);
        });
        boxes.push_back(free != places.end() ? *free : places.front());
    }
    return boxes;
}

void draw_tags(const PaneFrame& frame, const std::vector<NameTag>& tags) {
    const Pen& pen = frame.pen;
    const ImFont* const font = pen.fonts().small;
    std::vector<glm::vec2> points;
    std::vector<float> widths;
    for (const NameTag& tag : tags) {
        points.push_back(tag.at);
        widths.push_back(pen.width_of(font, tag.name) + 8.0F);
    }
    const std::vector<Box> boxes = place_tags(points, widths, kHeight, drawn_area(pen));
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const Box& box = boxes[i];
        const glm::vec2 nearest =
            glm::clamp(points[i], glm::vec2(box.x, box.y), glm::vec2(box.right(), box.bottom()));
        if (glm::distance(nearest, points[i]) > kGap + 2.0F) {
            const float unit = pen.unit();
            ImGui::GetWindowDrawList()->AddLine({points[i].x * unit, points[i].y * unit},
                                                {nearest.x * unit, nearest.y * unit},
                                                IM_COL32(255, 255, 255, 130));
        }
        pen.fill(box, {0x000000, 0.62F}, 4.0F);
        pen.text(font, box.x + 4.0F, box.y, tags[i].colour, tags[i].name);
    }
}

}  // namespace raks::render
