// Layout of the grid pane.
#include <algorithm>
#include <cmath>

#include "apps/grid/beat_strip.hpp"
#include "apps/grid/grid_pane.hpp"

namespace raks::apps {
namespace {

using render::Box;

constexpr float kMargin = 8.0F;
constexpr float kBetween = 4.0F;
constexpr float kBar = 30.0F;
constexpr float kLine = 20.0F;
constexpr float kNames = 76.0F;

// Lanes below one another, from a top downwards.
class LaneStack {
 public:
    LaneStack(float x, float width, float y) : x_(x), width_(width), y_(y) {}
    Box next(float height) {
        const Box box{x_, y_, width_, height};
        y_ += height > 0.0F ? height + 3.0F : 0.0F;
        return box;
    }

 private:
    float x_;
    float width_;
    float y_;
};

void put_bar(const Box& area, bool has_song, GridLayout& layout) {
    float x = area.x + kMargin;
    const auto next = [&](float width) {
        x += width + kBetween;
        return Box{x - width - kBetween, area.y + kMargin, width, kBar};
    };
    constexpr float kGroup = 10.0F;
    layout.play = next(64.0F);
    layout.rate = next(52.0F);
    layout.tap = next(54.0F);
    x += kGroup;
    layout.insert = next(64.0F);
    layout.remove = next(74.0F);
    layout.one = next(74.0F);
    layout.use = next(96.0F);
    x += kGroup;
    layout.half = next(54.0F);
    layout.twice = next(66.0F);
    layout.even = next(54.0F);
    layout.take_song = has_song ? next(112.0F) : Box{};
    x = area.right() - kMargin - 58.0F - 58.0F - 72.0F - 2.0F * kBetween;
    layout.undo = next(58.0F);
    layout.redo = next(58.0F);
    layout.save = next(72.0F);
}

}  // namespace

GridLayout grid_layout(const Box& area, bool has_song) {
    GridLayout layout;
    put_bar(area, has_song, layout);
    const float left = area.x + kMargin;
    const float right = area.right() - kMargin;
    const float song = has_song ? 40.0F : 0.0F;
    const float lanes = 16.0F + 30.0F + 28.0F + 44.0F + 40.0F + 16.0F + 22.0F + song + 24.0F;
    const float lines = area.bottom() - 3.0F * kLine - kMargin;
    layout.status = {left, lines, right - left, kLine};
    layout.keys = {left, lines + kLine, right - left, 2.0F * kLine};

    const float top = lines - lanes - kMargin;
    LaneStack stack(left + kNames, right - left - kNames, top);
    layout.ruler = stack.next(16.0F);
    layout.beats = stack.next(30.0F);
    layout.landings = stack.next(28.0F);
    layout.feet = stack.next(44.0F);
    layout.hips = stack.next(40.0F);
    layout.repeats = stack.next(16.0F);
    layout.song = stack.next(song);
    layout.overview = stack.next(22.0F);
    const float end = layout.overview.y - 3.0F;
    layout.lanes = {layout.ruler.x, top, layout.ruler.width, end - top};
    layout.names = {left, top, kNames, end - top};

    // The large body as wide as it is high, the others in a row beside it.
    const float room = area.y + kBar + 2.0F * kMargin;
    const float height = std::max(top - room - kMargin, 1.0F);
    layout.figure = {left, room, std::min(height, 0.4F * (right - left)), height};
    const float from = layout.figure.right() + kMargin;
    const float width = (right - from + kBetween) / static_cast<float>(kGridStills);
    const float tall = std::min(0.5F * height - kLine, 1.6F * width);
    for (int row = 0; row < 2; ++row) {
        for (std::size_t i = 0; i < kGridStills; ++i) {
            layout.stills.push_back({from + static_cast<float>(i) * width,
                                     room + static_cast<float>(row) * (tall + kLine),
                                     width - kBetween,
                                     tall});
        }
    }
    return layout;
}

float place_of(const Box& lanes, const GridView& view, double time) noexcept {
    const double share = (time - view.from) / std::max(view.to - view.from, 1e-6);
    return lanes.x + lanes.width * static_cast<float>(share);
}

double moment_at(const Box& lanes, const GridView& view, double seconds, float x) noexcept {
    const double share = static_cast<double>((x - lanes.x) / std::max(lanes.width, 1.0F));
    return std::clamp(view.from + share * (view.to - view.from), 0.0, seconds);
}

std::vector<std::optional<GridStill>> grid_stills(const GridBeats& beats, double now) {
    std::vector<std::optional<GridStill>> stills(2 * kGridStills);
    motion::TakeGrid grid{"", beats};
    const std::vector<StripRow> rows = strip_rows(grid);
    if (rows.empty()) {
        return stills;
    }
    std::size_t row = 0;
    while (row + 1 < rows.size() && rows[row + 1].front().time <= now + 1e-6) {
        ++row;
    }
    for (const StripPicture& picture : rows[row]) {
        const auto column = static_cast<std::size_t>(picture.column / 2);
        stills[picture.is_half ? kGridStills + column : column] =
            GridStill{picture.beat, picture.is_half, picture.time};
    }
    return stills;
}

}  // namespace raks::apps
