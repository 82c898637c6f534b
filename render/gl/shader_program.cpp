#include "render/gl/shader_program.hpp"

#include <array>
#include <string>
#include <utility>

namespace raks::render::gl {
namespace {

/// One shader's text. GLSL 3.30 has no #include, so shared files are put one after another; #line
/// makes the driver count lines from the start of each file.
Expected<std::string> joined(const ProgramSources& sources,
                             std::span<const std::string_view> files) {
    std::string text = "#version 330 core\n";
    for (const std::string_view define : sources.defines) {
        text.append("#define ").append(define).append("\n");
    }
    for (const std::string_view file : files) {
        const std::string_view part = shader_text(file);
        if (part.empty()) {
            return fail("shader file " + std::string(file) + " is not built in");
        }
        text.append("#line 1\n").append(part);
    }
    return text;
}

/// The first complaint; what follows it is mostly its consequence.
std::string first_line(const std::string& log) {
    return log.empty() ? "no reason given" : log.substr(0, log.find('\n'));
}

/// A shader object, freed when its program has been linked.
class Shader {
 public:
    explicit Shader(GLenum stage) : name_(glCreateShader(stage)) {}
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(name_); }
    [[nodiscard]] GLuint name() const noexcept { return name_; }

    [[nodiscard]] Expected<void> compile(const std::string& text) const {
        const char* const start = text.c_str();
        glShaderSource(name_, 1, &start, nullptr);
        glCompileShader(name_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) {
            return {};
        }
        std::array<char, 1024> log{};
        glGetShaderInfoLog(name_, static_cast<GLsizei>(log.size()), nullptr, log.data());
        return fail(first_line(log.data()));
    }

 private:
    GLuint name_;
};

/// Gives a uniform block its shared binding point. A program that does not use it has none.
void bind_block(GLuint program, const char* block, GLuint binding) {
    const GLuint index = glGetUniformBlockIndex(program, block);
    if (index != GL_INVALID_INDEX) {
        glUniformBlockBinding(program, index, binding);
    }
}

/// Links and detaches, so that the shader objects are freed with their owners.
Expected<void> link(GLuint program, const Shader& vertex, const Shader& fragment) {
    glAttachShader(program, vertex.name());
    glAttachShader(program, fragment.name());
    glLinkProgram(program);
    glDetachShader(program, vertex.name());
    glDetachShader(program, fragment.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) {
        return {};
    }
    std::array<char, 1024> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    return fail(first_line(log.data()));
}

/// Compiles both stages and links them; the first error ends it.
Expected<void> compile_and_link(GLuint program, const ProgramSources& sources) {
    const Shader vertex(GL_VERTEX_SHADER);
    const Shader fragment(GL_FRAGMENT_SHADER);
    for (const auto& [shader, files] :
         {std::pair{&vertex, sources.vertex}, std::pair{&fragment, sources.fragment}}) {
        const Expected<std::string> text = joined(sources, files);
        if (!text) {
            return fail(text.error());
        }
        if (Expected<void> compiled = shader->compile(*text); !compiled) {
            return compiled;
        }
    }
    return link(program, vertex, fragment);
}

}  // namespace

Expected<Program> Program::build(const ProgramSources& sources) {
    Program program(glCreateProgram());
    if (Expected<void> built = compile_and_link(program.name_, sources); !built) {
        return fail(std::move(built.error()).in("shader " + std::string(sources.name)));
    }
    bind_block(program.name_, "Frame", kFrameBinding);
    bind_block(program.name_, "Bones", kBonesBinding);
    bind_block(program.name_, "Blobs", kBlobsBinding);
    bind_block(program.name_, "Surface", kSurfaceBinding);
    bind_block(program.name_, "Dress", kDressBinding);
    // The sampler's texture unit never changes, so it is set once instead of at every draw.
    const GLint shadow_map = program.uniform("shadow_map");
    if (shadow_map >= 0) {
        program.use();
        glUniform1i(shadow_map, kShadowUnit);
    }
    return program;
}

Program::Program(Program&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

Program::~Program() {
    if (name_ != 0U) {
        glDeleteProgram(name_);
    }
}

}  // namespace raks::render::gl
