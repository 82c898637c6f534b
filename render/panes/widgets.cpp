#include "render/panes/widgets.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace raks::render {
namespace {

constexpr float kRadius = 5.0F;

float middle_of(const Pen& pen, const Box& box, const ImFont* font) {
    return box.y + (box.height - pen.height_of(font)) / 2.0F;
}

}  // namespace

PaneItem pane_item(const Box& box, std::string_view name, const PaneFrame& frame) {
    const float unit = frame.pen.unit();
    ImGui::SetCursorScreenPos({box.x * unit, box.y * unit});
    const ImVec2 size{box.width * unit, box.height * unit};
    if (!(size.x >= 1.0F && size.y >= 1.0F)) {
        return {};
    }
    ImGui::PushID(name.data(), name.data() + name.size());
    const bool is_clicked = ImGui::InvisibleButton("item", size);
    ImGui::PopID();
    return {ImGui::IsItemHovered(), is_clicked};
}

bool pane_button(const PaneFrame& frame, const Box& box, std::string_view label, ButtonLook look) {
    const PaneItem item = pane_item(box, label, frame);
    const bool is_off = look == ButtonLook::off;
    const Colour ground = look == ButtonLook::chosen
                              ? pane_colours::kChosen
                              : pane_colours::kRaised.faded(is_off ? 0.45F : 1.0F);
    frame.pen.fill(box, ground, kRadius);
    if (item.is_hovered && !is_off) {
        frame.pen.outline(box, palette::kTeal.faded(0.8F), kRadius);
    }
    frame.pen.text(frame.pen.fonts().body,
                   box.x + box.width / 2.0F,
                   middle_of(frame.pen, box, frame.pen.fonts().body),
                   is_off ? palette::kDim.faded(0.45F) : palette::kText,
                   label,
                   Align::middle,
                   box.width - 8.0F);
    return item.is_clicked && !is_off;
}

bool pane_row(const PaneFrame& frame, const Box& box, const PaneRow& row) {
    constexpr float kSwatch = 5.0F;  // radius
    constexpr float kIndent = 26.0F;
    const PaneItem item = pane_item(box, row.name, frame);
    const Pen& pen = frame.pen;
    if (row.is_chosen || item.is_hovered) {
        pen.fill(box, row.is_chosen ? pane_colours::kChosen : pane_colours::kRaised, kRadius);
    }
    const float middle = box.y + box.height / 2.0F;
    if (row.is_ticked) {
        pen.dot(box.x + kIndent / 2.0F, middle, kSwatch, row.swatch);
    } else {
        pen.ring(box.x + kIndent / 2.0F, middle, kSwatch - 1.0F, row.swatch);
    }
    constexpr float kRight = 8.0F;
    const float name = pen.text(pen.fonts().body,
                                box.x + kIndent,
                                middle_of(pen, box, pen.fonts().body),
                                row.text,
                                row.name,
                                Align::left,
                                box.width - kIndent - kRight);
    const float room = box.width - kIndent - name - 2.0F * kRight;
    if (room < pen.width_of(pen.fonts().small, "...")) {
        return item.is_clicked;
    }
    pen.text(pen.fonts().small,
             box.right() - kRight,
             middle_of(pen, box, pen.fonts().small),
             palette::kDim,
             row.note,
             Align::right,
             room);
    return item.is_clicked;
}

std::optional<float> pane_slider(const PaneFrame& frame, const Box& box, const PaneSlider& slider) {
    constexpr float kName = 0.36F;   // share of the width
    constexpr float kValue = 52.0F;  // units
    constexpr float kThick = 4.0F;
    constexpr float kKnob = 6.0F;
    const Pen& pen = frame.pen;
    const Box track{
        box.x + kName * box.width, box.y, (1.0F - kName) * box.width - kValue, box.height};
    const PaneItem item = pane_item(track, slider.name, frame);
    const bool is_pulled = ImGui::IsItemActive();
    const float middle = box.y + box.height / 2.0F;
    const float range = slider.high - slider.low;
    const float left = track.x + kKnob;
    const float width = track.width - 2.0F * kKnob;
    const auto place_of = [&](float value) {
        return left + width * std::clamp((value - slider.low) / range, 0.0F, 1.0F);
    };
    const float zero = place_of(0.0F);
    const float knob = place_of(slider.at);
    pen.fill({left, middle - kThick / 2.0F, width, kThick}, pane_colours::kRaised, 2.0F);
    pen.fill({std::min(zero, knob), middle - kThick / 2.0F, std::abs(knob - zero), kThick},
             palette::kTeal,
             2.0F);
    pen.dot(knob, middle, kKnob, is_pulled || item.is_hovered ? palette::kText : palette::kTeal);
    const ImFont* const font = pen.fonts().body;
    const float y = middle_of(pen, box, font);
    pen.text(
        font, box.x + 4.0F, y, palette::kText, slider.name, Align::left, kName * box.width - 8.0F);
    pen.text(font, box.right() - 4.0F, y, palette::kDim, slider.value, Align::right);
    if (!is_pulled) {
        return std::nullopt;
    }
    const float at = std::clamp((frame.pointer.x - left) / width, 0.0F, 1.0F);
    return slider.low + at * range;
}

Colour named_colour(std::string_view name) noexcept {
    constexpr std::array<std::pair<std::string_view, std::uint32_t>, 9> kNamed{
        {{"green", 0x3FD15A},
         {"blue", 0x5A8CFF},
         {"yellow", 0xF5D83C},
         {"magenta", 0xF056B8},
         {"cyan", 0x3FD8F0},
         {"orange", 0xFF9A3C},
         {"red", 0xFF5050},
         {"white", 0xFFFFFF},
         {"violet", 0xA878FF}}};
    for (const auto& [known, rgb] : kNamed) {
        if (known == name) {
            return {rgb};
        }
    }
    // A hue by the letters (FNV-1a), as bright as the others.
    std::uint32_t hash = 2166136261U;
    for (const char c : name) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    }
    float red = 0.0F;
    float green = 0.0F;
    float blue = 0.0F;
    ImGui::ColorConvertHSVtoRGB(
        static_cast<float>(hash % 360U) / 360.0F, 0.62F, 0.95F, red, green, blue);
    const auto byte = [](float share) {
        return static_cast<std::uint32_t>(std::lround(share * 255.0F));
    };
    return {byte(red) << 16U | byte(green) << 8U | byte(blue)};
}

}  // namespace raks::render
