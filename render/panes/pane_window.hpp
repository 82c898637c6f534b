// Pane window: panes in a window on the screen.
#pragma once

#include <functional>
#include <string>

#include "base/expected.hpp"
#include "render/gl/window.hpp"
#include "render/panes/pane_host.hpp"

namespace raks::render {

/// What a window of panes shows. Threads: main.
class PaneContent {
 public:
    virtual ~PaneContent() = default;  ///< contents are owned elsewhere

    /// Puts everything into a frame, and does what is asked for in it.
    virtual void draw(const PaneFrame& frame) = 0;
    /// Before each frame: whether it is to be drawn though nothing was pressed or moved, since
    /// something plays or has come.
    [[nodiscard]] virtual bool is_moving() = 0;
    /// The window was asked to close. False: it stays, for something is to be asked first.
    [[nodiscard]] virtual bool may_close() = 0;
    /// Whether the content asks for the end, which may_close() was not asked about.
    [[nodiscard]] virtual bool is_finished() const = 0;
    /// After each frame: what the window is named, UTF-8; empty: as it was opened.
    [[nodiscard]] virtual std::string title() const { return {}; }
};

/// A window with panes. Nothing is drawn while nothing happens. Threads: main. Real-time: no.
class PaneWindow {
 public:
    /// Errors: as Window, and no OpenGL.
    [[nodiscard]] static Expected<PaneWindow> create(const WindowOptions& options);

    /// Shows `content` until it is finished, the window is closed, or `is_stop_requested`, asked
    /// many times a second, says so.
    void run(PaneContent& content, const std::function<bool()>& is_stop_requested);

 private:
    PaneWindow(Window window, PaneHost host);
    void take_title(std::string title);

    Window window_;  // before the host, which needs its context
    PaneHost host_;
    std::string title_;  // that was set; empty: none
};

}  // namespace raks::render
