#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/overlay/panels.hpp"
#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

// Sizes in the pen's units.
constexpr float kEdgeOfBar = 16.0F;  // between the panel and the picture's edge
constexpr float kPanelHeight = 66.0F;
constexpr float kSignWidth = 48.0F;
constexpr float kHelpWidth = 44.0F;
constexpr float kCurveHeight = 16.0F;
constexpr float kThumb = 6.0F;

// Where a frame is on the bar, [0, 1].
float share_of(std::size_t frame, const OverlayTransport& transport) {
    const auto last = static_cast<float>(std::max<std::size_t>(transport.frame_count, 2) - 1);
    return std::min(static_cast<float>(frame) / last, 1.0F);
}

// The largest value of each column of two units: a worst frame is not lost in a long clip.
void draw_curve(const Pen& pen, std::span<const float> curve, const Box& box) {
    constexpr float kColumn = 2.0F;
    const auto columns = static_cast<std::size_t>(std::max(box.width / kColumn, 1.0F));
    for (std::size_t column = 0; column < columns && !curve.empty(); ++column) {
        const std::size_t from = column * curve.size() / columns;
        const std::size_t to = std::max((column + 1) * curve.size() / columns, from + 1);
        float highest = 0.0F;
        for (std::size_t i = from; i < std::min(to, curve.size()); ++i) {
            highest = std::isnan(curve[i]) ? highest : std::max(highest, curve[i]);
        }
        const float height = std::clamp(highest, 0.0F, 1.0F) * box.height;
        if (height > 0.5F) {
            pen.fill({box.x + static_cast<float>(column) * kColumn,
                      box.bottom() - height,
                      kColumn,
                      height},
                     palette::kTeal.faded(0.55F));
        }
    }
}

std::string words_of(const OverlayTransport& transport) {
    std::string words =
        fmt::format("frame {} of {}   {:.2f} s",
                    transport.frame,
                    transport.frame_count,
                    static_cast<double>(transport.frame) / transport.frames_per_second);
    if (std::abs(transport.rate - 1.0) > 1e-6) {
        words += fmt::format("   rate {:.2f}", transport.rate);
    }
    words += transport.is_paused ? "   paused" : "";
    if (!transport.typed.empty()) {
        words += "   go to " + std::string(transport.typed) + "_";
    }
    return words;
}

}  // namespace

void draw_play_sign(const Pen& pen, bool is_paused, float x, float y) {
    if (is_paused) {
        pen.triangle({x - 6.0F, y - 9.0F}, {x - 6.0F, y + 9.0F}, {x + 9.0F, y}, palette::kText);
    } else {
        pen.fill({x - 6.0F, y - 8.0F, 4.5F, 16.0F}, palette::kText, 1.0F);
        pen.fill({x + 2.0F, y - 8.0F, 4.5F, 16.0F}, palette::kText, 1.0F);
    }
}

OverlayControls draw_transport(const Pen& pen,
                               const OverlayTransport& transport,
                               const Canvas& canvas) {
    OverlayControls controls;
    const OverlayFonts& fonts = pen.fonts();
    const Box box{kEdgeOfBar,
                  canvas.height - kEdgeOfBar - kPanelHeight,
                  canvas.width - 2.0F * kEdgeOfBar,
                  kPanelHeight};
    pen.panel(box);
    draw_play_sign(pen, transport.is_paused, box.x + 0.5F * kSignWidth, box.y + 0.5F * box.height);
    const float left = box.x + kSignWidth;
    const float right = box.right() - kHelpWidth;
    const Box bar{left, box.y + 28.0F, right - left, 5.0F};
    draw_curve(pen, transport.curve, {left, bar.y - kCurveHeight - 2.0F, bar.width, kCurveHeight});
    const float share = share_of(transport.frame, transport);
    pen.bar(bar, share, palette::kAmber);
    const float middle = bar.y + 0.5F * bar.height;
    if (transport.mark) {
        pen.dot(left + share_of(*transport.mark, transport) * bar.width,
                middle,
                0.6F * kThumb,
                palette::kRed);
    }
    pen.dot(left + share * bar.width, middle, kThumb, palette::kText);
    // What is of interest stands at the right, the frame at the left of it.
    const float line = box.y + 40.0F;
    float words_end = right;
    if (transport.mark) {
        const std::string text =
            fmt::format("{}: frame {}", one_line(transport.mark_name), *transport.mark);
        const float width = pen.width_of(fonts.body, text);
        pen.text(fonts.body, right - width, line, palette::kRed, text);
        controls.mark = area_of(pen, {right - width - 4.0F, line - 2.0F, width + 8.0F, 24.0F});
        words_end = right - width - 16.0F;
    }
    pen.text(fonts.body,
             left,
             line,
             palette::kText,
             words_of(transport),
             Align::left,
             std::max(words_end - left, 0.0F));
    const Box help{box.right() - 34.0F, box.y + 0.5F * box.height - 12.0F, 24.0F, 24.0F};
    pen.fill(help, palette::kTrough, 5.0F);
    pen.text(fonts.body, help.x + 12.0F, help.y + 3.0F, palette::kText, "?", Align::middle);
    controls.help = area_of(pen, help);
    controls.play_sign = area_of(pen, {box.x, box.y, kSignWidth - 10.0F, box.height});
    controls.position = area_of(pen, {left - 8.0F, box.y + 8.0F, bar.width + 16.0F, 30.0F});
    controls.from = left * pen.unit();
    controls.to = right * pen.unit();
    return controls;
}

}  // namespace raks::render
