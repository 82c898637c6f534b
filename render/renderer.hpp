#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/gl/frame_target.hpp"
#include "render/scene/clip_figure.hpp"
#include "render/scene/scene.hpp"

namespace raks::render {

/// The body to draw; render/avatar/avatar.hpp.
struct Avatar;

/// How much work a picture may be. `automatic` is `fast` on software drivers (llvmpipe, softpipe,
/// swrast), else `high`.
///   fast: light per vertex, soft blobs for a shadow, no reflection, no anti-aliasing;
///         16 CPU-ms a picture at 1280x720 with llvmpipe
///   high: light per fragment, shadow map, reflection, 4 samples a pixel; meant for GPUs
enum class Quality { automatic, fast, high };

/// What may be chosen when a renderer is made.
struct RendererConfig {
    /// As the user asked; see resolve_quality.
    Quality quality = Quality::automatic;
};

/// Draws an avatar, or several alike, on its stage with OpenGL 3.3 core: works in whatever context
/// is current when it is created (window or off-screen) and must be used and destroyed with that
/// one current. The same pose, scene and size give the same pixels on the same machine. Threads:
/// the context's. Real-time: no (draw() itself allocates nothing; the driver may).
class Renderer {
 public:
    /// Uploads the avatar and compiles the shaders. The avatar may be destroyed afterwards.
    /// Precondition: an OpenGL context is current on this thread.
    /// Errors: OpenGL older than 3.3, a shader or a shadow map that the driver refuses.
    [[nodiscard]] static Expected<Renderer> create(const Avatar& avatar,
                                                   const RendererConfig& config = {});
    /// The source may only be destroyed or assigned to.
    Renderer(Renderer&&) noexcept;
    /// As the constructor.
    Renderer& operator=(Renderer&&) noexcept;
    /// Frees meshes and programs; the context must be current.
    ~Renderer();

    /// Draws the whole picture: clears `target`'s rectangle, then stage and dancer. A rectangle
    /// without area (a minimized window) draws nothing. Leaves `target` bound and depth test,
    /// blending, face culling and scissor off.
    void draw(const Scene& scene, const motion::Pose& pose, const FrameTarget& target);
    /// Several dancers, kMostDancers at most; more are left out.
    void draw(const Scene& scene, std::span<const motion::Pose> poses, const FrameTarget& target);
    /// Dancers that one picture can show: what the uniform block's shadow blobs are enough for.
    static constexpr std::size_t kMostDancers = 4;

    /// The same with a recorded body's own stick figure in the avatar's place, whatever the scene's
    /// view is. (Takes the figure into the driver's memory: 1 ms for 60 joints on llvmpipe.)
    void draw(const Scene& scene, const ClipFigure& figure, const FrameTarget& target);

    /// Quality::fast or Quality::high: what `automatic` became.
    [[nodiscard]] Quality quality() const noexcept;

    /// Samples a pixel that a target or window for this quality should have: 1 or 4.
    [[nodiscard]] int samples() const noexcept;

    /// One line to tell the user once, or empty: that a software driver draws with fast shaders.
    [[nodiscard]] std::string_view notice() const noexcept;

 private:
    struct Parts;
    explicit Renderer(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

/// Quality from what the user asked for and the driver's GL_RENDERER string.
[[nodiscard]] Quality resolve_quality(Quality wanted, std::string_view gl_renderer) noexcept;

}  // namespace raks::render
