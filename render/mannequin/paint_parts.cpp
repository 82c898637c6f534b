#include "render/mannequin/paint_parts.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace raks::render {
namespace {

constexpr std::uint32_t kNotTaken = std::numeric_limits<std::uint32_t>::max();

/// Takes triangles out of a primitive.
class Part {
 public:
    explicit Part(const ModelPrimitive& whole)
        : whole_(whole), number_(whole.positions.size(), kNotTaken) {}

    void add(const std::uint32_t* triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& number = number_[triangle[k]];
            if (number == kNotTaken) {
                number = static_cast<std::uint32_t>(taken_.size());
                taken_.push_back(triangle[k]);
            }
            indices_.push_back(number);
        }
    }

    [[nodiscard]] ModelPrimitive primitive() const {
        ModelPrimitive part;
        part.material = whole_.material;
        part.indices = indices_;
        take(whole_.positions, part.positions);
        take(whole_.normals, part.normals);
        take(whole_.colours, part.colours);
        take(whole_.joints, part.joints);
        take(whole_.weights, part.weights);
        for (const MorphTarget& morph : whole_.morphs) {
            part.morphs.push_back(taken(morph));
        }
        return part;
    }

 private:
    template <typename Value>
    void take(const std::vector<Value>& from, std::vector<Value>& to) const {
        for (std::size_t i = 0; i < taken_.size() && !from.empty(); ++i) {
            to.push_back(from[taken_[i]]);
        }
    }

    [[nodiscard]] MorphTarget taken(const MorphTarget& morph) const {
        std::vector<std::size_t> place(number_.size(), morph.vertices.size());
        for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
            place[morph.vertices[i]] = i;
        }
        MorphTarget part;
        for (std::size_t i = 0; i < taken_.size(); ++i) {
            const std::size_t from = place[taken_[i]];
            if (from == morph.vertices.size()) {
                continue;
            }
            part.vertices.push_back(static_cast<std::uint32_t>(i));
            part.positions.push_back(morph.positions[from]);
            if (!morph.normals.empty()) {
                part.normals.push_back(morph.normals[from]);
            }
        }
        return part;
    }

    const ModelPrimitive& whole_;
    std::vector<std::uint32_t> number_;  // by vertex of the whole
    std::vector<std::uint32_t> taken_;
    std::vector<std::uint32_t> indices_;
};

}  // namespace

std::map<Paint, ModelPrimitive> paint_parts(const ModelPrimitive& primitive,
                                            std::span<const Paint> paints) {
    std::map<Paint, Part> parts;
    for (std::size_t i = 0; i < paints.size(); ++i) {
        const auto place = parts.try_emplace(paints[i], primitive).first;
        place->second.add(&primitive.indices[3 * i]);
    }
    std::map<Paint, ModelPrimitive> primitives;
    for (const auto& [paint, part] : parts) {
        primitives.emplace(paint, part.primitive());
    }
    return primitives;
}

}  // namespace raks::render
