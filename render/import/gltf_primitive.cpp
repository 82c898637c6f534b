#include "render/import/gltf_primitive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/import/model_warnings.hpp"
#include "render/import/vertex_influences.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostVertices = 2'000'000;
constexpr std::size_t kMostMorphs = 5'000;
constexpr std::size_t kMostSets = 4;  // of joints: 16 influences
constexpr float kFarthest = 1e7F;     // a vertex beyond it is refused

constexpr float kUnitSlack = 0.05F;  // of a squared length: what eight bits leave

enum Mode : std::int64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// Triangles of a strip or fan: corners as they turn counter-clockwise.
std::vector<std::uint32_t> taken_apart(const std::vector<std::uint32_t>& corners,
                                       std::int64_t mode) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(corners.size() * 3);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const bool is_odd = i % 2 == 1;
        const std::uint32_t first = mode == kFan ? corners[0] : corners[is_odd ? i - 1 : i - 2];
        const std::uint32_t second =
            mode == kFan ? corners[i - 1] : corners[is_odd ? i - 2 : i - 1];
        triangles.insert(triangles.end(), {first, second, corners[i]});
    }
    return triangles;
}

/// A direction of length 1; up where it has none. `is_odd`: becomes true where it had another.
glm::vec3 made_unit(const glm::vec3& direction, bool& is_odd) {
    const float square = glm::dot(direction, direction);
    constexpr float kExact = 1e-5F;
    if (std::abs(square - 1.0F) < kExact) {
        return direction;
    }
    is_odd = is_odd || std::abs(square - 1.0F) > kUnitSlack;
    constexpr float kShort = 1e-12F;
    return square > kShort && std::isfinite(square) ? direction / std::sqrt(square)
                                                    : glm::vec3(0.0F, 1.0F, 0.0F);
}

bool is_too_far(const glm::vec3& point) {
    return std::abs(point.x) > kFarthest || std::abs(point.y) > kFarthest ||
           std::abs(point.z) > kFarthest;
}

}  // namespace

std::optional<ModelPrimitive> PrimitiveReader::read(const JsonField& field, MeshJoints& joints) {
    const std::int64_t mode = field["mode"].whole_or(kTriangles, 0, kFan);
    ModelPrimitive primitive;
    primitive.material = field["material"].index_or_none(model_.materials.size());
    const JsonField attributes = field["attributes"];
    if (!attributes.is_object()) {
        attributes.complain("is missing or no object");
        return std::nullopt;
    }
    if (mode < kTriangles) {
        warn(model_, field.line("holds points or lines, not triangles; left out"));
        return std::nullopt;
    }
    if (!attributes["POSITION"].exists()) {
        warn(model_, field.line("has no positions; left out"));
        return std::nullopt;
    }
    read_attributes(attributes, primitive);
    if (primitive.positions.empty()) {
        return std::nullopt;  // noted
    }
    read_influences(attributes, primitive, joints);
    read_indices(field, mode, primitive);
    read_morphs(field["targets"], attributes, primitive);
    return primitive;
}

int PrimitiveReader::attribute(const JsonField& attributes,
                               std::string_view name,
                               std::initializer_list<ElementType> elements,
                               std::size_t count) {
    const JsonField field = attributes[name];
    const int index = field.index_or_none(accessors_.size());
    if (index < 0 || accessors_.size() == 0) {
        return -1;
    }
    const GltfAccessor& accessor = accessors_[index];
    if (std::find(elements.begin(), elements.end(), accessor.element) == elements.end()) {
        field.complain(fmt::format("accessors[{}] is {}, not {}",
                                   index,
                                   GltfAccessors::name_of(accessor.element),
                                   GltfAccessors::name_of(*elements.begin())));
        return -1;
    }
    if (count != 0 && accessor.count != count) {
        field.complain(fmt::format("has {} elements for {} vertices", accessor.count, count));
        return -1;
    }
    check_component(accessor, name);
    accessors_.use(index, ViewUse::vertices);
    return index;
}

/// What glTF asks for beyond what can be read: a warning, since the numbers are clear.
void PrimitiveReader::check_component(const GltfAccessor& accessor, std::string_view name) {
    const bool is_float = accessor.component == ComponentType::float32;
    if (accessor.component == ComponentType::uint32) {
        accessor.field.complain(fmt::format("{} must not be of 32-bit integers", name));
    }
    if (name == "TANGENT" || name == "POSITION" || name == "NORMAL") {
        if (!is_float && !is_quantized_) {
            warn(model_,
                 accessor.field.line(
                     "holds integers, which need the extension KHR_mesh_quantization"));
        }
    } else if (!is_float && !accessor.is_normalized && name.substr(0, 6) != "JOINTS" &&
               name.substr(0, 8) != "TEXCOORD") {
        accessor.field.complain(
            fmt::format("{} must not be of integers that are not normalized", name));
    }
    if (name == "POSITION" && !accessor.has_bounds) {
        warn(model_, accessor.field.line("its positions have no min and max"));
    }
}

void PrimitiveReader::read_attributes(const JsonField& attributes, ModelPrimitive& primitive) {
    const int positions = attribute(attributes, "POSITION", {ElementType::vec3}, 0);
    if (positions < 0) {
        return;
    }
    const std::size_t count = accessors_[positions].count;
    vertices_ += count;
    if (vertices_ > kMostVertices) {
        attributes.complain(fmt::format("there are more than {} vertices in all", kMostVertices));
        return;
    }
    primitive.positions = accessors_.elements<glm::vec3>(positions);
    if (std::any_of(primitive.positions.begin(), primitive.positions.end(), is_too_far)) {
        attributes["POSITION"].complain(
            fmt::format("a vertex lies farther than {} away", kFarthest));
    }
    read_normals(attributes, primitive);
    constexpr std::string_view kUvSets[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (std::size_t set = 0; set < 2; ++set) {
        if (const int uv = attribute(attributes, kUvSets[set], {ElementType::vec2}, count);
            uv >= 0) {
            primitive.uv[set] = accessors_.elements<glm::vec2>(uv);
        }
    }
    read_colours(attributes, primitive);
    note_names(attributes);
    note_missing_uv(attributes, primitive);
}

/// Normals and tangents, made of length 1.
void PrimitiveReader::read_normals(const JsonField& attributes, ModelPrimitive& primitive) {
    const std::size_t count = primitive.positions.size();
    bool is_odd = false;
    if (const int normals = attribute(attributes, "NORMAL", {ElementType::vec3}, count);
        normals >= 0) {
        primitive.normals = accessors_.elements<glm::vec3>(normals);
        for (glm::vec3& normal : primitive.normals) {
            normal = made_unit(normal, is_odd);
        }
    }
    if (const int tangents = attribute(attributes, "TANGENT", {ElementType::vec4}, count);
        tangents >= 0) {
        primitive.tangents = accessors_.elements<glm::vec4>(tangents);
        for (glm::vec4& tangent : primitive.tangents) {
            is_odd = is_odd || std::abs(std::abs(tangent.w) - 1.0F) > kUnitSlack;
            tangent =
                glm::vec4(made_unit(glm::vec3(tangent), is_odd), tangent.w < 0.0F ? -1.0F : 1.0F);
        }
    }
    if (is_odd) {
        warn(model_, attributes.line("has normals or tangents that are not of length 1"));
    }
}

/// Attributes of no known name are left out, as those that begin with '_' are.
void PrimitiveReader::note_names(const JsonField& attributes) {
    for (const auto& [name, field] : attributes.entries()) {
        const std::size_t bar = name.rfind('_');
        const std::string_view stem = bar == 0 ? "" : name.substr(0, bar);
        const std::string_view number = bar == std::string_view::npos ? "" : name.substr(bar + 1);
        const bool is_plain = name == "POSITION" || name == "NORMAL" || name == "TANGENT";
        const bool is_numbered =
            (stem == "TEXCOORD" || stem == "COLOR" || stem == "JOINTS" || stem == "WEIGHTS") &&
            number.size() == 1 && number[0] >= '0' && number[0] <= '9';
        if (is_numbered && number != "0") {
            const std::string before = fmt::format("{}_{}", stem, static_cast<char>(number[0] - 1));
            if (!attributes[before].exists()) {
                warn(model_, field.line(fmt::format("is there, but {} is not", before)));
            }
        } else if (!is_plain && !is_numbered && name.substr(0, 1) != "_") {
            warn(model_, field.line("is not an attribute that glTF knows"));
        }
    }
}

void PrimitiveReader::note_missing_uv(const JsonField& attributes,
                                      const ModelPrimitive& primitive) {
    if (primitive.material < 0 || model_.materials.empty()) {
        return;
    }
    const ModelMaterial& material = model_.materials[static_cast<std::size_t>(primitive.material)];
    for (const TextureUse* const use : {&material.base_texture,
                                        &material.metallic_roughness_texture,
                                        &material.normal_texture,
                                        &material.occlusion_texture,
                                        &material.emissive_texture}) {
        if (use->texture >= 0 && primitive.uv[static_cast<std::size_t>(use->uv_set)].empty()) {
            warn(model_,
                 attributes.line(fmt::format("its material needs TEXCOORD_{}", use->uv_set)));
        }
    }
}

void PrimitiveReader::read_colours(const JsonField& attributes, ModelPrimitive& primitive) {
    const int colours = attribute(
        attributes, "COLOR_0", {ElementType::vec4, ElementType::vec3}, primitive.positions.size());
    if (colours < 0) {
        return;
    }
    if (accessors_[colours].element == ElementType::vec4) {
        primitive.colours = accessors_.elements<glm::vec4>(colours);
    } else {
        for (const glm::vec3& colour : accessors_.elements<glm::vec3>(colours)) {
            primitive.colours.emplace_back(colour, 1.0F);
        }
    }
    bool is_odd = false;
    for (glm::vec4& colour : primitive.colours) {
        const glm::vec4 fit = glm::clamp(colour, 0.0F, 1.0F);
        is_odd = is_odd || fit != colour;
        colour = fit;
    }
    if (is_odd) {
        warn(model_, attributes.line("has colours that are not in 0 .. 1"));
    }
}

void PrimitiveReader::read_influences(const JsonField& attributes,
                                      ModelPrimitive& primitive,
                                      MeshJoints& joints) {
    RawInfluences raw{.vertices = primitive.positions.size(), .joints = {}, .weights = {}};
    for (std::size_t set = 0; set < kMostSets; ++set) {
        const std::string joint_name = fmt::format("JOINTS_{}", set);
        const std::string weight_name = fmt::format("WEIGHTS_{}", set);
        const int joint = attribute(attributes, joint_name, {ElementType::vec4}, raw.vertices);
        const int weight = attribute(attributes, weight_name, {ElementType::vec4}, raw.vertices);
        if ((joint < 0) != (weight < 0)) {
            attributes.complain(
                fmt::format("has only one of {} and {}; both are needed", joint_name, weight_name));
        }
        if (joint < 0 || weight < 0) {
            break;
        }
        if (accessors_[joint].component == ComponentType::uint32) {
            accessors_[joint].field.complain("must be integers of 8 or 16 bits, as joints are");
            return;
        }
        raw.joints.push_back(accessors_.wholes(joint));
        raw.weights.push_back(accessors_.floats(weight));
        if (raw.joints.back().empty() || raw.weights.back().empty()) {
            return;  // noted
        }
    }
    if (raw.joints.empty()) {
        return;
    }
    const InfluenceFaults faults = merge_influences(raw, primitive.joints, primitive.weights);
    primitive.uneven_weights = faults.uneven;
    joints.used = std::max(joints.used, faults.used);
    joints.unused = std::max(joints.unused, faults.unused);
    const auto note = [&](bool is_so, std::string_view what) {
        if (is_so) {
            warn(model_, attributes.line(what));
        }
    };
    note(faults.has_negative, "has weights below 0, read as 0");
    note(faults.has_none, "has vertices without weight, which follow their first joint");
    note(faults.has_other_sum, "has weights that do not sum to 1, divided by their sum");
    note(faults.has_more,
         "has vertices with more than four joints, of which the four that weigh most are kept");
}

void PrimitiveReader::read_indices(const JsonField& field,
                                   std::int64_t mode,
                                   ModelPrimitive& primitive) {
    const std::size_t count = primitive.positions.size();
    const int accessor = field["indices"].index_or_none(accessors_.size());
    std::vector<std::uint32_t>& indices = primitive.indices;
    if (accessor < 0) {
        indices.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            indices[i] = static_cast<std::uint32_t>(i);
        }
    } else {
        if (accessors_[accessor].element != ElementType::scalar) {
            accessors_[accessor].field.complain("must be SCALAR, as indices are");
            return;
        }
        accessors_.use(accessor, ViewUse::indices);
        indices = accessors_.wholes(accessor);
    }
    const auto beyond = std::find_if(
        indices.begin(), indices.end(), [count](std::uint32_t index) { return index >= count; });
    if (beyond != indices.end()) {
        field["indices"].complain(fmt::format("names vertex {}, but there are {}", *beyond, count));
        return;
    }
    if (mode != kTriangles) {
        if (!budget_.claim(indices.size(), 3 * sizeof(std::uint32_t))) {
            field.complain("the model needs too much memory");
            return;
        }
        indices = taken_apart(indices, mode);
    } else if (indices.size() % 3 != 0) {
        warn(model_, field.line("has corners left that make no whole triangle; left out"));
        indices.resize(indices.size() / 3 * 3);
    }
}

void PrimitiveReader::read_morphs(const JsonField& field,
                                  const JsonField& attributes,
                                  ModelPrimitive& primitive) {
    for (const JsonField& target : field.objects(kMostMorphs)) {
        for (const auto& [name, moved] : target.entries()) {
            if (!attributes[name].exists()) {
                warn(model_, moved.line("moves something that the primitive does not have"));
            }
        }
        primitive.morphs.push_back(read_morph(target, primitive.positions.size()));
    }
}

MorphTarget PrimitiveReader::read_morph(const JsonField& field, std::size_t count) {
    MorphTarget morph;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    if (const int moved = attribute(field, "POSITION", {ElementType::vec3}, count); moved >= 0) {
        positions = accessors_.elements<glm::vec3>(moved);
    }
    if (const int turned = attribute(field, "NORMAL", {ElementType::vec3}, count); turned >= 0) {
        normals = accessors_.elements<glm::vec3>(turned);
    }
    if (std::any_of(positions.begin(), positions.end(), is_too_far)) {
        field.complain(fmt::format("moves a vertex farther than {}", kFarthest));
    }
    const std::size_t read = positions.size() + normals.size();
    positions.resize(positions.empty() ? normals.size() : positions.size(), glm::vec3(0.0F));
    const glm::vec3 still(0.0F);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (positions[v] == still && (normals.empty() || normals[v] == still)) {
            continue;
        }
        morph.vertices.push_back(static_cast<std::uint32_t>(v));
        morph.positions.push_back(positions[v]);
        if (!normals.empty()) {
            morph.normals.push_back(normals[v]);
        }
    }
    budget_.give_back(read, sizeof(glm::vec3));
    if (!budget_.claim(morph.vertices.size(), sizeof(std::uint32_t) + 2 * sizeof(glm::vec3))) {
        field.complain("the model needs too much memory");
    }
    return morph;
}

}  // namespace raks::render
