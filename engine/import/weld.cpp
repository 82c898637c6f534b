#include "engine/import/weld.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace raks::engine {
namespace {

using render::ModelPrimitive;
using render::MorphTarget;

template <typename Value>
void append(const std::vector<Value>& values, std::size_t vertex, std::string& record) {
    if (!values.empty()) {
        record.append(reinterpret_cast<const char*>(&values[vertex]), sizeof(Value));
    }
}

/// All that a vertex has, but for its morph targets.
std::string record_of(const ModelPrimitive& primitive, std::size_t vertex) {
    std::string record;
    append(primitive.positions, vertex, record);
    append(primitive.normals, vertex, record);
    append(primitive.tangents, vertex, record);
    append(primitive.uv[0], vertex, record);
    append(primitive.uv[1], vertex, record);
    append(primitive.colours, vertex, record);
    append(primitive.joints, vertex, record);
    append(primitive.weights, vertex, record);
    return record;
}

/// The records of all vertices, with what each morph target does to them.
std::vector<std::string> records_of(const ModelPrimitive& primitive) {
    std::vector<std::string> records;
    records.reserve(primitive.positions.size());
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        records.push_back(record_of(primitive, v));
    }
    for (std::size_t m = 0; m < primitive.morphs.size(); ++m) {
        const MorphTarget& morph = primitive.morphs[m];
        for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
            std::string& record = records[morph.vertices[i]];
            record.append(reinterpret_cast<const char*>(&m), sizeof(m));
            append(morph.positions, i, record);
            append(morph.normals, i, record);
        }
    }
    return records;
}

/// Those of `values` that are kept, which are named in ascending order.
template <typename Value>
void keep(const std::vector<std::uint32_t>& kept, std::vector<Value>& values) {
    if (values.empty()) {
        return;
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
        values[i] = values[kept[i]];
    }
    values.resize(kept.size());
}

/// `place`: new number of each old vertex; `is_kept`: it is the first of its kind.
void keep_moved(const std::vector<std::uint32_t>& place,
                const std::vector<bool>& is_kept,
                MorphTarget& morph) {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
        if (is_kept[morph.vertices[i]]) {
            kept.push_back(static_cast<std::uint32_t>(i));
        }
    }
    keep(kept, morph.vertices);
    keep(kept, morph.positions);
    keep(kept, morph.normals);
    morph.vertices.resize(kept.size());
    for (std::uint32_t& vertex : morph.vertices) {
        vertex = place[vertex];
    }
}

}  // namespace

void weld(ModelPrimitive& primitive) {
    std::unordered_map<std::string, std::uint32_t> known;
    std::vector<std::uint32_t> place;
    std::vector<std::uint32_t> kept;
    std::vector<bool> is_kept;
    for (std::string& record : records_of(primitive)) {
        const auto [found, is_new] =
            known.try_emplace(std::move(record), static_cast<std::uint32_t>(kept.size()));
        if (is_new) {
            kept.push_back(static_cast<std::uint32_t>(place.size()));
        }
        place.push_back(found->second);
        is_kept.push_back(is_new);
    }
    keep(kept, primitive.positions);
    keep(kept, primitive.normals);
    keep(kept, primitive.tangents);
    keep(kept, primitive.uv[0]);
    keep(kept, primitive.uv[1]);
    keep(kept, primitive.colours);
    keep(kept, primitive.joints);
    keep(kept, primitive.weights);
    for (MorphTarget& morph : primitive.morphs) {
        keep_moved(place, is_kept, morph);
    }
    for (std::uint32_t& corner : primitive.indices) {
        corner = place[corner];
    }
}

}  // namespace raks::engine
