#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/show/clip_marks.hpp"
#include "engine/show/clip_transport.hpp"
#include "engine/show/window_loop.hpp"
#include "render/scene/clip_body.hpp"

namespace raks::engine {

/// A frame of a clip that can be jumped to, and why.
struct ClipHighlight {
    std::size_t frame = 0;
    std::string name;          ///< "worst"
    std::vector<float> curve;  ///< OverlayTransport::curve
};

/// Shows recorded motion, frame by frame: the transport's keys and bar, names (N), trails (T), the
/// frame of interest (W). The camera follows the body; a person who pans moves it beside the body.
/// Threads: main.
class ClipContent final : public WindowContent {
 public:
    /// How it begins.
    struct Options {
        ShownMarks marks{};
        std::optional<ClipHighlight> highlight{};
        std::vector<std::size_t> framed_frames{};  ///< those that the picture has room for
        double frames_per_second = 30.0;           ///< of the clip
        bool has_bar = true;  ///< whether the picture has room for the transport's bar
    };

    /// `recorded` must outlive this.
    ClipContent(const render::RecordedBodies& recorded, ClipTransport transport, Options options)
        : recorded_(recorded), transport_(std::move(transport)), options_(std::move(options)) {}

    /// The transport's keys, and those above.
    bool handle(const KeyEvent& key) override;
    /// The transport's bar: pauses, seeks, jumps.
    void use(render::OverlayControl control, double share) override;
    [[nodiscard]] std::vector<render::HelpRow> own_keys() const override;   ///< of the above
    void advance(double seconds) override { transport_.advance(seconds); }  ///< plays the clip
    /// The frame's stick figure, its marks and the transport.
    void draw(const WindowPicture& picture, render::OverlayState& overlay) override;
    [[nodiscard]] bool is_finished() const override { return false; }  ///< a clip plays in a loop
    /// A recorded body is drawn as its own.
    [[nodiscard]] bool has_avatar() const override { return false; }
    /// By the size of the body and the room that its frames take.
    [[nodiscard]] render::Camera framed(render::Camera preset) const override;

    /// A frame as a film has it: without the transport. The scene's camera is panned to the body.
    void draw_frame(std::size_t frame,
                    render::Renderer& renderer,
                    render::Scene& scene,
                    const render::FrameTarget& target,
                    render::OverlayState& overlay);

 private:
    void follow(const render::ClipBody& body, render::Camera& camera);

    const render::RecordedBodies& recorded_;
    ClipTransport transport_;
    Options options_;
    ClipMarks marks_;
    std::optional<glm::vec3> followed_;  // the target that the camera was given last
    glm::vec3 beside_{};                 // how far a person has panned from the body
    bool is_held_ = false;               // the camera, by a person's hand
};

/// The camera at such a distance and height that a standing body with its hands up, of any size,
/// fills a tile or a window.
[[nodiscard]] render::Camera framed_for(render::Camera camera,
                                        const render::RecordedBodies& recorded);

}  // namespace raks::engine
