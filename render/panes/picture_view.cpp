#include "render/panes/picture_view.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "render/panes/widgets.hpp"

#include <glm/common.hpp>

namespace raks::render {
namespace {

PictureZoom in_bounds(const PictureZoom& zoom) {
    // All of the picture, once it fits, has nowhere to go.
    const double half = 0.5 / zoom.times;
    const double low = std::min(half, 0.5);
    return {zoom.times, glm::clamp(zoom.middle, glm::dvec2(low), glm::dvec2(1.0 - low))};
}

}  // namespace

PicturePlace::PicturePlace(const Box& box, int width, int height, const PictureZoom& zoom) noexcept
    : box_(box), size_(width, height), zoom_(in_bounds(zoom)) {
    const double fitting = std::min(static_cast<double>(box.width) / size_.x,
                                    static_cast<double>(box.height) / size_.y);
    unit_ = std::max(fitting * zoom_.times, 1e-6);
    const glm::dvec2 middle(static_cast<double>(box.x) + 0.5 * static_cast<double>(box.width),
                            static_cast<double>(box.y) + 0.5 * static_cast<double>(box.height));
    corner_ = middle - unit_ * size_ * zoom_.middle;
}

glm::vec2 PicturePlace::in_box(const glm::dvec2& pixel) const noexcept {
    return {corner_ + unit_ * (pixel + 0.5)};
}

glm::dvec2 PicturePlace::pixel_at(const glm::vec2& place) const noexcept {
    return (glm::dvec2(place) - corner_) / unit_ - 0.5;
}

Box PicturePlace::whole() const noexcept {
    return {static_cast<float>(corner_.x),
            static_cast<float>(corner_.y),
            static_cast<float>(unit_ * size_.x),
            static_cast<float>(unit_ * size_.y)};
}

PictureZoom PicturePlace::zoomed(const glm::vec2& place, double factor) const noexcept {
    PictureZoom zoom = zoom_;
    zoom.times = std::clamp(zoom_.times * factor, 1.0, PictureZoom::kMostTimes);
    const glm::dvec2 share = (glm::dvec2(place) - corner_) / (unit_ * size_);
    zoom.middle = share + (zoom_.middle - share) * (zoom_.times / zoom.times);
    return in_bounds(zoom);
}

PictureZoom PicturePlace::moved(const glm::vec2& by) const noexcept {
    PictureZoom zoom = zoom_;
    zoom.middle -= glm::dvec2(by) / (unit_ * size_);
    return in_bounds(zoom);
}

PictureGesture picture_view(const PaneFrame& frame,
                            std::string_view name,
                            const PicturePlace& place,
                            const PanePicture* picture) {
    constexpr double kWheelStep = 1.25;
    const Box& box = place.box();
    frame.pen.fill(box, pane_colours::kSunken);
    const float unit = frame.pen.unit();
    ImGui::SetCursorScreenPos({box.x * unit, box.y * unit});
    ImGui::PushID(name.data(), name.data() + name.size());
    ImGui::InvisibleButton("picture",
                           {std::max(box.width * unit, 1.0F), std::max(box.height * unit, 1.0F)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::PopID();
    PictureGesture gesture;
    gesture.is_hovered = ImGui::IsItemHovered();
    gesture.pixel = place.pixel_at(frame.pointer);
    const bool is_active = ImGui::IsItemActive();
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    if (gesture.is_hovered && frame.wheel != 0.0F) {
        gesture.zoom =
            place.zoomed(frame.pointer, std::pow(kWheelStep, static_cast<double>(frame.wheel)));
    } else if (is_active && (frame.holds(MouseButton::right) || frame.holds(MouseButton::middle)) &&
               (delta.x != 0.0F || delta.y != 0.0F)) {
        gesture.zoom = place.moved({delta.x / unit, delta.y / unit});
    }
    if (gesture.is_hovered && frame.has_pressed(MouseButton::left)) {
        gesture.kind = PictureGesture::Kind::press;
    } else if (is_active && frame.holds(MouseButton::left)) {
        gesture.kind = PictureGesture::Kind::drag;
    } else if (ImGui::IsItemDeactivated() && !frame.holds(MouseButton::left)) {
        gesture.kind = PictureGesture::Kind::release;
    }
    if (picture != nullptr) {
        const PaneClip clip(frame, box);
        const Box whole = place.whole();
        const auto name_of_picture = static_cast<std::uintptr_t>(picture->name());
        // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's name of a texture is a pointer
        auto* const texture = reinterpret_cast<ImTextureID>(name_of_picture);
        ImGui::GetWindowDrawList()->AddImage(texture,
                                             {whole.x * unit, whole.y * unit},
                                             {whole.right() * unit, whole.bottom() * unit});
    }
    return gesture;
}

PaneClip::PaneClip(const PaneFrame& frame, const Box& box) {
    const float unit = frame.pen.unit();
    ImGui::PushClipRect(
        {box.x * unit, box.y * unit}, {box.right() * unit, box.bottom() * unit}, true);
}

PaneClip::~PaneClip() { ImGui::PopClipRect(); }

}  // namespace raks::render
