#include "apps/grid/strip_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/overlay/picture_text.hpp"

namespace raks::apps {
namespace {

constexpr std::uint32_t kPaper = 0x14161F;
constexpr std::uint32_t kLaneGround = 0x0A0B12;
constexpr std::uint32_t kInk = 0xF2EEE6;
constexpr std::uint32_t kPale = 0x8C91A8;
constexpr std::uint32_t kAmber = 0xFFB454;
constexpr std::uint32_t kHips = 0x5B6078;
constexpr std::uint32_t kLeft = 0x62D0C8;
constexpr std::uint32_t kRight = 0xF27B45;

constexpr float kTitlePixels = 22.0F;
constexpr float kTextPixels = 15.0F;
constexpr float kMarkPixels = 13.0F;

// Fills rectangles of a picture, as far as they lie in it.
class Canvas {
 public:
    explicit Canvas(render::PoseSheet& sheet) : sheet_(sheet) {}

    void fill(int x, int y, int width, int height, std::uint32_t rgb) {
        for (int row = std::max(y, 0); row < std::min(y + height, sheet_.height); ++row) {
            for (int column = std::max(x, 0); column < std::min(x + width, sheet_.width);
                 ++column) {
                put(column, row, rgb);
            }
        }
    }
    void text(
        const render::PictureText& font, int x, int y, std::uint32_t rgb, std::string_view line) {
        font.write({sheet_.rgba, sheet_.width, sheet_.height}, x, y, rgb, line);
    }
    // A tile of another picture; grey: without colours, and darker.
    void copy(const render::PoseSheet& from, int from_x, int from_y, int x, int y, bool is_grey) {
        for (int row = 0; row < kStripTileHeight; ++row) {
            for (int column = 0; column < kStripTileWidth; ++column) {
                const std::uint8_t* const source =
                    &from.rgba[pixel(from_x + column, from_y + row, from.width)];
                std::uint32_t rgb = static_cast<std::uint32_t>(source[0]) << 16U |
                                    static_cast<std::uint32_t>(source[1]) << 8U | source[2];
                if (is_grey) {
                    const std::uint32_t grey = (source[0] + 2U * source[1] + source[2]) / 9U;
                    rgb = grey << 16U | grey << 8U | grey;
                }
                put(x + column, y + row, rgb);
            }
        }
    }

 private:
    static std::size_t pixel(int x, int y, int width) {
        return 4U * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
    }
    void put(int x, int y, std::uint32_t rgb) {
        std::uint8_t* const to = &sheet_.rgba[pixel(x, y, sheet_.width)];
        to[0] = static_cast<std::uint8_t>(rgb >> 16U & 0xFFU);
        to[1] = static_cast<std::uint8_t>(rgb >> 8U & 0xFFU);
        to[2] = static_cast<std::uint8_t>(rgb & 0xFFU);
        to[3] = 0xFF;
    }

    render::PoseSheet& sheet_;
};

double middle_of_column(int column) { return (column + 0.5) * kStripTileWidth; }

// The time at a place of a row; the inverse of strip_place.
double time_at(const StripRow& row, double x) {
    if (row.size() == 1) {
        return row[0].time;
    }
    std::size_t i = 1;
    while (i + 1 < row.size() && middle_of_column(row[i].column) < x) {
        ++i;
    }
    const double from = middle_of_column(row[i - 1].column);
    const double share = (x - from) / (middle_of_column(row[i].column) - from);
    return row[i - 1].time + share * (row[i].time - row[i - 1].time);
}

// How low and how high the hips are in all of a take, but for a leap or two.
struct HipsRange {
    double low = 0.0;
    double high = 1.0;
};

void draw_hips(
    const StripRow& row, const motion::GridCues& cues, HipsRange range, int top, Canvas& canvas) {
    const int first = row.front().column * kStripTileWidth;
    const int last = (row.back().column + 1) * kStripTileWidth;
    for (int x = first; x < last; ++x) {
        const double height = cues.hips_height[cues.row_at(time_at(row, x + 0.5))];
        const double share =
            std::clamp((height - range.low) / std::max(range.high - range.low, 0.02), 0.0, 1.0);
        const int pixels = 2 + static_cast<int>(std::lround(share * (kStripLane - 4)));
        canvas.fill(x, top + kStripLane - pixels, 1, pixels, 0x23273A);
        canvas.fill(x, top + kStripLane - pixels, 1, 1, kHips);
    }
}

void draw_landings(const StripRow& row,
                   const motion::GridCues& cues,
                   int top,
                   const render::PictureText& font,
                   Canvas& canvas) {
    const double first = row.front().column * kStripTileWidth;
    const double last = (row.back().column + 1) * kStripTileWidth;
    for (const motion::CueLanding& landing : cues.landings) {
        const double x = strip_place(row, landing.time);
        if (!(x >= first && x < last)) {
            continue;
        }
        const bool is_left = landing.side == motion::Side::left;
        const int at = static_cast<int>(x);
        const int y = top + (is_left ? 0 : kStripLane / 2);
        canvas.fill(at - 1, y, 3, kStripLane / 2, is_left ? kLeft : kRight);
        canvas.text(font, at + 3, y, is_left ? kLeft : kRight, is_left ? "L" : "R");
    }
}

HipsRange hips_range(const motion::GridCues& cues) {
    std::vector<double> heights = cues.hips_height;
    std::sort(heights.begin(), heights.end());
    const auto at = [&](double share) {
        return heights[static_cast<std::size_t>(share * static_cast<double>(heights.size() - 1))];
    };
    return {at(0.02), at(0.98)};
}

}  // namespace

double strip_place(const StripRow& row, double time) {
    for (std::size_t i = 1; i < row.size(); ++i) {
        const bool is_end = i + 1 == row.size();
        if (time < row[i].time || is_end) {
            const double share = (time - row[i - 1].time) / (row[i].time - row[i - 1].time);
            const double from = middle_of_column(row[i - 1].column);
            return from + share * (middle_of_column(row[i].column) - from);
        }
    }
    return row.size() == 1 && time == row[0].time ? middle_of_column(row[0].column)
                                                  : std::numeric_limits<double>::infinity();
}

render::PoseSheet paint_strip(const std::string& title,
                              std::span<const StripRow> rows,
                              const render::PoseSheet& bodies,
                              const motion::GridCues& cues) {
    render::PoseSheet page{kStripColumns * kStripTileWidth,
                           kStripTitle + static_cast<int>(rows.size()) * kStripRowHeight,
                           {}};
    page.rgba.resize(4U * static_cast<std::size_t>(page.width) *
                     static_cast<std::size_t>(page.height));
    Canvas canvas(page);
    canvas.fill(0, 0, page.width, page.height, kPaper);
    canvas.text(render::PictureText(kTitlePixels), 10, 10, kInk, title);
    const render::PictureText text(kTextPixels);
    const render::PictureText mark(kMarkPixels);
    const HipsRange range = hips_range(cues);
    int body = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const int top = kStripTitle + static_cast<int>(i) * kStripRowHeight;
        const int lane = top + kStripTileHeight + kStripLine;
        canvas.fill(0, lane, page.width, kStripLane - 4, kLaneGround);
        draw_hips(rows[i], cues, range, lane - 4, canvas);
        for (const StripPicture& picture : rows[i]) {
            const int x = picture.column * kStripTileWidth;
            canvas.copy(bodies,
                        body % kStripColumns * kStripTileWidth,
                        body / kStripColumns * kStripTileHeight,
                        x,
                        top,
                        !picture.is_used);
            ++body;
            const std::string line =
                picture.is_half ? fmt::format("& {:.2f}", picture.time)
                                : fmt::format("{}  {:.2f}", picture.beat + 1, picture.time);
            const auto width = static_cast<int>(text.width_of(line));
            canvas.text(text,
                        x + (kStripTileWidth - width) / 2,
                        top + kStripTileHeight + 1,
                        picture.is_half || !picture.is_used ? kPale
                        : picture.is_first                  ? kAmber
                                                            : kInk,
                        line);
            if (!picture.is_half) {
                const int middle = static_cast<int>(middle_of_column(picture.column));
                canvas.fill(middle, lane, 1, kStripLane - 4, picture.is_first ? kAmber : kInk);
            }
        }
        draw_landings(rows[i], cues, lane - 2, mark, canvas);
    }
    return page;
}

}  // namespace raks::apps
