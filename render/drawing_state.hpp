#pragma once

#include "render/gl/frame_target.hpp"
#include "render/gl/objects.hpp"

namespace raks::render {

/// Sets the state that drawing a picture needs, and takes it back.
class DrawingState {
 public:
    /// Binds the target.
    explicit DrawingState(const FrameTarget& target) noexcept {
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glViewport(target.x, target.y, target.width, target.height);
        // Clearing ignores the viewport: without the scissor it would wipe the other tiles of a
        // sheet.
        const PixelBox part =
            target.part.value_or(PixelBox{target.x, target.y, target.width, target.height});
        glScissor(part.x, part.y, part.width, part.height);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glEnable(GL_SCISSOR_TEST);
        glEnable(GL_DEPTH_TEST);
        // The backdrop lies at the far end, where depth is equal to the cleared one.
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glFrontFace(GL_CCW);
        glDisable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // premultiplied colours
    }
    /// It stands for the context's state.
    DrawingState(const DrawingState&) = delete;
    /// As the constructor.
    DrawingState& operator=(const DrawingState&) = delete;
    /// Leaves the target bound and all else off.
    ~DrawingState() {
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
        glFrontFace(GL_CCW);
        glBindVertexArray(0);
        glUseProgram(0);
    }
};

}  // namespace raks::render
