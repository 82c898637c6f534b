#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/clip_transport.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/window.hpp"
#include "render/scene/clip_figure.hpp"

namespace raks::apps {

/// Opens a window for what `raks stick` shows. Errors: no display, no OpenGL 3.3.
[[nodiscard]] Expected<render::Window> open_stick_window(const std::string& name,
                                                         const engine::Look& look,
                                                         const engine::Settings& settings);

/// Shows `content` in the window until it is closed, Q or Esc is pressed, or a signal comes.
/// Errors: no OpenGL 3.3.
[[nodiscard]] Expected<void> show_in_window(render::Window window,
                                            const engine::Look& look,
                                            engine::WindowContent& content);

/// The camera at such a distance and height that a standing body with its hands up, of any size,
/// fills a tile or a window.
[[nodiscard]] render::Camera framed(render::Camera camera, const render::RecordedFigures& figures);

/// Shows a clip of recorded motion, frame by frame; the camera follows the body.
class ClipContent final : public engine::WindowContent {
 public:
    /// `figures` must outlive this. `framed_frames`: those that the picture has room for.
    ClipContent(const render::RecordedFigures& figures,
                engine::ClipTransport transport,
                std::vector<std::size_t> framed_frames)
        : figures_(figures),
          transport_(std::move(transport)),
          framed_frames_(std::move(framed_frames)) {}

    /// The transport's keys.
    bool handle(const KeyEvent& key) override { return transport_.handle(key); }
    [[nodiscard]] std::vector<render::HelpRow> own_keys() const override;   ///< of the transport
    void advance(double seconds) override { transport_.advance(seconds); }  ///< plays the clip
    /// The frame's stick figure.
    void draw(const engine::WindowPicture& picture, render::OverlayState& overlay) override;
    [[nodiscard]] bool is_finished() const override { return false; }  ///< a clip plays in a loop
    /// A recorded body is a figure of its own.
    [[nodiscard]] bool has_avatar() const override { return false; }
    /// By the size of the body and the room that its frames take.
    [[nodiscard]] render::Camera framed(render::Camera preset) const override;

 private:
    const render::RecordedFigures& figures_;
    engine::ClipTransport transport_;
    std::vector<std::size_t> framed_frames_;
    std::string status_;
};

}  // namespace raks::apps
