// Pane context: one frame of panes after the other, from the events of a window to what is clicked.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/key.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/window.hpp"
#include "render/overlay/pen.hpp"

#include <glm/vec2.hpp>

struct ImGuiContext;

namespace raks::render {

/// Size of what panes stand in.
struct PaneArea {
    int width = 1280;    ///< pixels
    int height = 720;    ///< pixels
    float scale = 1.0F;  ///< pixels a unit, > 0: 1 on ordinary monitors, 2 on fine ones

    friend bool operator==(const PaneArea&, const PaneArea&) = default;
};

/// Pixels a unit in a window of this size: more in a large one, in quarters, so that letters grow
/// half as much as the window. `content_scale` as of Window.
[[nodiscard]] float pane_scale(int width, int height, float content_scale) noexcept;

/// What a pane needs to put itself into a frame. All places are in units, y down, from the top left
/// corner of the area.
struct PaneFrame {
    Pen pen;                             ///< draws in units
    Box area;                            ///< all of it
    glm::vec2 pointer{};                 ///< where it is
    std::span<const KeyEvent> keys;      ///< pressed since the frame before: one at most
    float wheel = 0.0F;                  ///< steps since then; up is positive
    std::vector<MouseButton> held;       ///< buttons that are down
    std::vector<MouseButton> went_down;  ///< since the frame before
    std::vector<std::string> dropped{};  ///< files that were dropped since then
    [[nodiscard]] bool holds(MouseButton button) const noexcept;        ///< whether it is down
    [[nodiscard]] bool has_pressed(MouseButton button) const noexcept;  ///< went down just now
    /// The rectangle of the window that a box is, for what draws a body there.
    [[nodiscard]] FrameTarget target_of(const Box& box) const noexcept;
};

/// Frames of panes. Pure computation but for fonts, which are read from their files: tests drive it
/// without a window. The same events give the same frames.
///
///     PaneContext context;
///     context.take(window.poll_events());
///     draw_something(context.begin({.width = 1280, .height = 720}, window.pointer()), state);
///     context.end();
///
/// A frame has one key, one press or release of a button, one drop of files, or motion, so that
/// each finds what the one before has changed, however quickly they come. Threads: one. Real-time:
/// no.
class PaneContext {
 public:
    PaneContext();
    PaneContext(const PaneContext&) = delete;             ///< ImGui refers to it
    PaneContext& operator=(const PaneContext&) = delete;  ///< likewise
    ~PaneContext();

    /// Notes what came, oldest first; the frames to come take it up.
    void take(std::span<const WindowEvent> events);
    /// Whether some of it waits for the next frame.
    [[nodiscard]] bool has_waiting() const noexcept { return !waiting_.empty(); }

    /// Makes the fonts of a scale, unless they are there; begin() does so, too. Whoever draws with
    /// their texture needs it before.
    void make_fonts(float scale);

    /// Begins a frame. `pointer`: where it is once all events are taken up. The frame refers to
    /// this object until end().
    [[nodiscard]] PaneFrame begin(const PaneArea& area, const PointerPlace& pointer);
    /// Ends it; what was drawn is in ImGui's draw data.
    void end();

    /// For who draws with ImGui itself; made current by begin().
    [[nodiscard]] ImGuiContext* imgui() const noexcept { return context_; }
    /// Rises when fonts were made anew: whoever holds their texture makes it anew, too.
    [[nodiscard]] int font_generation() const noexcept { return font_generation_; }

 private:
    void take_up(const PointerPlace& pointer);
    [[nodiscard]] PaneFrame frame_of(const PaneArea& area);

    ImGuiContext* context_;
    OverlayFonts fonts_;
    float font_scale_ = 0.0F;  // 0: none made yet
    int font_generation_ = 0;
    std::deque<WindowEvent> waiting_;
    std::vector<KeyEvent> keys_;  // of this frame
    std::vector<std::string> dropped_;
    PointerPlace pointer_;  // of this frame; pixels
    float wheel_ = 0.0F;
    bool has_begun_ = false;  // a first frame
    bool is_down_[3] = {};
    bool went_down_[3] = {};
};

}  // namespace raks::render
