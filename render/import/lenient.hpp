// Values that may be wrong in a file without the model being so: a warning, and what is nearest.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "render/import/gltf_materials.hpp"
#include "render/import/json_field.hpp"
#include "render/import/model_warnings.hpp"
#include "render/model/model.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// The range that a number is kept in, and what it is where the file has none, or none to be read.
struct NumberLimits {
    float lowest;
    float highest;
    float otherwise;
};

/// A number, clamped to `limits`; `limits.otherwise` where it is no number. Warns of both.
[[nodiscard]] float lenient_number(const JsonField& field, NumberLimits limits, Model& model);

/// Three numbers, each clamped to `limits`; `otherwise` where they are missing or not to be read.
[[nodiscard]] glm::vec3 lenient_vector(const JsonField& field,
                                       NumberLimits limits,
                                       const glm::vec3& otherwise,
                                       Model& model);

/// The same of an object {x, y, z}, as VRM 0.x writes it; a missing one is `limits.otherwise`.
[[nodiscard]] glm::vec3 lenient_xyz(const JsonField& field, NumberLimits limits, Model& model);

/// True or false. What is neither is `otherwise`, with a warning; so is nothing, without one.
[[nodiscard]] bool lenient_truth(const JsonField& field, bool otherwise, Model& model);

/// A text fit for one line, at most 400 bytes; empty where there is none. Warned of: what is no
/// text, and what was cut or replaced.
[[nodiscard]] std::string lenient_text(const JsonField& field, Model& model);

/// Index of the text in `words`; 0, the harmless one, where it is missing or, warned of, another.
[[nodiscard]] std::size_t lenient_choice(const JsonField& field,
                                         std::initializer_list<std::string_view> words,
                                         Model& model);

/// A texture, or none with a warning where it is not one of the file's.
[[nodiscard]] TextureUse lenient_texture(const JsonField& field, Model& model);

/// Reads a part of a file by `read(field)`. Where that noted a fault, warns that the part is left
/// out and returns false; the caller then drops it.
template <typename Read>
[[nodiscard]] bool read_part(const JsonField& part, Model& model, const Read& read) {
    JsonFaults faults;
    const std::string path = part.path();
    read(part.noting_to(faults, path));
    if (const Expected<void> done = faults.finish(); !done) {
        warn(model, done.error().message + "; left out");
        return false;
    }
    return true;
}

}  // namespace raks::render
