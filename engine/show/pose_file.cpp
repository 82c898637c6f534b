#include "engine/show/pose_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace raks::engine {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPoseBytes = 16'000'000;

// The object of all postures by name; null where the document is a posture itself.
const Json* poses_of(const Json& document) {
    const Json* place = &document;
    if (document.contains("test_poses") && document["test_poses"].is_object()) {
        place = &document["test_poses"];
    }
    const auto found = place->find("poses");
    return found != place->end() && found->is_object() ? &*found : nullptr;
}

Expected<const Json*> find_pose(const Json& document, std::string_view name) {
    const Json* const poses = poses_of(document);
    if (poses == nullptr) {
        if (!name.empty()) {
            return fail(fmt::format("it has no poses, so none named {}", printable(name)));
        }
        return &document;
    }
    if (name.empty() && poses->size() == 1) {
        return &poses->begin().value();
    }
    std::vector<std::string_view> names;
    for (const auto& item : poses->items()) {
        names.emplace_back(item.key());
    }
    if (names.empty()) {
        return fail("holds no poses");
    }
    if (name.empty()) {
        return fail(fmt::format("holds several poses: name one as FILE#NAME: {}",
                                printable(fmt::format("{}", fmt::join(names, ", ")), 300)));
    }
    const auto found = poses->find(std::string(name));
    if (found == poses->end()) {
        return fail(unknown_name("pose", name, names));
    }
    return &*found;
}

Expected<glm::quat> rotation_of(const Json& numbers, std::string_view bone) {
    std::array<float, 4> q{};
    bool is_good = numbers.is_array() && numbers.size() == q.size();
    for (std::size_t i = 0; is_good && i < q.size(); ++i) {
        is_good = numbers[i].is_number();
        q[i] = is_good ? numbers[i].get<float>() : 0.0F;
    }
    const float length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!is_good || !(length > 1e-3F) || !std::isfinite(length)) {
        return fail(fmt::format("{} is not a rotation: four numbers x, y, z, w, not all 0", bone));
    }
    return glm::normalize(glm::quat(q[3], q[0], q[1], q[2]));
}

}  // namespace

Expected<motion::Pose> parse_pose(std::string_view text, std::string_view name) {
    const Json document = Json::parse(text, nullptr, false);
    if (!document.is_object()) {
        return fail("not a JSON object");
    }
    const auto found = find_pose(document, name);
    if (!found) {
        return fail(found.error());
    }
    const Json& bones = **found;
    motion::Pose pose;
    bool has_bone = false;
    for (std::size_t b = 0; bones.is_object() && b < motion::kBoneCount; ++b) {
        const auto rotation = bones.find(std::string(motion::kBoneNames[b]));
        if (rotation == bones.end()) {
            continue;
        }
        const auto read = rotation_of(*rotation, motion::kBoneNames[b]);
        if (!read) {
            return fail(read.error());
        }
        pose.local_rotations[b] = *read;
        has_bone = true;
    }
    // The T-pose of a list of postures turns no bone; a document of something else does not either.
    if (!has_bone && &bones == &document) {
        return fail("it names no bone; name one posture of a list by FILE.json#NAME");
    }
    return pose;
}

Expected<motion::Pose> read_pose(const std::string& argument) {
    const std::size_t sign = argument.rfind('#');
    const std::string file = argument.substr(0, sign);
    const std::string name = sign == std::string::npos ? "" : argument.substr(sign + 1);
    const auto text = read_file(file, kMostPoseBytes);
    if (!text) {
        return fail(text.error());
    }
    const auto pose = parse_pose(*text, name);
    if (!pose) {
        return fail(fmt::format("{}: {}", printable(file), pose.error().message));
    }
    return *pose;
}

}  // namespace raks::engine
