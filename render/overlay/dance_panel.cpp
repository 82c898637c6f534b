#include <fmt/format.h>

#include <string>

#include "render/overlay/panels.hpp"
#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

/// Upper half of the card: the genre's name with its posterior as a number and a bar.
void draw_genre(const Pen& pen, const OverlayState& state, const Box& box) {
    const OverlayFonts& fonts = pen.fonts();
    const float x = box.x + kInner;
    const float right = box.right() - kInner;
    const float label = pen.text(fonts.small, x, box.y + 14.0F, palette::kDim, "MUSIC");
    // The classifier's class "unknown" is shown in words, without a posterior; so is silence, which
    // is no music that could be recognised.
    const bool is_known = !state.is_silent && !state.genre.empty() && state.genre != "unknown";
    const float posterior = is_known ? state.genre_posterior : 0.0F;
    if (is_known && state.is_genre_told) {
        pen.text(fonts.small, x + label + 8.0F, box.y + 14.0F, palette::kText, state.genre_teller);
    }
    if (is_known) {
        pen.text(fonts.small,
                 right,
                 box.y + 14.0F,
                 palette::kDim,
                 fmt::format("{:.0f} %", posterior * 100.0F),
                 Align::right);
    }
    pen.text(fonts.bold,
             x,
             box.y + 29.0F,
             is_known ? palette::kText : palette::kDim,
             is_known          ? capitalized(state.genre)
             : state.is_silent ? std::string("silence")
                               : std::string("not recognised"),
             Align::left,
             right - x);
    pen.bar({x, box.y + 55.0F, right - x, 3.0F}, posterior, palette::kTeal);
}

/// Lower half: dance and figure, and one field for each of the figure's counts.
void draw_figure(const Pen& pen, const OverlayState& state, const Box& box) {
    const OverlayFonts& fonts = pen.fonts();
    const float x = box.x + kInner;
    const float right = box.right() - kInner;
    const bool is_dancing = !state.figure.empty();
    const float label = pen.text(fonts.small, x, box.y + 72.0F, palette::kDim, "DANCE");
    const float name = x + label + 8.0F;
    pen.text(
        fonts.small, name, box.y + 72.0F, palette::kText, state.dance, Align::left, right - name);
    pen.text(fonts.bold,
             x,
             box.y + 87.0F,
             is_dancing ? palette::kText : palette::kDim,
             is_dancing ? capitalized(state.figure) : "resting",
             Align::left,
             right - x);
    const int counts = state.figure_counts;
    const float gap = 3.0F;
    // The fields share the card's width, so that figures of any length fit.
    const float width =
        (right - x - gap * static_cast<float>(counts - 1)) / static_cast<float>(counts);
    for (int i = 0; i < counts; ++i) {
        const bool is_past = is_dancing && i < state.figure_count;
        // The current count is bright, those danced already are dim.
        const bool is_now = is_dancing && i == state.figure_count - 1;
        const Colour colour = is_now    ? palette::kAmber
                              : is_past ? palette::kAmber.faded(0.4F)
                                        : palette::kTrough;
        pen.fill(
            {x + static_cast<float>(i) * (width + gap), box.y + 114.0F, width, 5.0F}, colour, 2.0F);
    }
}

/// The line below the card: latency and frame rate, dim; before them, in amber, what went wrong, if
/// anything did.
void draw_health(const Pen& pen, const OverlayState& state, float right, float y) {
    const auto add = [](std::string& line, const std::string& part) {
        line += (line.empty() ? "" : "   ") + part;
    };
    std::string trouble;
    const auto count = [&](std::uint64_t number, const char* one, const char* many) {
        if (number > 0) {
            add(trouble, fmt::format("{} {}", number, number == 1 ? one : many));
        }
    };
    // Numbers of zero are left out.
    count(state.xruns, "gap in the sound", "gaps in the sound");
    count(state.drops, "moment missed", "moments missed");
    count(state.late, "pause to read the file", "pauses to read the file");

    std::string line;
    if (state.latency_ms) {
        add(line, fmt::format("{:.0f} ms", *state.latency_ms));
    }
    if (state.fps > 0.0) {
        add(line, fmt::format("{:.0f} fps", state.fps));
    }
    if (state.has_keys) {
        add(line, "? keys");
    }
    // On a card of its own: over a light stage nothing of this could be read.
    const ImFont* const font = pen.fonts().small;
    const float gap = trouble.empty() || line.empty() ? 0.0F : 12.0F;
    const float width = pen.width_of(font, line) + pen.width_of(font, trouble) + gap;
    if (width <= 0.0F) {
        return;
    }
    pen.panel({right - width - 16.0F, y, width + 16.0F, 22.0F});
    const float text_y = y + (22.0F - pen.height_of(font)) / 2.0F;
    const float drawn = pen.text(font, right - 8.0F, text_y, palette::kDim, line, Align::right);
    pen.text(font, right - 8.0F - drawn - gap, text_y, palette::kAmber, trouble, Align::right);
}

}  // namespace

void draw_dance(const Pen& pen, const OverlayState& state, const Canvas& canvas) {
    // A narrow picture keeps the cards on the left only.
    if (!has_two_columns(canvas)) {
        return;
    }
    const Box box{canvas.width - kMargin - kCardWidth, kMargin, kCardWidth, kTopHeight};
    pen.panel(box);
    draw_genre(pen, state, box);
    draw_figure(pen, state, box);
    draw_health(pen, state, box.right(), box.bottom() + 8.0F);
}

}  // namespace raks::render
