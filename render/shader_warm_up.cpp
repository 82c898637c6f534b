#include "render/shader_warm_up.hpp"

#include <bit>
#include <span>

#include "render/avatar/avatar.hpp"
#include "render/gl/objects.hpp"
#include "render/gl/offscreen.hpp"

namespace raks::render {
namespace {

constexpr int kSide = 64;

/// A framebuffer of the formats that windows have: shaders are finished for them.
class WindowLikeTarget {
 public:
    WindowLikeTarget() {
        glBindTexture(GL_TEXTURE_2D, colour_.name());
        glTexImage2D(
            GL_TEXTURE_2D, 0, GL_RGBA8, kSide, kSide, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glBindTexture(GL_TEXTURE_2D, 0);
        glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, kSide, kSide);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glFramebufferTexture2D(
            GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
        glFramebufferRenderbuffer(
            GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    }
    [[nodiscard]] FrameTarget frame() const noexcept {
        return {.framebuffer = framebuffer_.name(), .width = kSide, .height = kSide};
    }

 private:
    gl::Framebuffer framebuffer_;
    gl::Texture colour_;
    gl::Renderbuffer depth_;
};

/// A stand-in that takes no memory. Drivers look at whether sides are powers of two.
Image stand_in(const Image& image) {
    const auto side_of = [](int side) {
        return std::has_single_bit(static_cast<unsigned>(side)) ? 2 : 3;
    };
    Image small{.width = side_of(image.width), .height = side_of(image.height), .pixels = {}};
    small.pixels.assign(
        static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) * 4, 255);
    return small;
}

/// The avatar with stand-ins for its images.
Avatar without_images(const Avatar& avatar) {
    Avatar plain;
    plain.skeleton = avatar.skeleton;
    plain.rig = avatar.rig;
    plain.surface.vertices = avatar.surface.vertices;
    plain.surface.indices = avatar.surface.indices;
    plain.surface.parts = avatar.surface.parts;
    plain.surface.skins = avatar.surface.skins;
    plain.surface.materials = avatar.surface.materials;
    plain.surface.textures = avatar.surface.textures;
    std::vector<Image> stand_ins;
    if (avatar.surface.images != nullptr) {
        for (const Image& image : *avatar.surface.images->get()) {
            stand_ins.push_back(stand_in(image));
        }
    }
    plain.surface.images = std::make_shared<SurfaceImages>(std::move(stand_ins));
    return plain;
}

}  // namespace

void warm_up_shaders(const Avatar& avatar, Quality quality) {
    if (avatar.rig == nullptr) {
        return;  // the mannequin's shaders are every renderer's own
    }
    const Expected<OffscreenContext> context = OffscreenContext::create();
    if (!context) {
        return;
    }
    Expected<Renderer> renderer = Renderer::create(without_images(avatar), {.quality = quality});
    if (!renderer) {
        return;  // the window's own renderer says why
    }
    const WindowLikeTarget target;
    motion::Pose pose;
    pose.hips_position.y = avatar.skeleton.hips_height();
    const Dancer dancer{.avatar = {}, .pose = pose, .state = nullptr};
    renderer->draw(Scene{}, std::span(&dancer, 1), target.frame());
    glFinish();
}

}  // namespace raks::render
