#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "render/import/gltf_buffers.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// How the numbers of an accessor lie in the file.
enum class ComponentType : std::uint8_t { int8, uint8, int16, uint16, uint32, float32 };

/// "SCALAR" ... "MAT4"
enum class ElementType : std::uint8_t { scalar, vec2, vec3, vec4, mat2, mat3, mat4 };

/// What the bytes of a view are used for.
enum class ViewUse : std::uint8_t { vertices, indices, matrices, animation };

/// What an accessor says, checked: it lies within its view.
struct GltfAccessor {
    JsonField field;
    int view = -1;  ///< -1: zeros
    std::uint64_t offset = 0;
    std::size_t count = 0;
    ComponentType component = ComponentType::float32;
    ElementType element = ElementType::scalar;
    bool is_normalized = false;
    bool has_bounds = false;  ///< min and max
    bool is_sparse = false;
    struct Sparse {
        std::size_t count = 0;
        int index_view = -1;
        std::uint64_t index_offset = 0;
        ComponentType index_component = ComponentType::uint8;
        int value_view = -1;
        std::uint64_t value_offset = 0;
    };
    Sparse sparse{};
    bool is_read = false;
};

/// All accessors of a file. What each claims is checked when this is made; numbers are fetched
/// when they are asked for, and are finite.
class GltfAccessors {
 public:
    /// `buffers` and `budget` must outlive it.
    GltfAccessors(const JsonField& root, GltfBuffers& buffers, ImportBudget& budget, Model& model);

    [[nodiscard]] std::size_t size() const noexcept { return accessors_.size(); }
    [[nodiscard]] const GltfAccessor& operator[](int index) const {
        return accessors_[static_cast<std::size_t>(index)];
    }
    /// Numbers of an element: 3 of vec3, 16 of mat4.
    [[nodiscard]] static std::size_t width(ElementType element) noexcept;
    /// "VEC3 of floats", for errors.
    [[nodiscard]] static std::string_view name_of(ElementType element) noexcept;

    /// All numbers, element after element, normalised ones as fractions. Empty after a fault:
    /// bytes that are not there, a number that is not finite, no memory left. Warns where min and
    /// max do not hold them.
    [[nodiscard]] std::vector<float> floats(int index);
    /// The same for types that are spans of floats.
    template <typename T>
    [[nodiscard]] std::vector<T> elements(int index) {
        const std::vector<float> numbers = floats(index);
        std::vector<T> elements(numbers.size() * sizeof(float) / sizeof(T));
        std::copy(numbers.begin(),
                  numbers.begin() +
                      static_cast<std::ptrdiff_t>(elements.size() * sizeof(T) / sizeof(float)),
                  reinterpret_cast<float*>(elements.data()));
        return elements;
    }
    /// All numbers of unsigned integers. Empty after a fault.
    [[nodiscard]] std::vector<std::uint32_t> wholes(int index);
    /// Notes what an accessor is used for; warns where its view may not be used so: for two things,
    /// with a stride that only vertices have, by vertices of two accessors without one.
    void use(int index, ViewUse use);
    /// Looks at the numbers of those that nothing asked for: what is bad in them is a warning.
    void check_unread();

 private:
    GltfAccessor read(const JsonField& field);
    void read_sparse(GltfAccessor& accessor, const JsonField& field);
    /// That `count` elements lie in a view from `offset` on.
    void check_range(const JsonField& field,
                     int view,
                     std::uint64_t offset,
                     std::uint64_t count,
                     ElementType element,
                     ComponentType component);
    bool claim(const GltfAccessor& accessor, std::size_t size);
    template <typename T>
    std::vector<T> raw(GltfAccessor& accessor);
    template <typename T>
    bool apply_sparse(const GltfAccessor& accessor, std::vector<T>& numbers);
    bool are_finite(const GltfAccessor& accessor, const std::vector<float>& numbers);
    void check_bounds(const GltfAccessor& accessor, const std::vector<float>& numbers);

    GltfBuffers& buffers_;
    ImportBudget& budget_;
    Model& model_;
    std::vector<GltfAccessor> accessors_;
    /// By view: its first use, and the accessor that it had.
    std::vector<std::optional<std::pair<ViewUse, int>>> uses_;
};

}  // namespace raks::render
