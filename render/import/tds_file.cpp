#include "render/import/tds_file.hpp"

#include <algorithm>
#include <utility>

#include "base/printable.hpp"
#include "render/import/tds_chunks.hpp"
#include "render/import/tds_keyframer.hpp"
#include "render/import/tds_materials.hpp"

#include <fmt/format.h>

namespace raks::render {
namespace {

constexpr std::uint16_t kTdsMain = 0x4D4D;
constexpr std::uint16_t kTdsVersion = 0x0002;
constexpr std::uint16_t kTdsEditor = 0x3D3D;
constexpr std::uint16_t kTdsKeyframer = 0xB000;
constexpr std::uint16_t kTdsMaterialEntry = 0xAFFF;
constexpr std::uint16_t kTdsObjectEntry = 0x4000;
constexpr std::uint16_t kTdsMesh = 0x4100;
constexpr std::uint16_t kTdsLight = 0x4600;
constexpr std::uint16_t kTdsCamera = 0x4700;
constexpr std::uint16_t kTdsVertices = 0x4110;
constexpr std::uint16_t kTdsFaces = 0x4120;
constexpr std::uint16_t kTdsFaceMaterial = 0x4130;
constexpr std::uint16_t kTdsUv = 0x4140;
constexpr std::uint16_t kTdsSmoothing = 0x4150;
constexpr std::uint16_t kTdsMatrix = 0x4160;

/// Axes and origin of an object.
glm::mat4 read_axes(TdsChunk& chunk) {
    glm::mat4 matrix(1.0F);
    for (int column = 0; column < 4; ++column) {
        matrix[column] = glm::vec4(chunk.vector3(), column == 3 ? 1.0F : 0.0F);
    }
    return matrix;
}

TdsFaceGroup read_face_group(TdsChunk& chunk, std::size_t triangles) {
    TdsFaceGroup group{.material = chunk.text(), .triangles = {}};
    const std::size_t count = chunk.checked(chunk.u16(), 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t triangle = chunk.u16();
        if (triangle >= triangles) {
            chunk.complain(fmt::format(
                "triangle {} does not exist: there are {}, counted from 0", triangle, triangles));
            return group;
        }
        group.triangles.push_back(triangle);
    }
    return group;
}

void read_faces(TdsChunk& chunk, TdsObject& object) {
    object.triangles.resize(chunk.checked(chunk.u16(), 8));
    object.groups.clear();
    object.smoothing.clear();
    for (auto& triangle : object.triangles) {
        for (std::uint16_t& corner : triangle) {
            corner = chunk.u16();
        }
        chunk.skip(2);  // which edges are seen
    }
    while (auto part = chunk.next()) {
        if (part->id() == kTdsFaceMaterial) {
            TdsFaceGroup group = read_face_group(*part, object.triangles.size());
            if (!group.triangles.empty()) {
                object.groups.push_back(std::move(group));
            }
        } else if (part->id() == kTdsSmoothing) {
            object.smoothing.resize(part->checked(object.triangles.size(), 4));
            for (std::uint32_t& groups : object.smoothing) {
                groups = part->u32();
            }
        }
    }
}

/// What a mesh says of its own parts must fit together.
void check_mesh(const TdsChunk& chunk, TdsObject& object, TdsFile& file) {
    const std::size_t count = object.positions.size();
    for (const auto& triangle : object.triangles) {
        const auto largest = *std::max_element(triangle.begin(), triangle.end());
        if (largest >= count) {
            chunk.complain(fmt::format(
                "vertex {} does not exist: there are {}, counted from 0", largest, count));
            return;
        }
    }
    if (!object.uv.empty() && object.uv.size() != count) {
        file.note(fmt::format("\"{}\": has {} texture coordinates for {} vertices; left out",
                              printable(object.name, 60),
                              object.uv.size(),
                              count));
        object.uv.clear();
    }
}

void read_mesh(TdsChunk& chunk, TdsObject& object, TdsFile& file) {
    while (auto part = chunk.next()) {
        switch (part->id()) {
            case kTdsVertices:
                object.positions.resize(part->checked(part->u16(), 12));
                std::generate(object.positions.begin(), object.positions.end(), [&] {
                    return part->vector3();
                });
                break;
            case kTdsFaces:
                read_faces(*part, object);
                break;
            case kTdsUv:
                object.uv.resize(part->checked(part->u16(), 8));
                std::generate(object.uv.begin(), object.uv.end(), [&] { return part->vector2(); });
                break;
            case kTdsMatrix:
                object.world_from_object = read_axes(*part);
                break;
            default:
                break;
        }
    }
    check_mesh(chunk, object, file);
}

void read_object(TdsChunk& chunk, TdsFile& file) {
    TdsObject object;
    object.name = chunk.text();
    bool has_mesh = false;
    while (auto part = chunk.next()) {
        if (part->id() == kTdsMesh) {
            has_mesh = true;
            read_mesh(*part, object, file);
        }
        file.cameras += part->id() == kTdsCamera ? 1U : 0U;
        file.lights += part->id() == kTdsLight ? 1U : 0U;
    }
    if (file.objects.size() == kMostTdsNodes) {
        chunk.complain(fmt::format("there are more than {} objects", kMostTdsNodes));
    } else if (has_mesh) {
        file.objects.push_back(std::move(object));
    }
}

void read_editor(TdsChunk& chunk, TdsFile& file) {
    while (auto part = chunk.next()) {
        if (part->id() == kTdsMaterialEntry) {
            file.materials.push_back(read_tds_material(*part));
            if (file.materials.size() > kMostTdsNodes) {
                part->complain(fmt::format("there are more than {} materials", kMostTdsNodes));
            }
        } else if (part->id() == kTdsObjectEntry) {
            read_object(*part, file);
        }
    }
}

}  // namespace

void TdsFile::note(std::string line) {
    constexpr std::size_t kMostTdsNotes = 100;  // a model keeps fewer
    if (notes.size() < kMostTdsNotes) {
        notes.push_back(std::move(line));
    }
}

Expected<TdsFile> parse_tds(std::span<const std::byte> bytes) {
    TdsFaults faults;
    TdsChunk whole(bytes, faults);
    auto main = whole.next();
    if (main && main->id() != kTdsMain) {
        return fail(fmt::format("is not a 3DS file: it begins with {:04X}, not 4D4D", main->id()));
    }
    TdsFile file;
    while (auto part = main ? main->next() : std::nullopt) {
        if (part->id() == kTdsVersion) {
            file.version = part->u32();
        } else if (part->id() == kTdsEditor) {
            read_editor(*part, file);
        } else if (part->id() == kTdsKeyframer) {
            read_tds_keyframer(*part, file);
        }
    }
    if (!main && !faults.any()) {
        return fail("is not a 3DS file: it is empty");
    }
    if (auto good = faults.finish(); !good) {
        return fail(good.error());
    }
    const bool has_triangles =
        std::any_of(file.objects.begin(), file.objects.end(), [](const TdsObject& object) {
            return !object.triangles.empty();
        });
    if (!has_triangles) {
        return fail("there is no mesh in it");
    }
    return file;
}

}  // namespace raks::render
