#pragma once

#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "render/gl/objects.hpp"

namespace raks::render::gl {

/// Binding points of the uniform blocks and texture units that every program shares.
inline constexpr GLuint kFrameBinding = 0;    ///< block "Frame" (shaders/frame.glsl)
inline constexpr GLuint kBonesBinding = 1;    ///< block "Bones" (shaders/skin.glsl)
inline constexpr GLuint kBlobsBinding = 2;    ///< block "Blobs" (shaders/frame.glsl)
inline constexpr GLuint kSurfaceBinding = 3;  ///< block "Surface" (shaders/surface.glsl)
inline constexpr GLuint kDressBinding = 4;    ///< block "Dress" (shaders/dress.glsl)
inline constexpr GLint kShadowUnit = 0;       ///< sampler "shadow_map"
inline constexpr GLint kPictureUnit = 15;     ///< sampler "drawn" (shaders/key.frag)

/// Which shader files make a program, each list in order, and what is #defined before them.
struct ProgramSources {
    std::string_view name;  ///< for error lines
    /// Files of the vertex shader.
    std::span<const std::string_view> vertex;
    /// Files of the fragment shader.
    std::span<const std::string_view> fragment;
    /// Macro names for both, without "#define".
    std::span<const std::string_view> defines;
};

/// A linked pair of shaders. Threads: the context's. Real-time: no.
class Program {
 public:
    /// Errors: a file that is not in shaders/, or what the driver's compiler says (its first line).
    [[nodiscard]] static Expected<Program> build(const ProgramSources& sources);
    /// Leaves `other` without a program.
    Program(Program&& other) noexcept;
    /// Exchanges the programs.
    Program& operator=(Program&& other) noexcept;
    /// Frees the program; the context must be current.
    ~Program();

    /// Makes it the program that the next draw calls run.
    void use() const noexcept { glUseProgram(name_); }
    /// Place of a plain uniform; -1 (which glUniform ignores) when the program has none.
    [[nodiscard]] GLint uniform(const char* uniform_name) const noexcept {
        return glGetUniformLocation(name_, uniform_name);
    }

 private:
    explicit Program(GLuint name) noexcept : name_(name) {}
    GLuint name_;
};

/// Text of one file of render/gl/shaders, built into the program; empty for an unknown name.
[[nodiscard]] std::string_view shader_text(std::string_view file) noexcept;

}  // namespace raks::render::gl
