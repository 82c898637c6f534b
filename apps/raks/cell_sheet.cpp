#include "apps/raks/cell_sheet.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "motion/cells/cell_dance.hpp"
#include "render/overlay/picture_text.hpp"
#include "render/pose_sheet.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using motion::Cell;
using motion::CellGraph;

constexpr int kBeatsInRow = 16;
constexpr int kBeatWidth = 104;   // pixels
constexpr int kBodyHeight = 168;  // of a figure's picture
constexpr int kNotesHeight = 44;  // below it
constexpr int kTakeHeight = 34;   // above the first row of a take
constexpr int kHeadHeight = 74;   // of the sheet
constexpr int kInset = 8;         // of what is written
constexpr std::size_t kMostBeatsDrawn = 512;
constexpr std::uint32_t kSheetPaper = 0x14161F;
constexpr std::uint32_t kSheetInk = 0xF2EEE6;
constexpr std::uint32_t kQuiet = 0x8A8FA0;
constexpr std::uint32_t kFirstHalf = 0xFFB454;
constexpr std::uint32_t kEnergyBar = 0x4C8DFF;
constexpr std::uint32_t kGreatestBar = 0xFF6B5E;
constexpr std::uint32_t kRest = 0x63D297;

// A picture that grows by bands.
class Page {
 public:
    explicit Page(int width) : width_(width) {}

    [[nodiscard]] int height() const {
        return static_cast<int>(rgba_.size() / 4U / static_cast<std::size_t>(width_));
    }
    void grow(int rows) {
        const std::size_t before = rgba_.size();
        rgba_.resize(before +
                     static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_) * 4U);
        fill(0, height() - rows, width_, rows, kSheetPaper);
    }
    void fill(int x, int y, int width, int height, std::uint32_t rgb) {
        for (int row = y; row < y + height; ++row) {
            for (int column = x; column < x + width; ++column) {
                std::uint8_t* const pixel = at(column, row);
                pixel[0] = static_cast<std::uint8_t>(rgb >> 16U);
                pixel[1] = static_cast<std::uint8_t>(rgb >> 8U & 0xFFU);
                pixel[2] = static_cast<std::uint8_t>(rgb & 0xFFU);
                pixel[3] = 0xFF;
            }
        }
    }
    // Copies a rectangle of a sheet that begins at `from` of it.
    void put(const render::PoseSheet& sheet, int from_x, int from_y, int x, int y) {
        for (int row = 0; row < kBodyHeight; ++row) {
            const auto offset =
                (static_cast<std::size_t>(from_y + row) * static_cast<std::size_t>(sheet.width) +
                 static_cast<std::size_t>(from_x)) *
                4U;
            std::copy_n(sheet.rgba.begin() + static_cast<std::ptrdiff_t>(offset),
                        kBeatWidth * 4,
                        at(x, y + row));
        }
    }
    // A third of the light stays.
    void darken(int x, int y, int width, int height) {
        for (int row = y; row < y + height; ++row) {
            std::uint8_t* const pixel = at(x, row);
            std::transform(pixel,
                           pixel + 4 * static_cast<std::ptrdiff_t>(width),
                           pixel,
                           [](std::uint8_t value) { return static_cast<std::uint8_t>(value / 3); });
            for (int column = 0; column < width; ++column) {
                pixel[4 * static_cast<std::ptrdiff_t>(column) + 3] = 0xFF;
            }
        }
    }
    void write(
        const render::PictureText& text, int x, int y, std::uint32_t rgb, const std::string& line) {
        text.write({rgba_, width_, height()}, x, y, rgb, line);
    }
    [[nodiscard]] Expected<void> save(const Path& output) const {
        return render::write_png(output, width_, height(), rgba_);
    }

 private:
    [[nodiscard]] std::uint8_t* at(int x, int y) {
        return rgba_.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(x)) *
                                  4U;
    }

    int width_;
    std::vector<std::uint8_t> rgba_;
};

// The cell of each beat of a take; cells.size(): the beat is none.
std::vector<std::size_t> cells_of(const CellGraph& graph, std::size_t take) {
    std::vector<std::size_t> cells(static_cast<std::size_t>(graph.takes[take].beats),
                                   graph.cells.size());
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        if (graph.cells[i].take == take) {
            cells[graph.cells[i].beat] = i;
        }
    }
    return cells;
}

// Draws the bands of takes.
class CellSheet {
 public:
    CellSheet(SheetStudio& studio, const motion::DanceLibrary& library)
        : studio_(studio),
          library_(library),
          graph_(*library.cells()),
          page_(kBeatsInRow * kBeatWidth) {
        layout_.columns = kBeatsInRow;
        layout_.tile_width = kBeatWidth;
        layout_.tile_height = kBodyHeight;
        layout_.cameras.resize(1);  // the front
    }

    void add_head(const std::string& name) {
        page_.grow(kHeadHeight);
        page_.write(large_,
                    kInset,
                    kInset,
                    kSheetInk,
                    fmt::format("{}: {} cells of {} takes, {} arcs, {:.0f} BPM",
                                name,
                                graph_.cells.size(),
                                graph_.takes.size(),
                                graph_.arcs.size(),
                                60.0 / graph_.beat_seconds));
        page_.write(small_,
                    kInset,
                    kHeadHeight / 2 + kInset,
                    kQuiet,
                    "a figure a beat, by its number in the take (amber: first of two); bar: energy "
                    "(red: the greatest); arcs that leave as it ends; hold, end: comes to rest; "
                    "dark: no cell");
    }

    Expected<void> add_take(std::size_t take) {
        const std::vector<std::size_t> cells = cells_of(graph_, take);
        std::vector<motion::Pose> poses;
        for (std::size_t beat = 0; beat < cells.size(); ++beat) {
            poses.push_back(library_.pose_at(take, static_cast<double>(beat)));
        }
        // As many as the layout has columns, so that a short take is no narrower sheet.
        while (poses.size() < static_cast<std::size_t>(kBeatsInRow)) {
            poses.push_back(poses.back());
        }
        const auto drawn = studio_.draw_sheet(poses, layout_);
        if (!drawn) {
            return fail(drawn.error());
        }
        add_name(take, cells);
        for (std::size_t beat = 0; beat < cells.size(); ++beat) {
            const int column = static_cast<int>(beat) % kBeatsInRow;
            const int row = static_cast<int>(beat) / kBeatsInRow;
            if (column == 0) {
                page_.grow(kBodyHeight + kNotesHeight);
            }
            const int x = column * kBeatWidth;
            const int y = page_.height() - kBodyHeight - kNotesHeight;
            page_.put(*drawn, x, row * kBodyHeight, x, y);
            add_notes(beat, cells[beat], x, y);
        }
        return {};
    }

    [[nodiscard]] Expected<void> save(const Path& output) const { return page_.save(output); }

 private:
    void add_name(std::size_t take, const std::vector<std::size_t>& cells) {
        page_.grow(kTakeHeight);
        const auto danced = std::count_if(cells.begin(), cells.end(), [&](std::size_t cell) {
            return cell < graph_.cells.size();
        });
        page_.write(
            middle_,
            kInset,
            page_.height() - kTakeHeight + kInset,
            kSheetInk,
            fmt::format("{}: {} of {} beats", graph_.takes[take].name, danced, cells.size()));
    }

    // What stands in and under the picture of a beat.
    void add_notes(std::size_t beat, std::size_t number, int x, int y) {
        if (number >= graph_.cells.size()) {
            page_.darken(x, y, kBeatWidth, kBodyHeight);
            page_.write(small_, x + kInset, y + kInset / 2, kQuiet, std::to_string(beat));
            return;
        }
        const Cell& cell = graph_.cells[number];
        page_.write(small_,
                    x + kInset,
                    y + kInset / 2,
                    cell.is_second_half ? kSheetInk : kFirstHalf,
                    std::to_string(beat));
        const int line = y + kBodyHeight;
        constexpr int kMostBar = kBeatWidth - kInset;
        const double share = static_cast<double>(cell.energy) /
                             std::max(1e-6, static_cast<double>(graph_.energies.back()));
        page_.fill(x + kInset / 2,
                   line + kInset / 2,
                   std::clamp(static_cast<int>(share * kMostBar), 1, kMostBar),
                   kInset,
                   motion::is_greatest(graph_, number) ? kGreatestBar : kEnergyBar);
        const std::size_t arcs = graph_.arcs_of(number).size();
        page_.write(small_,
                    x + kInset / 2,
                    line + 2 * kInset,
                    graph_.has_successor(number) ? kSheetInk : kFirstHalf,
                    arcs == 1 ? std::string("1 arc") : fmt::format("{} arcs", arcs));
        if (motion::is_rest(graph_, number)) {
            page_.write(small_,
                        x + kBeatWidth - 6 * kInset,
                        line + 2 * kInset,
                        kRest,
                        motion::is_ending(graph_, number) ? "end" : "hold");
        }
        if (!graph_.has_successor(number)) {
            page_.fill(x + kBeatWidth - 2, y, 2, kBodyHeight + kNotesHeight, kFirstHalf);
        }
    }

    SheetStudio& studio_;
    const motion::DanceLibrary& library_;
    const CellGraph& graph_;
    render::PoseSheetConfig layout_;
    Page page_;
    render::PictureText large_{24.0F};
    render::PictureText middle_{19.0F};
    render::PictureText small_{15.0F};
};

}  // namespace

Expected<std::string> write_cell_sheet(SheetStudio& studio,
                                       const Path& output,
                                       const motion::DanceLibrary& library,
                                       std::optional<std::size_t> take,
                                       const std::string& name) {
    const CellGraph& graph = *library.cells();
    CellSheet sheet(studio, library);
    sheet.add_head(name);
    std::size_t beats = 0;
    std::string left_out;
    const std::size_t first = take.value_or(0);
    const std::size_t end = take ? first + 1 : graph.takes.size();
    for (std::size_t i = first; i < end; ++i) {
        beats += static_cast<std::size_t>(graph.takes[i].beats);
        if (i > first && beats > kMostBeatsDrawn) {
            left_out = fmt::format("takes from {} on are left out; --figure TAKE draws one",
                                   graph.takes[i].name);
            break;
        }
        if (auto added = sheet.add_take(i); !added) {
            return fail(std::move(added.error()));
        }
    }
    if (auto saved = sheet.save(output); !saved) {
        return fail(std::move(saved.error()));
    }
    return left_out;
}

}  // namespace raks::apps
