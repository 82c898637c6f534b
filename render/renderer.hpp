#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/gl/frame_target.hpp"
#include "render/scene/clip_body.hpp"
#include "render/scene/scene.hpp"

namespace raks::render {

/// The body to draw; render/avatar/avatar.hpp.
struct Avatar;
/// What moves it, in one picture; render/avatar/avatar_rig.hpp.
struct RigState;

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

/// An avatar in a renderer.
struct AvatarHandle {
    int number = 0;
};

/// One dancer of a picture.
struct Dancer {
    AvatarHandle avatar;
    motion::Pose pose;  ///< on this avatar's own body
    /// What the drivers of an avatar from a file made of the pose; null: face and tails at rest.
    const RigState* state = nullptr;
    int outfit = 0;  ///< which of the theme's outfits a painted body wears (dress_colours)
};

/// Draws avatars on their stage with OpenGL 3.3 core: works in whatever context is current when it
/// is created (window or off-screen) and must be used and destroyed with that one current. The same
/// poses, scene and size give the same pixels on the same machine. Threads: the context's.
/// Real-time: no (the driver may allocate).
class Renderer {
 public:
    /// Compiles the shaders of the stage.
    /// Precondition: an OpenGL context is current on this thread.
    /// Errors: OpenGL older than 3.3, a shader or a shadow map that the driver refuses.
    [[nodiscard]] static Expected<Renderer> create(const RendererConfig& config = {});
    /// The same with a first avatar, which has handle 0.
    [[nodiscard]] static Expected<Renderer> create(const Avatar& avatar,
                                                   const RendererConfig& config = {});
    /// The source may only be destroyed or assigned to.
    Renderer(Renderer&&) noexcept;
    /// As the constructor.
    Renderer& operator=(Renderer&&) noexcept;
    /// Frees meshes and programs; the context must be current.
    ~Renderer();

    /// Uploads an avatar, which may be destroyed afterwards. Errors: a shader that the driver
    /// refuses.
    [[nodiscard]] Expected<AvatarHandle> add(const Avatar& avatar);
    /// Begins to take an avatar piece by piece while others are drawn; one that is on its way is
    /// given up.
    void begin_adding(std::shared_ptr<const Avatar> avatar);
    /// Takes further pieces of it for about `most`, a few milliseconds; called once a picture,
    /// before it is drawn. Its handle once all is there, which takes pictures that are drawn, too:
    /// drivers finish a shader when it is first used. Errors: a shader that the driver refuses; the
    /// avatar is given up. Precondition: begin_adding.
    [[nodiscard]] Expected<std::optional<AvatarHandle>> add_pieces(Nanos most);
    /// Frees what an avatar has in the driver's memory; its handle may be given out again.
    void remove(AvatarHandle handle) noexcept;

    /// Draws the whole picture: clears `target`'s rectangle, then stage and dancers. A rectangle
    /// without area (a minimized window) draws nothing. Leaves `target` bound and depth test,
    /// blending, face culling and scissor off. Dancers with a handle that there is none of are left
    /// out.
    void draw(const Scene& scene, std::span<const Dancer> dancers, const FrameTarget& target);
    /// Dancers that are all the first avatar, in poses of a body that stands as high as the
    /// mannequin (dance_body).
    void draw(const Scene& scene, std::span<const motion::Pose> poses, const FrameTarget& target);
    /// One dancer.
    void draw(const Scene& scene, const motion::Pose& pose, const FrameTarget& target);

    /// The same with a recorded body's own stick figure in the avatar's place, whatever the scene's
    /// view is. (Takes the body into the driver's memory: 1 ms for 60 joints on llvmpipe.)
    void draw(const Scene& scene, const ClipBody& body, const FrameTarget& target);

    /// From here on the spheres of a scene are drawn. Errors: a shader that the driver refuses.
    [[nodiscard]] Expected<void> prepare_spheres();

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
