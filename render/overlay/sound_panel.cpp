#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "render/overlay/panels.hpp"
#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

constexpr float kMeterWidth = kCardWidth - 2.0F * kInner;
constexpr int kMeterSegments = 24;
constexpr float kSourceShare = 0.34F;  // of the width, so that the feet stay free
constexpr float kWidestSource = 460.0F;
constexpr std::size_t kMostTargets = 4;  // that the source's card has a line for
constexpr float kTargetHeight = 18.0F;

/// How many of the targets have a line.
std::size_t shown_targets(const OverlayState& state) {
    return std::min(state.targets.size(), kMostTargets);
}

/// The source's card; in a narrow picture it has the whole width to itself. It grows upwards with
/// the targets.
Box source_box(const OverlayState& state, const Canvas& canvas) {
    const float width = has_two_columns(canvas)
                            ? std::clamp(kSourceShare * canvas.width, kCardWidth, kWidestSource)
                            : canvas.width - 2.0F * kMargin;
    const auto lines = static_cast<float>(shown_targets(state));
    const float height = kBottomHeight + (lines > 0.0F ? 8.0F + lines * kTargetHeight : 0.0F);
    return {kMargin, canvas.height - kMargin - height, width, height};
}

/// The meter covers 60 dB, so 0.8 of it is -12 dBFS.
Colour segment_colour(float fraction) {
    if (fraction > 0.95F) {  // above -3 dBFS
        return palette::kRed;
    }
    return fraction > 0.8F ? palette::kAmber : palette::kTeal;
}

/// Level in segments of 2.5 dB; one is lit when the level reaches its middle.
void draw_meter(const Pen& pen, const OverlayState& state, float x, float y) {
    const float full = meter_fraction(state.level_dbfs);
    const float gap = 2.0F;
    const float width = (kMeterWidth + gap) / kMeterSegments - gap;
    for (int i = 0; i < kMeterSegments; ++i) {
        const float end = static_cast<float>(i + 1) / kMeterSegments;
        const bool is_lit = full >= end - 0.5F / kMeterSegments;
        pen.fill({x + static_cast<float>(i) * (width + gap), y, width, 9.0F},
                 is_lit ? segment_colour(end) : palette::kTrough,
                 1.0F);
    }
}

/// A file has the sign that a click uses; a live input, which nobody can pause, a dot, red while
/// there is sound.
void draw_state_sign(const Pen& pen, const OverlayState& state, float x, float y) {
    if (state.position) {
        draw_play_sign(pen, state.is_paused, x, y);
    } else {
        pen.dot(x, y, 6.0F, state.is_silent ? palette::kDim : palette::kRed);
    }
}

/// "1:05 / 3:20", or in words where there is no position.
std::string time_text(const OverlayState& state) {
    if (!state.position) {
        const std::string_view how = state.is_paused ? "paused" : "live";
        return state.song.empty() ? std::string(how) : fmt::format("{}   {}", how, state.source);
    }
    std::string text = clock_text(*state.position);
    if (state.duration) {
        text += " / " + clock_text(*state.duration);
    }
    return state.is_paused ? "paused  " + text : text;
}

/// What the tagger calls the music, at the right of the line of the time: as many words as there is
/// room for.
void draw_tags(const Pen& pen, const OverlayState& state, const Box& box, float down) {
    const OverlayFonts& fonts = pen.fonts();
    const float right = box.right() - kInner;
    const float room =
        right - (box.x + kInner + 26.0F) - pen.width_of(fonts.small, time_text(state)) - 18.0F;
    std::string text;
    for (const std::string_view tag : state.tags) {
        const std::string more =
            text.empty() || tag.empty() ? std::string(tag) : fmt::format("{}, {}", text, tag);
        if (!tag.empty() && pen.width_of(fonts.small, more) <= room) {
            text = more;
        }
    }
    pen.text(fonts.small, right, box.y + down, palette::kDim, text, Align::right, room);
}

/// One line each, the last ones left out where they are too many.
void draw_targets(const Pen& pen, const OverlayState& state, const Box& box) {
    const float left = box.x + kInner;
    for (std::size_t i = 0; i < shown_targets(state); ++i) {
        const OverlayTarget& target = state.targets[i];
        pen.text(pen.fonts().small,
                 left,
                 box.y + 10.0F + static_cast<float>(i) * kTargetHeight,
                 target.is_troubled ? palette::kAmber : palette::kDim,
                 target.text,
                 Align::left,
                 box.right() - kInner - left);
    }
}

}  // namespace

OverlayControls draw_source(const Pen& pen, const OverlayState& state, const Canvas& canvas) {
    if (!has_two_rows(canvas)) {
        return {};
    }
    OverlayControls controls;
    const OverlayFonts& fonts = pen.fonts();
    const Box card = source_box(state, canvas);
    pen.panel(card);
    draw_targets(pen, state, card);
    const Box box{card.x, card.bottom() - kBottomHeight, card.width, kBottomHeight};
    const float left = box.x + kInner + 26.0F;
    const float right = box.right() - kInner;
    draw_state_sign(pen, state, box.x + kInner + 6.0F, box.y + box.height / 2.0F);
    pen.text(fonts.body,
             left,
             box.y + 13.0F,
             palette::kText,
             !state.song.empty()    ? state.song
             : state.source.empty() ? "no source"
                                    : state.source,
             Align::left,
             right - left);
    // Only a source of known length has a position bar; without it the time moves up.
    const bool has_end = state.position && state.duration && *state.duration > 0.0;
    if (has_end) {
        pen.bar({left, box.y + 39.0F, right - left, 4.0F},
                static_cast<float>(*state.position / *state.duration),
                palette::kAmber);
    }
    pen.text(fonts.small,
             left,
             box.y + (has_end ? 50.0F : 40.0F),
             palette::kDim,
             time_text(state),
             Align::left,
             right - left);
    draw_tags(pen, state, box, has_end ? 50.0F : 40.0F);
    // The sign has the card's left edge to itself, the bar some room above and below.
    if (state.position) {
        controls.play_sign = area_of(pen, {box.x, box.y, left - box.x - 4.0F, box.height});
    }
    if (has_end) {
        controls.position = area_of(pen, {left, box.y + 33.0F, right - left, 16.0F});
        controls.from = left * pen.unit();
        controls.to = right * pen.unit();
    }
    return controls;
}

void draw_level(const Pen& pen, const OverlayState& state, const Canvas& canvas) {
    if (!has_two_columns(canvas) || !has_two_rows(canvas)) {
        return;
    }
    const OverlayFonts& fonts = pen.fonts();
    const Box box{canvas.width - kMargin - kCardWidth,
                  canvas.height - kMargin - kBottomHeight,
                  kCardWidth,
                  kBottomHeight};
    pen.panel(box);
    const float x = box.x + kInner;
    const float right = box.right() - kInner;
    draw_meter(pen, state, x, box.y + 20.0F);
    // Below it the number says nothing.
    constexpr float kFloor = -60.0F;
    pen.text(fonts.small,
             x,
             box.y + 44.0F,
             palette::kDim,
             state.loudness_lufs > kFloor ? fmt::format("{:.0f} LUFS", state.loudness_lufs)
                                          : std::string("quiet"));
    if (state.volume) {
        pen.text(fonts.small,
                 right,
                 box.y + 44.0F,
                 palette::kDim,
                 fmt::format("volume {:.0f} %", *state.volume * 100.0F),
                 Align::right);
    }
}

void draw_message(const Pen& pen, const OverlayState& state, const Canvas& canvas) {
    const std::string_view message = state.message;
    if (message.empty()) {
        return;
    }
    const OverlayFonts& fonts = pen.fonts();
    const Box source = source_box(state, canvas);
    // A long message is cut with an ellipsis rather than running out of the picture.
    const float widest = canvas.width - 2.0F * (kMargin + kInner);
    const float width = std::min(pen.width_of(fonts.body, one_line(message)), widest);
    const float height = 36.0F;
    const Box box{source.x, source.y - 10.0F - height, width + 2.0F * kInner, height};
    pen.panel(box);
    pen.text(fonts.body,
             box.x + kInner,
             box.y + (height - pen.height_of(fonts.body)) / 2.0F,
             palette::kText,
             message,
             Align::left,
             widest);
}

}  // namespace raks::render
