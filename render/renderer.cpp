#include "render/renderer.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar_arrival.hpp"
#include "render/avatar_painter.hpp"
#include "render/drawing_state.hpp"
#include "render/dress.hpp"
#include "render/frame_uniforms.hpp"
#include "render/gl/objects.hpp"
#include "render/gl/shadow_map.hpp"
#include "render/key_painter.hpp"
#include "render/sphere_painter.hpp"
#include "render/stage_painter.hpp"
#include "render/surface_upload.hpp"

namespace raks::render {
namespace {

constexpr GLsizei kShadowSide = 2048;
constexpr int kRings = 4;  // of frame.glsl

std::string text_of(const GLubyte* text) {
    return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);  // GL's own type
}

/// A software driver allocates some MB for each picture and frees them after it. By itself glibc
/// may give them back to the kernel every time, and fresh pages cost more than the picture: with
/// llvmpipe at 1280x720 45 CPU-ms for 18, in some runs and not in others, as the heap lies.
void keep_freed_memory() noexcept {
#ifdef __GLIBC__
    constexpr int kMebibyte = 1 << 20;
    // NOLINTBEGIN(concurrency-mt-unsafe): it takes the allocator's own lock
    mallopt(M_TRIM_THRESHOLD, 32 * kMebibyte);
    // Setting one ends the adaptation of both.
    mallopt(M_MMAP_THRESHOLD, 16 * kMebibyte);
    // NOLINTEND(concurrency-mt-unsafe)
#endif
}

/// Errors when no context of OpenGL 3.3 or later is current.
Expected<void> check_context() {
    if (epoxy_gl_version() < 33) {
        return fail("drawing needs OpenGL 3.3, the driver \"" + text_of(glGetString(GL_RENDERER)) +
                    "\" has \"" + text_of(glGetString(GL_VERSION)) + "\"");
    }
    return {};
}

/// Clears the target's rectangle (the scissor is on) to what the backdrop needs.
void clear(const Scene& scene) noexcept {
    if (scene.backdrop != Backdrop::stage) {
        glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    } else {
        // What the floor mirrors besides the dancer.
        const glm::vec3 horizon =
            display_colour(lit_backdrop(scene, scene.theme->background_horizon));
        glClearColor(horizon.r, horizon.g, horizon.b, 1.0F);
    }
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// A dancer of this picture and who paints it.
struct Painted {
    AvatarPainter* painter;
    std::size_t number;
    int outfit;
};

/// All of a picture's dancers: who paints them, where they are, and their sizes.
struct Bodies {
    std::vector<Painted> painted;
    std::vector<motion::WorldPose> places;
    std::vector<float> sizes;
};

}  // namespace

struct Renderer::Parts {
    Quality quality;
    std::string notice;
    BodyPrograms body_programs;
    SurfacePrograms surface_programs;
    StagePainter stage;
    std::optional<SpherePainter> spheres;  // prepare_spheres()
    KeyPainter key;
    std::optional<gl::ShadowMap> shadow_map;  // Quality::high
    gl::Buffer frame;
    gl::Buffer blobs;
    std::vector<gl::Buffer> dresses;  // by dancer of the picture
    // By handle; null where one was removed. What they point to above stays where it is.
    std::vector<std::unique_ptr<AvatarPainter>> avatars;
    std::optional<AvatarArrival> arrival;

    AvatarHandle keep(std::unique_ptr<AvatarPainter> painter);
    void upload(const FrameView& view) const noexcept;
    void upload_dresses(const Scene& scene, std::span<const Painted> dancers);
    void wear(std::size_t dancer) const noexcept;
    [[nodiscard]] AvatarPainter* find(AvatarHandle handle) const noexcept;
    void draw(const Scene& scene, const Bodies& bodies, const FrameTarget& target);
    void draw_picture(const Scene& scene, const Bodies& bodies, const FrameTarget& target);
    void draw_shadow_map(const Scene& scene,
                         std::span<const Painted> dancers,
                         const glm::mat4& clip_from_light);
    void draw_body(const Scene& scene, const Painted& dancer) const;
    void draw_stage(const Scene& scene) const noexcept;
    void draw_beams(const Scene& scene) const noexcept;
};

/// The driver gets new buffer stores each time, so that it need not wait for the last picture.
void Renderer::Parts::upload(const FrameView& view) const noexcept {
    glBindBuffer(GL_UNIFORM_BUFFER, frame.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(view.uniforms), &view.uniforms, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, gl::kFrameBinding, frame.name());
    glBindBuffer(GL_UNIFORM_BUFFER, blobs.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(view.blobs), &view.blobs, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, gl::kBlobsBinding, blobs.name());
}

void Renderer::Parts::upload_dresses(const Scene& scene, std::span<const Painted> dancers) {
    while (dresses.size() < dancers.size()) {
        dresses.emplace_back();
    }
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        const DressColours colours =
            dress_colours(scene, dancers[i].outfit, dancers[i].painter->style());
        glBindBuffer(GL_UNIFORM_BUFFER, dresses[i].name());
        glBufferData(GL_UNIFORM_BUFFER, sizeof(colours), &colours, GL_STREAM_DRAW);
    }
}

void Renderer::Parts::wear(std::size_t dancer) const noexcept {
    glBindBufferBase(GL_UNIFORM_BUFFER, gl::kDressBinding, dresses[dancer].name());
}

AvatarPainter* Renderer::Parts::find(AvatarHandle handle) const noexcept {
    const auto place = static_cast<std::size_t>(handle.number);
    return place < avatars.size() ? avatars[place].get() : nullptr;
}

/// What is keyed out is drawn on nothing first, and apart: its edges must not mix with the colour.
void Renderer::Parts::draw(const Scene& scene, const Bodies& bodies, const FrameTarget& target) {
    if (scene.backdrop != Backdrop::key) {
        draw_picture(scene, bodies, target);
        return;
    }
    Scene alone = scene;
    alone.has_shadow = false;
    alone.has_rings = false;
    draw_picture(alone, bodies, key.canvas(target));
    key.paint(scene.key, target);
}

void Renderer::Parts::draw_picture(const Scene& scene,
                                   const Bodies& bodies,
                                   const FrameTarget& target) {
    const FrameView view = frame_view(scene, bodies.places, bodies.sizes, target);
    const std::span<const Painted> dancers = bodies.painted;
    upload(view);
    // Before the target is bound: it draws into a framebuffer of its own.
    upload_dresses(scene, dancers);
    draw_shadow_map(scene, dancers, view.clip_from_light);

    const DrawingState state(target);
    if (arrival) {
        arrival->warm_up();  // what it draws is cleared away
    }
    clear(scene);
    glPolygonMode(GL_FRONT_AND_BACK, scene.is_wireframe ? GL_LINE : GL_FILL);
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        wear(i);
        draw_body(scene, dancers[i]);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (spheres && !scene.spheres.empty()) {
        spheres->draw(scene.spheres);
    }
    draw_stage(scene);
    glEnable(GL_CULL_FACE);
    // Last what lets the stage through: glass, lashes, veils.
    glPolygonMode(GL_FRONT_AND_BACK, scene.is_wireframe ? GL_LINE : GL_FILL);
    for (const Painted& dancer : dancers) {
        dancer.painter->draw_blended(dancer.number, scene);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    // A window with alpha must not show the desktop through the stage.
    if (scene.backdrop == Backdrop::stage) {
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
}

void Renderer::Parts::draw_shadow_map(const Scene& scene,
                                      std::span<const Painted> dancers,
                                      const glm::mat4& clip_from_light) {
    if (shadow_map) {
        // Both sides cast shadow. The scissor is the target's rectangle, not the map's.
        glDisable(GL_CULL_FACE);
        glDisable(GL_SCISSOR_TEST);
        shadow_map->begin();
        for (const Painted& dancer : dancers) {
            dancer.painter->draw_depth(dancer.number, scene, clip_from_light);
        }
        shadow_map->end();
    }
}

/// The body and, in high quality, its image in the floor, mirrored at y = 0. Mirroring turns
/// triangles round, hence the other front face.
void Renderer::Parts::draw_body(const Scene& scene, const Painted& dancer) const {
    dancer.painter->draw_solid(dancer.number, scene, BodyPainter::Image::upright);
    if (quality == Quality::high && scene.backdrop == Backdrop::stage) {
        glFrontFace(GL_CW);
        dancer.painter->draw_solid(dancer.number, scene, BodyPainter::Image::mirrored);
        glFrontFace(GL_CCW);
    }
}

/// Floor over the mirrored body, then rings, then whatever is still empty.
void Renderer::Parts::draw_stage(const Scene& scene) const noexcept {
    if (scene.backdrop != Backdrop::stage && !scene.has_shadow && !scene.has_rings) {
        return;
    }
    glDisable(GL_CULL_FACE);
    // A fast floor shows no reflection, so it needs no blending, except over a transparent
    // backdrop.
    const bool is_opaque = quality == Quality::fast && scene.backdrop == Backdrop::stage;
    if (!is_opaque) {
        glEnable(GL_BLEND);
    }
    stage.draw_floor(scene.theme->tiles);
    glEnable(GL_BLEND);
    // Rings lie 2 mm over the floor and blend with it; they hide nothing.
    glDepthMask(GL_FALSE);
    stage.draw_rings(kRings);
    glDisable(GL_BLEND);
    // Last, where nothing is yet: first it would cost a tenth more on llvmpipe.
    if (scene.backdrop == Backdrop::stage) {
        stage.draw_backdrop();
        draw_beams(scene);
    }
}

/// Dancers hide what is behind them, beams hide nothing.
void Renderer::Parts::draw_beams(const Scene& scene) const noexcept {
    const LightBeams& beams = scene.theme->beams;
    if (beams.count == 0 && beams.haze <= 0.0F) {
        return;
    }
    glEnable(GL_BLEND);
    stage.draw_beams(beams);
    glDisable(GL_BLEND);
}

Expected<Renderer> Renderer::create(const RendererConfig& config) {
    if (Expected<void> usable = check_context(); !usable) {
        return fail(std::move(usable.error()));
    }
    const std::string driver = text_of(glGetString(GL_RENDERER));
    const Quality quality = resolve_quality(config.quality, driver);
    if (resolve_quality(Quality::automatic, driver) == Quality::fast) {
        keep_freed_memory();
    }
    Expected<BodyPrograms> programs = BodyPrograms::build(quality);
    if (!programs) {
        return fail(std::move(programs.error()));
    }
    Expected<StagePainter> stage = StagePainter::create(quality);
    if (!stage) {
        return fail(std::move(stage.error()));
    }
    Expected<KeyPainter> key = KeyPainter::create(quality);
    if (!key) {
        return fail(std::move(key.error()));
    }
    std::optional<gl::ShadowMap> shadow_map;
    if (quality == Quality::high) {
        Expected<gl::ShadowMap> made = gl::ShadowMap::create(kShadowSide);
        if (!made) {
            return fail(std::move(made.error()));
        }
        shadow_map = std::move(*made);
    }
    std::string notice;
    if (config.quality == Quality::automatic && quality == Quality::fast) {
        notice = "drawing in software (" + driver +
                 ") with fast shaders; --quality high draws shadow, reflection and smooth edges";
    }
    return Renderer(std::unique_ptr<Parts>(new Parts{quality,
                                                     std::move(notice),
                                                     std::move(*programs),
                                                     SurfacePrograms(quality),
                                                     std::move(*stage),
                                                     {},
                                                     std::move(*key),
                                                     std::move(shadow_map),
                                                     {},
                                                     {},
                                                     {},
                                                     {},
                                                     {}}));
}

Expected<Renderer> Renderer::create(const Avatar& avatar, const RendererConfig& config) {
    Expected<Renderer> renderer = create(config);
    if (!renderer) {
        return renderer;
    }
    if (Expected<AvatarHandle> handle = renderer->add(avatar); !handle) {
        return fail(std::move(handle.error()));
    }
    return renderer;
}

Expected<AvatarHandle> Renderer::add(const Avatar& avatar) {
    // Not owned: it lives as long as this call.
    AvatarArrival arrival(
        {std::shared_ptr<void>(), &avatar}, parts_->body_programs, parts_->surface_programs);
    for (;;) {
        const Expected<bool> is_done = arrival.next();
        if (!is_done) {
            return fail(is_done.error());
        }
        if (*is_done) {
            return parts_->keep(std::move(arrival).painter());
        }
    }
}

void Renderer::begin_adding(std::shared_ptr<const Avatar> avatar) {
    parts_->arrival.emplace(std::move(avatar), parts_->body_programs, parts_->surface_programs);
}

Expected<std::optional<AvatarHandle>> Renderer::add_pieces(Nanos most) {
    std::optional<AvatarArrival>& arrival = parts_->arrival;
    const HostTime until = HostClock::now() + most;
    bool is_done = false;
    do {
        const Expected<bool> next = arrival->next();
        if (!next) {
            arrival.reset();
            return fail(next.error());
        }
        is_done = *next;
    } while (!is_done && HostClock::now() < until);
    if (!arrival->is_warm()) {
        return std::nullopt;
    }
    const AvatarHandle handle = parts_->keep(std::move(*arrival).painter());
    arrival.reset();
    return handle;
}

/// Its handle.
AvatarHandle Renderer::Parts::keep(std::unique_ptr<AvatarPainter> painter) {
    const auto free = std::find(avatars.begin(), avatars.end(), nullptr);
    const auto place = static_cast<int>(free - avatars.begin());
    if (free == avatars.end()) {
        avatars.push_back(std::move(painter));
    } else {
        *free = std::move(painter);
    }
    return AvatarHandle{place};
}

void Renderer::remove(AvatarHandle handle) noexcept {
    if (parts_->find(handle) != nullptr) {
        parts_->avatars[static_cast<std::size_t>(handle.number)].reset();
    }
}

Renderer::Renderer(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::draw(const Scene& scene, const motion::Pose& pose, const FrameTarget& target) {
    draw(scene, std::span(&pose, 1), target);
}

void Renderer::draw(const Scene& scene,
                    std::span<const motion::Pose> poses,
                    const FrameTarget& target) {
    std::vector<Dancer> dancers;
    dancers.reserve(poses.size());
    const AvatarPainter* const painter = parts_->find({});
    for (const motion::Pose& pose : poses) {
        dancers.push_back({.avatar = {}, .pose = painter != nullptr ? painter->own(pose) : pose});
    }
    draw(scene, std::span<const Dancer>(dancers), target);
}

void Renderer::draw(const Scene& scene,
                    std::span<const Dancer> dancers,
                    const FrameTarget& target) {
    if (target.width < 1 || target.height < 1) {
        return;
    }
    for (const auto& avatar : parts_->avatars) {
        if (avatar != nullptr) {
            avatar->begin_picture();
        }
    }
    Bodies bodies;
    for (const Dancer& dancer : dancers) {
        AvatarPainter* const painter = parts_->find(dancer.avatar);
        if (painter != nullptr) {
            bodies.painted.push_back({painter, painter->take(dancer, scene.view), dancer.outfit});
            bodies.places.push_back(motion::world_pose(painter->skeleton(), dancer.pose));
            bodies.sizes.push_back(painter->size());
        }
    }
    if (!bodies.painted.empty()) {
        parts_->draw(scene, bodies, target);
    }
}

void Renderer::draw(const Scene& scene, const ClipBody& body, const FrameTarget& target) {
    AvatarPainter* const painter = parts_->find({});
    if (target.width < 1 || target.height < 1 || painter == nullptr) {
        return;
    }
    Scene as_sticks = scene;
    // Materials follow the view: a recorded body has the sticks' colours.
    as_sticks.view = View::stick;
    painter->begin_picture();
    const Painted dancer{painter, painter->take({}, View::stick), 0};
    painter->body().set_recorded_body(body.shape);
    parts_->draw(as_sticks, {{dancer}, {body.landmarks}, {1.0F}}, target);
}

Expected<void> Renderer::prepare_spheres() {
    Expected<SpherePainter> made = SpherePainter::create();
    if (!made) {
        return fail(std::move(made.error()));
    }
    parts_->spheres = std::move(*made);
    return {};
}

Quality Renderer::quality() const noexcept { return parts_->quality; }

int Renderer::samples() const noexcept { return parts_->quality == Quality::high ? 4 : 1; }

std::string_view Renderer::notice() const noexcept { return parts_->notice; }

Quality resolve_quality(Quality wanted, std::string_view gl_renderer) noexcept {
    if (wanted != Quality::automatic) {
        return wanted;
    }
    // Names of Mesa's software drivers, and "Software Rasterizer" and the like.
    for (const std::string_view software : {"llvmpipe", "softpipe", "swrast", "Software"}) {
        if (gl_renderer.find(software) != std::string_view::npos) {
            return Quality::fast;
        }
    }
    return Quality::high;
}

}  // namespace raks::render
