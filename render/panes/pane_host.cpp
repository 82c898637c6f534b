#include "render/panes/pane_host.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <utility>

namespace raks::render {

struct PaneHost::Impl {
    PaneContext context;
    bool has_backend = false;
    int fonts_of = 0;  // generation whose texture the backend has; 0: none yet

    Impl() {
        ImGui::SetCurrentContext(context.imgui());
        has_backend = ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~Impl() {
        ImGui::SetCurrentContext(context.imgui());
        if (has_backend) {
            ImGui_ImplOpenGL3_Shutdown();
        }
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
};

PaneHost::PaneHost(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PaneHost::PaneHost(PaneHost&&) noexcept = default;
PaneHost& PaneHost::operator=(PaneHost&&) noexcept = default;
PaneHost::~PaneHost() = default;

Expected<PaneHost> PaneHost::create() {
    auto impl = std::make_unique<Impl>();
    if (!impl->has_backend) {
        return fail("panes: no OpenGL 3.3 context, or libGL.so.1 is missing (package libgl1)");
    }
    return PaneHost(std::move(impl));
}

void PaneHost::take(std::span<const WindowEvent> events) { impl_->context.take(events); }

bool PaneHost::has_waiting() const noexcept { return impl_->context.has_waiting(); }

void PaneHost::draw(const FrameTarget& target,
                    float scale,
                    const PointerPlace& pointer,
                    const std::function<void(const PaneFrame&)>& panes) {
    if (target.width <= 0 || target.height <= 0) {
        return;
    }
    // The frame notes the name of the fonts' texture, which must be there before.
    impl_->context.make_fonts(scale);
    ImGui::SetCurrentContext(impl_->context.imgui());
    ImGui_ImplOpenGL3_NewFrame();
    if (impl_->context.font_generation() !=
        std::exchange(impl_->fonts_of, impl_->context.font_generation())) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    const PaneFrame frame = impl_->context.begin({target.width, target.height, scale}, pointer);
    panes(frame);
    impl_->context.end();
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
}

}  // namespace raks::render
