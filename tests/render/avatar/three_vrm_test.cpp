// The avatar's joints, vertices, tails and morphs against those that pixiv's three-vrm computes
// (data/avatars/reference/three_vrm, whose README says how they were made).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include <glm/geometric.hpp>

#include "base/file.hpp"
#include "render/avatar/animation_sampler.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/skin_vertices.hpp"
#include "render/import/model_reader.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::render {
namespace {

namespace fs = std::filesystem;
using motion::Bone;

// Where models and tables lie: a few in the repository, all beside it.
struct Place {
    const char* name;
    std::vector<fs::path> models;  // folders
    fs::path clips;
    fs::path tables;
    fs::path poses;
    bool is_whole = false;
};

Place in_repository() {
    const fs::path data = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";
    const fs::path tables = data / "three_vrm";
    return {"repository", {data}, data, tables, tables / "poses.json"};
}

Place in_shared_data() {
    const fs::path data = raks::test::shared_data() / "avatars";
    const fs::path models = data / "models";
    return {"shared",
            {models / "vrm0", models / "vrm1"},
            models / "vrma",
            data / "reference" / "three_vrm",
            data / "reference" / "mannequin.json",
            true};
}

fs::path model_path(const Place& place, const std::string& name) {
    for (const fs::path& folder : place.models) {
        fs::path path = folder / (name + ".vrm");
        if (fs::exists(path)) {
            return path;
        }
    }
    return {};
}

using Row = std::vector<std::string>;

std::vector<Row> rows_of(const fs::path& path) {
    std::istringstream text(read_file(path).value());
    std::vector<Row> rows;
    std::string line;
    std::getline(text, line);  // the heads
    while (std::getline(text, line)) {
        std::istringstream cells(line);
        Row row;
        for (std::string cell; std::getline(cells, cell, '\t');) {
            row.push_back(cell);
        }
        rows.push_back(row);
    }
    return rows;
}

int whole(const std::string& text) { return std::stoi(text); }

glm::vec3 place_of(const Row& row, std::size_t first) {
    return {std::stof(row[first]), std::stof(row[first + 1]), std::stof(row[first + 2])};
}

// The largest difference of a coordinate, and where it is.
struct Worst {
    float difference = 0.0F;
    std::string where = "nowhere";

    void see(const glm::vec3& a, const glm::vec3& b, const Row& row) {
        const glm::vec3 d = glm::abs(a - b);
        const float largest = std::max({d.x, d.y, d.z});
        if (!(largest <= difference)) {
            difference = largest;
            where.clear();
            for (const std::string& cell : row) {
                where += cell + " ";
            }
        }
    }
};

struct Loaded {
    Model model;
    AvatarRig rig;
    RigState state;

    explicit Loaded(Model made) : model(std::move(made)), rig(build_rig(model)), state(rig) {}
};

class ThreeVrm : public testing::TestWithParam<Place> {
 protected:
    void SetUp() override {
        if (!fs::exists(GetParam().tables)) {
            GTEST_SKIP() << "no shared data";
        }
    }

    static const Place& place() { return GetParam(); }

    static Loaded load(const std::string& name) {
        auto model = load_model(model_path(place(), name));
        EXPECT_TRUE(model) << name << ": " << model.error().message;
        Loaded loaded(model ? std::move(*model) : Model{});
        EXPECT_TRUE(loaded.rig.warnings.empty()) << name << ": " << loaded.rig.warnings.front();
        return loaded;
    }

    // The models of which there is a table of this kind, which are `count` in all.
    static std::vector<std::string> models_with(const std::string& ending, std::size_t count) {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(place().tables)) {
            const std::string name = entry.path().filename().string();
            if (name.size() > ending.size() &&
                name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
                names.push_back(name.substr(0, name.size() - ending.size()));
            }
        }
        std::sort(names.begin(), names.end());
        EXPECT_TRUE(place().is_whole ? names.size() == count : !names.empty()) << names.size();
        return names;
    }

    static std::vector<Row> table(const std::string& name) {
        return rows_of(place().tables / name);
    }

    static std::map<std::string, motion::Pose> test_poses();
};

INSTANTIATE_TEST_SUITE_P(Places,
                         ThreeVrm,
                         testing::Values(in_repository(), in_shared_data()),
                         [](const auto& place) { return std::string(place.param.name); });

std::map<std::string, motion::Pose> ThreeVrm::test_poses() {
    auto document = nlohmann::json::parse(read_file(place().poses).value());
    if (document.contains("test_poses")) {
        document = document["test_poses"];
    }
    std::map<std::string, motion::Pose> poses;
    for (const auto& [name, bones] : document["poses"].items()) {
        motion::Pose& pose = poses[name];
        for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
            const auto found = bones.find(std::string(motion::kBoneNames[b]));
            if (found != bones.end() && found->is_array()) {
                const auto q = found->get<std::array<float, 4>>();
                pose.local_rotations[b] = glm::normalize(glm::quat(q[3], q[0], q[1], q[2]));
            }
        }
    }
    return poses;
}

// Vertices of all primitives of the model in one pose, by (node, primitive).
std::map<std::pair<int, int>, PosedVertices> posed_model(Loaded& avatar) {
    std::map<std::pair<int, int>, PosedVertices> posed;
    for (std::size_t n = 0; n < avatar.model.nodes.size(); ++n) {
        const int node = static_cast<int>(n);
        const int mesh = avatar.model.nodes[n].mesh;
        if (mesh < 0) {
            continue;
        }
        std::vector<glm::mat4> matrices(matrix_count(avatar.model, node));
        skinning_matrices(avatar.model, avatar.rig.tree, avatar.state.joints, node, matrices);
        const MorphRange range = avatar.rig.expressions.morphs_of(node);
        const std::span<const float> morphs(avatar.state.face.morphs);
        int index = 0;
        for (const ModelPrimitive& primitive :
             avatar.model.meshes[static_cast<std::size_t>(mesh)].primitives) {
            pose_vertices(primitive,
                          morphs.subspan(range.first, range.count),
                          matrices,
                          posed[{node, index++}]);
        }
    }
    return posed;
}

TEST_P(ThreeVrm, posed_vertices_lie_within_a_tenth_of_a_millimetre) {
    const std::vector<std::string> names = models_with(".posed.tsv", 11);
    std::map<std::string, motion::Pose> poses = test_poses();
    for (const std::string& name : names) {
        Loaded avatar = load(name);
        Worst worst;
        std::string shown;
        std::map<std::pair<int, int>, PosedVertices> vertices;
        for (const Row& row : table(name + ".posed.tsv")) {
            if (row[0] != shown) {
                shown = row[0];
                motion::Pose& pose = poses[shown];
                pose.hips_position = avatar.rig.humanoid.rest_hips();
                pose_joints(avatar.rig, pose, 1.0F, avatar.state);
                vertices = posed_model(avatar);
            }
            const PosedVertices& part = vertices[{whole(row[1]), whole(row[3])}];
            const auto vertex = static_cast<std::size_t>(whole(row[4]));
            ASSERT_LT(vertex, part.positions.size()) << name << " " << row[1];
            worst.see(part.positions[vertex], place_of(row, 5), row);
        }
        EXPECT_LT(worst.difference, 1e-4F) << name << ": " << worst.where;
    }
}

int node_of_bone(const Model& model, const std::string& bone) {
    const HumanoidMap& map = model.character.humanoid;
    const auto* const found = std::find(motion::kBoneNames.begin(), motion::kBoneNames.end(), bone);
    if (found != motion::kBoneNames.end()) {
        return map.nodes[static_cast<std::size_t>(found - motion::kBoneNames.begin())];
    }
    return bone == "leftEye" ? map.left_eye : bone == "rightEye" ? map.right_eye : map.jaw;
}

TEST_P(ThreeVrm, clips_move_the_joints_of_all_models_to_the_same_places) {
    for (const char* clip : {"test", "hips_spine_twisting", "six_poses"}) {
        const fs::path path = place().clips / (std::string(clip) + ".vrma");
        if (!place().is_whole && !fs::exists(path)) {
            continue;
        }
        const auto vrma = load_model(path);
        ASSERT_TRUE(vrma) << vrma.error().message;
        const AnimationSampler sampler(*vrma, 0);
        const std::string ending = "." + std::string(clip) + ".vrma.tsv";
        for (const std::string& name : models_with(ending, 11)) {
            Loaded avatar = load(name);
            const glm::vec3 rest = avatar.rig.humanoid.rest_hips();
            Worst worst;
            for (const Row& row : table(name + ending)) {
                motion::Pose pose = sampler.pose_at(std::stof(row[0]));
                float scale = rest.y / sampler.rest_hips().y;
                if (!sampler.has_travel()) {
                    pose.hips_position = rest;
                    scale = 1.0F;
                }
                pose_joints(avatar.rig, pose, scale, avatar.state);
                const int joint = avatar.rig.tree.joint_of(node_of_bone(avatar.model, row[1]));
                ASSERT_GE(joint, 0) << name << " " << row[1];
                const glm::mat4& world = avatar.state.joints.world[static_cast<std::size_t>(joint)];
                worst.see(glm::vec3(world[3]), place_of(row, 2), row);
            }
            EXPECT_LT(worst.difference, 1e-4F) << name << ", " << clip << ": " << worst.where;
        }
    }
}

// swing.bvh: the hips turn about y, the head nods.
motion::Pose swing_pose(StreamTime time, const glm::vec3& hips) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double t = to_seconds(time);
    const auto yaw = static_cast<float>(0.8 * std::sin(kTurn * t));
    const auto pitch = static_cast<float>(0.3 * std::sin(2.0 * kTurn * t));
    motion::Pose pose;
    pose.hips_position = hips;
    pose.rotation(Bone::hips) = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    pose.rotation(Bone::head) = glm::angleAxis(pitch, glm::vec3(1, 0, 0));
    return pose;
}

TEST_P(ThreeVrm, tails_swing_within_a_twentieth_of_a_millimetre) {
    const std::vector<std::string> names = models_with(".spring.tsv", 5);
    for (const std::string& name : names) {
        Loaded avatar = load(name);
        const SpringRig& springs = avatar.rig.springs;
        std::map<int, std::size_t> swing_of_node;
        for (std::size_t i = 0; i < springs.size(); ++i) {
            swing_of_node[avatar.rig.tree.nodes[springs.joint(i)]] = i;
        }
        const auto pose_at = [&](StreamTime time) {
            return swing_pose(time, avatar.rig.humanoid.rest_hips());
        };
        Worst worst;
        SpringStep done = -1;
        for (const Row& row : table(name + ".spring.tsv")) {
            while (done < whole(row[0])) {
                ++done;
                advance(avatar.rig, time_of_step(done), 1.0F, pose_at, avatar.state);
            }
            pose_avatar(avatar.rig, pose_at(time_of_step(done)), {}, 1.0F, avatar.state);
            ASSERT_EQ(swing_of_node.count(whole(row[1])), 1U) << name << " " << row[1];
            const std::size_t swing = swing_of_node[whole(row[1])];
            worst.see(springs.tail_place(swing, avatar.state.joints), place_of(row, 3), row);
        }
        EXPECT_LT(worst.difference, 5e-5F) << name << ": " << worst.where;
    }
}

// "happy=1+blink=0.6" as weights by expression.
std::vector<float> weights_of(const std::string& text, const ExpressionRig& rig) {
    std::vector<float> weights(rig.size(), 0.0F);
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, '+');) {
        const std::size_t sign = part.find('=');
        const int expression = rig.find(part.substr(0, sign));
        EXPECT_GE(expression, 0) << part;
        if (expression >= 0) {
            weights[static_cast<std::size_t>(expression)] = std::stof(part.substr(sign + 1));
        }
    }
    return weights;
}

TEST_P(ThreeVrm, expressions_weigh_morph_targets_the_same) {
    const std::vector<std::string> names = models_with(".expressions.tsv", 7);
    for (const std::string& name : names) {
        Loaded avatar = load(name);
        const ExpressionRig& rig = avatar.rig.expressions;
        std::map<std::string, std::map<std::size_t, float>> expected;  // by slot
        for (const Row& row : table(name + ".expressions.tsv")) {
            std::map<std::size_t, float>& weights = expected[row[0]];
            if (row[1] != "-") {
                const MorphRange range = rig.morphs_of(whole(row[1]));
                const auto target = static_cast<std::size_t>(whole(row[2]));
                ASSERT_LT(target, range.count) << name << " " << row[1];
                weights[range.first + target] = std::stof(row[3]);
            }
        }
        for (const auto& [asked, weights] : expected) {
            rig.apply(weights_of(asked, rig), avatar.state.face);
            for (std::size_t i = 0; i < avatar.state.face.morphs.size(); ++i) {
                const auto found = weights.find(i);
                const float truth = found == weights.end() ? 0.0F : found->second;
                EXPECT_NEAR(avatar.state.face.morphs[i], truth, 1e-5F)
                    << name << " " << asked << " " << i;
            }
        }
    }
}

}  // namespace
}  // namespace raks::render
