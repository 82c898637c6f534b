#include <algorithm>
#include <vector>

#include "render/overlay/panels.hpp"
#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kLongestLabel = 60;  // bytes; names of markers are short

bool do_touch(const Box& one, const Box& other) {
    return one.x < other.right() && other.x < one.right() && one.y < other.bottom() &&
           other.y < one.bottom();
}

}  // namespace

void draw_marks(const Pen& pen, const OverlayState& state) {
    const float unit = pen.unit();
    for (const OverlayLine& line : state.lines) {
        pen.line(line.from_x / unit,
                 line.from_y / unit,
                 line.to_x / unit,
                 line.to_y / unit,
                 {line.rgb, line.alpha});
    }
    const ImFont* const font = pen.fonts().small;
    std::vector<Box> taken;
    for (const OverlayLabel& label : state.labels) {
        const std::string text = one_line(label.text.substr(0, kLongestLabel));
        constexpr float kAside = 8.0F;  // from the place that is named
        const Box box{label.x / unit + kAside,
                      label.y / unit - 0.5F * pen.height_of(font) - 1.0F,
                      pen.width_of(font, text) + 6.0F,
                      pen.height_of(font) + 2.0F};
        if (text.empty() || std::any_of(taken.begin(), taken.end(), [&](const Box& other) {
                return do_touch(box, other);
            })) {
            continue;
        }
        pen.fill(box, palette::kPanel, 3.0F);
        pen.text(font, box.x + 3.0F, box.y + 1.0F, palette::kText, text);
        taken.push_back(box);
    }
}

}  // namespace raks::render
