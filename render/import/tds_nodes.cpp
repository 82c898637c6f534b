#include "render/import/tds_nodes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/tds_meshes.hpp"
#include "render/import/tds_tracks.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

constexpr int kDeepestTdsNode = 1'000;
constexpr std::string_view kTdsDummy = "$$$DUMMY";

/// y up from z up.
glm::mat4 y_up_matrix() {
    glm::mat4 matrix(1.0F);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 unit(0.0F);
        unit[axis] = 1.0F;
        matrix[axis] = glm::vec4(with_y_up(unit), 0.0F);
    }
    return matrix;
}

/// What its own name and that of its object make of a node's name.
std::string name_of(const TdsNode& node) {
    const bool is_dummy = node.name == kTdsDummy;
    std::string name = node.instance.empty() ? node.name : node.instance;
    if (!is_dummy && !node.instance.empty()) {
        name = node.name + "." + node.instance;
    }
    return node.kind == TdsNodeKind::target ? name + ".target" : name;
}

/// Brings the nodes of a file into a model.
class NodeAdder {
 public:
    NodeAdder(const TdsFile& file,
              const std::map<std::string, int>& materials,
              ImportBudget& budget,
              Model& model)
        : file_(file), materials_(materials), budget_(budget), model_(model) {
        for (std::size_t i = 0; i < file.objects.size(); ++i) {
            if (!objects_.try_emplace(file.objects[i].name, i).second) {
                warn(model,
                     fmt::format("several objects have one name, such as \"{}\"",
                                 printable(file.objects[i].name, 60)));
            }
        }
        is_used_.resize(file.objects.size(), false);
    }

    Expected<void> add() {
        if (file_.nodes.size() + file_.objects.size() > kMostTdsNodes) {
            return fail(fmt::format("there are more than {} nodes", kMostTdsNodes));
        }
        for (const TdsNode& node : file_.nodes) {
            if (auto good = add_node(node); !good) {
                return good;
            }
        }
        set_parents();
        for (std::size_t i = 0; i < file_.objects.size(); ++i) {
            if (auto good = is_used_[i] ? Expected<void>() : add_object(i); !good) {
                return good;
            }
        }
        return set_children();
    }

 private:
    Expected<void> add_node(const TdsNode& from) {
        ModelNode node;
        node.name = unique_name(name_of(from));
        set_rest(from, node);
        if (from.kind == TdsNodeKind::object && from.name != kTdsDummy) {
            const std::optional<std::size_t> object = object_of(from);
            if (!object) {
                warn(model_, fmt::format("\"{}\": there is no object of this name", node.name));
            } else if (auto good = hang_mesh(*object, from.pivot, node); !good) {
                return good;
            }
        }
        model_.nodes.push_back(std::move(node));
        return {};
    }

    /// The object that a node shows: of several of its name, the first that none shows yet.
    std::optional<std::size_t> object_of(const TdsNode& node) {
        const auto named = objects_.find(node.name);
        if (named == objects_.end()) {
            return std::nullopt;
        }
        std::size_t& next = next_of_name_.try_emplace(node.name, named->second).first->second;
        while (next < file_.objects.size() &&
               (is_used_[next] || file_.objects[next].name != node.name)) {
            ++next;
        }
        return next < file_.objects.size() ? next : named->second;
    }

    /// An object's own place: where its axes begin.
    Expected<void> add_object(std::size_t index) {
        const TdsObject& object = file_.objects[index];
        ModelNode node;
        node.name = unique_name(object.name);
        const glm::vec3 origin(object.world_from_object[3]);
        node.translation = with_y_up(origin);
        if (!object.triangles.empty()) {
            const glm::mat4 from_world = y_up_matrix() * glm::translate(glm::mat4(1.0F), -origin);
            auto mesh = make_tds_mesh(object, from_world, materials_, budget_);
            if (!mesh) {
                return fail(mesh.error());
            }
            node.mesh = static_cast<int>(model_.meshes.size());
            model_.meshes.push_back(std::move(*mesh));
        }
        model_.nodes.push_back(std::move(node));
        return {};
    }

    Expected<void> hang_mesh(std::size_t index, const glm::vec3& pivot, ModelNode& node) {
        const TdsObject& object = file_.objects[index];
        is_used_[index] = true;
        if (object.triangles.empty()) {
            warn(model_, fmt::format("\"{}\" has no triangles", node.name));
            return {};
        }
        const auto [known, is_new] = meshes_.try_emplace(
            std::tuple(index, pivot.x, pivot.y, pivot.z), static_cast<int>(model_.meshes.size()));
        node.mesh = known->second;
        if (!is_new) {
            return {};
        }
        const glm::mat4 from_world =
            y_up_matrix() * glm::translate(glm::mat4(1.0F), -pivot) * object_from_world(object);
        auto mesh = make_tds_mesh(object, from_world, materials_, budget_);
        if (!mesh) {
            return fail(mesh.error());
        }
        model_.meshes.push_back(std::move(*mesh));
        return {};
    }

    /// The inverse of an object's axes. Mirrored axes are written of objects whose x is turned
    /// round besides.
    glm::mat4 object_from_world(const TdsObject& object) {
        constexpr float kLeastVolume = 1e-12F;
        const float volume = glm::determinant(glm::mat3(object.world_from_object));
        if (!(std::abs(volume) > kLeastVolume && std::abs(volume) < 1.0F / kLeastVolume)) {
            warn(model_,
                 fmt::format("\"{}\" has axes that cannot be inverted: it stays where its "
                             "vertices are",
                             printable(object.name, 60)));
            return glm::mat4(1.0F);
        }
        glm::mat4 inverse = glm::inverse(object.world_from_object);
        if (volume < 0.0F) {
            inverse = glm::scale(glm::mat4(1.0F), glm::vec3(-1.0F, 1.0F, 1.0F)) * inverse;
        }
        return inverse;
    }

    std::string unique_name(const std::string& wanted) {
        std::string name = printable(wanted, 200);
        if (name != wanted) {
            warn(model_,
                 fmt::format(
                     "the name \"{}\" is too long or holds control characters: it is shown in part",
                     printable(name, 60)));
        }
        if (wanted.empty()) {
            warn(model_, "an object has no name");
            name = "object";
        }
        if (names_.insert(name).second) {
            return name;
        }
        int& last = last_of_name_.try_emplace(name, 0).first->second;
        std::string numbered;
        do {
            numbered = fmt::format("{}.{:03}", name, ++last);
        } while (!names_.insert(numbered).second);
        warn(model_,
             fmt::format("another node is named \"{}\", too: this one is \"{}\"", name, numbered));
        return numbered;
    }

    /// Ids are those that stand there, else the order.
    void set_parents() {
        std::map<std::size_t, int> by_id;
        for (std::size_t i = 0; i < file_.nodes.size(); ++i) {
            const std::size_t id = file_.nodes[i].id ? *file_.nodes[i].id : i;
            if (!by_id.try_emplace(id, static_cast<int>(i)).second) {
                warn(model_, fmt::format("two nodes have the id {}; children go to the first", id));
            }
        }
        for (std::size_t i = 0; i < file_.nodes.size(); ++i) {
            const TdsNode& node = file_.nodes[i];
            if (!node.parent) {
                continue;
            }
            const auto found = by_id.find(*node.parent);
            if (found == by_id.end()) {
                warn(model_,
                     fmt::format(
                         "\"{}\": its parent {} is not there", model_.nodes[i].name, *node.parent));
            } else {
                model_.nodes[i].parent = found->second;
                note_aim(found->second, i);
            }
        }
        cut_cycles();
    }

    /// Where cameras and lamps aim is not read, so what hangs on them does not turn with it.
    void note_aim(int parent, std::size_t node) {
        const TdsNodeKind kind = file_.nodes[static_cast<std::size_t>(parent)].kind;
        if (kind == TdsNodeKind::camera || kind == TdsNodeKind::light) {
            warn(model_,
                 fmt::format("\"{}\" hangs on a camera or a light, whose aim is left out",
                             model_.nodes[node].name));
        }
    }

    /// A node that is its own ancestor becomes a root.
    void cut_cycles() {
        constexpr int kUnseen = -1;
        std::vector<int> seen_from(model_.nodes.size(), kUnseen);
        for (std::size_t start = 0; start < model_.nodes.size(); ++start) {
            int node = static_cast<int>(start);
            while (node >= 0 && seen_from[static_cast<std::size_t>(node)] == kUnseen) {
                seen_from[static_cast<std::size_t>(node)] = static_cast<int>(start);
                ModelNode& here = model_.nodes[static_cast<std::size_t>(node)];
                const int up = here.parent;
                if (up >= 0 && seen_from[static_cast<std::size_t>(up)] == static_cast<int>(start)) {
                    warn(model_, fmt::format("\"{}\" hangs on its own child", here.name));
                    here.parent = -1;
                }
                node = here.parent;
            }
        }
    }

    Expected<void> set_children() {
        std::vector<std::pair<int, int>> open;  // node, depth
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            const int parent = model_.nodes[i].parent;
            if (parent < 0) {
                model_.roots.push_back(static_cast<int>(i));
                open.emplace_back(static_cast<int>(i), 1);
            } else {
                model_.nodes[static_cast<std::size_t>(parent)].children.push_back(
                    static_cast<int>(i));
            }
        }
        for (std::size_t next = 0; next < open.size(); ++next) {
            const auto [node, depth] = open[next];
            if (depth > kDeepestTdsNode) {
                return fail(
                    fmt::format("has more than {} nodes below one another", kDeepestTdsNode));
            }
            for (const int child : model_.nodes[static_cast<std::size_t>(node)].children) {
                open.emplace_back(child, depth + 1);
            }
        }
        return {};
    }

    const TdsFile& file_;
    const std::map<std::string, int>& materials_;
    ImportBudget& budget_;
    Model& model_;
    std::map<std::string, std::size_t> objects_;       // first of each name
    std::map<std::string, std::size_t> next_of_name_;  // where to look on for one that is not shown
    std::vector<bool> is_used_;
    std::map<std::tuple<std::size_t, float, float, float>, int> meshes_;  // by object and pivot
    std::set<std::string> names_;
    std::map<std::string, int> last_of_name_;
};

}  // namespace

Expected<void> add_tds_nodes(const TdsFile& file,
                             const std::map<std::string, int>& materials,
                             ImportBudget& budget,
                             Model& model) {
    return NodeAdder(file, materials, budget, model).add();
}

}  // namespace raks::render
