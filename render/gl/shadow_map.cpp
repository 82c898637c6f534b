#include "render/gl/shadow_map.hpp"

#include "render/gl/shader_program.hpp"

#include <string>

namespace raks::render::gl {

Expected<ShadowMap> ShadowMap::create(GLsizei side) {
    ShadowMap map(side);
    glBindTexture(GL_TEXTURE_2D, map.texture_.name());
    glTexImage2D(GL_TEXTURE_2D,
                 0,
                 GL_DEPTH_COMPONENT24,
                 side,
                 side,
                 0,
                 GL_DEPTH_COMPONENT,
                 GL_UNSIGNED_INT,
                 nullptr);
    // Linear filtering of a comparing sampler averages four comparisons: softer edges.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glBindFramebuffer(GL_FRAMEBUFFER, map.framebuffer_.name());
    glFramebufferTexture2D(
        GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map.texture_.name(), 0);
    // Depth alone: without this a framebuffer without colour is incomplete.
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail("the driver refuses a shadow map of " + std::to_string(side) +
                    " pixels a side; use --quality fast");
    }
    return map;
}

void ShadowMap::begin() const noexcept {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, side_, side_);
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    // Pushes the stored depth away from the light, or surfaces would shadow themselves in stripes.
    // The part that grows with the slope is what skin at a grazing angle needs.
    glPolygonOffset(1.5F, 2.0F);
}

void ShadowMap::end() const noexcept {
    glDisable(GL_POLYGON_OFFSET_FILL);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(kShadowUnit));
    glBindTexture(GL_TEXTURE_2D, texture_.name());
}

}  // namespace raks::render::gl
