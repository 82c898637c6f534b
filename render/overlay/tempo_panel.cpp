#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/overlay/panels.hpp"

namespace raks::render {
namespace {

constexpr Box kPanel{kMargin, kMargin, kCardWidth, kTopHeight};

// What the card can say of the tempo.
enum class Tempo { silent, listening, found };

/// Silence counts more than the last tempo; a tempo of little confidence is not yet found.
Tempo tempo_of(const OverlayState& state) {
    if (state.is_silent) {
        return Tempo::silent;
    }
    return state.bpm > 0.0 && state.confidence >= kLockedConfidence ? Tempo::found
                                                                    : Tempo::listening;
}

/// How bright a beat still is after `phase` beats, [0, 1].
float flash(double phase) { return static_cast<float>(std::exp(-3.5 * phase)); }

/// The tempo with its decimal smaller, or dashes where there is none.
void draw_number(const Pen& pen, const OverlayState& state, Tempo tempo) {
    const float x = kPanel.x + kInner;
    const float y = kPanel.y + 10.0F;
    const OverlayFonts& fonts = pen.fonts();
    // Puts the small text on the large number's base line.
    const float unit_y = y + pen.height_of(fonts.large) - pen.height_of(fonts.body) - 9.0F;
    if (tempo == Tempo::silent || state.bpm <= 0.0) {
        const float width = pen.text(fonts.large, x, y, palette::kDim, "\xE2\x80\x93 \xE2\x80\x93");
        pen.text(fonts.body, x + width + 8.0F, unit_y, palette::kDim, "BPM");
        return;
    }
    const Colour colour = tempo == Tempo::found ? palette::kText : palette::kDim;
    const std::string number = fmt::format("{:.1f}", state.bpm);
    const std::size_t point = number.find('.');
    const float whole = pen.text(fonts.large, x, y, colour, number.substr(0, point));
    const float rest =
        pen.text(fonts.bold, x + whole + 1.0F, unit_y - 2.0F, palette::kDim, number.substr(point));
    pen.text(fonts.body, x + whole + rest + 8.0F, unit_y, palette::kDim, "BPM");
}

/// One dot a beat of the bar; the current beat flashes and fades. Without a known downbeat one dot
/// flashes on every beat.
void draw_dots(const Pen& pen, const OverlayState& state, Tempo tempo) {
    const int dots = state.is_bar_known ? state.beats_per_bar : 1;
    const float step = std::min(30.0F, (kPanel.width - 2.0F * kInner) / static_cast<float>(dots));
    const float y = kPanel.y + 82.0F;
    const int beat = static_cast<int>(state.bar_position) % dots;
    // Beat phase, [0, 1).
    const double phase = state.bar_position - std::floor(state.bar_position);
    for (int i = 0; i < dots; ++i) {
        const float x = kPanel.x + kInner + 8.0F + step * static_cast<float>(i);
        const bool is_downbeat = state.is_bar_known && i == 0;
        const float radius = std::min(is_downbeat ? 8.0F : 6.0F, step * 0.4F);
        // Empty rings: without a sure tempo no beat is shown.
        if (tempo != Tempo::found) {
            pen.ring(x, y, radius, palette::kTrough);
            continue;
        }
        const Colour colour = is_downbeat ? palette::kAmber : palette::kTeal;
        pen.dot(x, y, radius, i == beat ? colour.faded(0.45F) : palette::kTrough);
        if (i == beat) {
            pen.dot(
                x, y, radius * (1.0F + 0.9F * flash(phase)), colour.faded(0.30F * flash(phase)));
            pen.dot(x, y, radius, colour.faded(flash(phase)));
        }
    }
}

/// State in a word, confidence as a number and a bar.
void draw_confidence(const Pen& pen, const OverlayState& state, Tempo tempo) {
    const float y = kPanel.bottom() - 32.0F;
    const float x = kPanel.x + kInner;
    const std::string word = tempo == Tempo::silent ? std::string("silence")
                             : state.rival_bpm > 0.0
                                 ? fmt::format("{:.0f} or {:.0f}?", state.bpm, state.rival_bpm)
                             : tempo == Tempo::found ? std::string("locked")
                                                     : std::string("listening");
    const Colour colour = tempo == Tempo::found ? palette::kTeal : palette::kDim;
    pen.text(pen.fonts().small, x, y, colour, word);
    const float confidence = tempo == Tempo::silent ? 0.0F : state.confidence;
    pen.text(pen.fonts().small,
             kPanel.right() - kInner,
             y,
             palette::kDim,
             fmt::format("{:.0f} %", confidence * 100.0F),
             Align::right);
    pen.bar({x, y + 17.0F, kPanel.width - 2.0F * kInner, 3.0F}, confidence, colour);
}

}  // namespace

void draw_small_tempo(const Pen& pen, const OverlayState& state) {
    constexpr float kSmallMargin = 8.0F;
    const ImFont* const font = pen.fonts().body;
    const Tempo tempo = tempo_of(state);
    const std::string line = tempo == Tempo::silent ? std::string("silence")
                             : state.bpm > 0.0      ? fmt::format("{:.0f} BPM", state.bpm)
                                                    : std::string("listening");
    const Box box{kSmallMargin, kSmallMargin, pen.width_of(font, line) + 16.0F, 26.0F};
    pen.panel(box);
    pen.text(font,
             box.x + 8.0F,
             box.y + (box.height - pen.height_of(font)) / 2.0F,
             tempo == Tempo::found ? palette::kText : palette::kDim,
             line);
}

void draw_tempo(const Pen& pen, const OverlayState& state) {
    const Tempo tempo = tempo_of(state);
    pen.panel(kPanel);
    draw_number(pen, state, tempo);
    draw_dots(pen, state, tempo);
    draw_confidence(pen, state, tempo);
}

}  // namespace raks::render
