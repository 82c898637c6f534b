// Pane host: draws panes into a window or a picture in memory.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"
#include "render/panes/pane_context.hpp"

namespace raks::render {

/// Draws frames of panes with OpenGL 3.3, over what the target holds. The context, a window's or an
/// off-screen one, must be current at create(), draw() and destruction. Threads: the context's.
/// Real-time: no.
class PaneHost {
 public:
    /// Errors: no usable OpenGL context.
    [[nodiscard]] static Expected<PaneHost> create();
    /// The source may only be destroyed or assigned to.
    PaneHost(PaneHost&&) noexcept;
    /// As the constructor.
    PaneHost& operator=(PaneHost&&) noexcept;
    /// Frees fonts and shaders.
    ~PaneHost();

    /// Notes what came, as PaneContext.
    void take(std::span<const WindowEvent> events);
    /// As PaneContext.
    [[nodiscard]] bool has_waiting() const noexcept;

    /// One frame: `panes` puts everything into it. `target` begins at (0, 0). Pictures that panes
    /// show must live until it is drawn.
    void draw(const FrameTarget& target,
              float scale,
              const PointerPlace& pointer,
              const std::function<void(const PaneFrame&)>& panes);

 private:
    struct Impl;
    explicit PaneHost(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::render
