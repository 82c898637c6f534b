#include "engine/show/bone_labelling.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "base/utf8.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using render::BoneLabel;

bool is_before(const BoneLabel& one, const BoneLabel& other) { return one.bone < other.bone; }

}  // namespace

BoneLabelling bone_labelling(const std::vector<BoneLabel>& labels) {
    std::vector<BoneLabel> kept;
    for (const BoneLabel& label : labels) {
        const bool is_free = std::none_of(kept.begin(), kept.end(), [&](const BoneLabel& other) {
            return other.bone == label.bone || other.node == label.node;
        });
        if (is_free) {
            kept.push_back(label);
        }
    }
    std::sort(kept.begin(), kept.end(), is_before);
    return BoneLabelling(std::move(kept));
}

Expected<void> label_bone(const render::Model& model,
                          motion::Bone bone,
                          int node,
                          BoneLabelling& labelling) {
    const std::string& name = model.nodes[static_cast<std::size_t>(node)].name;
    const auto count = std::count_if(model.nodes.begin(),
                                     model.nodes.end(),
                                     [&](const auto& other) { return other.name == name; });
    if (name.empty() || count > 1 || !is_utf8(name)) {
        return fail(
            fmt::format("\"{}\" cannot be labelled: {}; name it in the program that it comes from",
                        printable(name, 40),
                        name.empty() ? "it has no name"
                        : count > 1  ? "another node has that name"
                                     : "its name is no UTF-8"));
    }
    std::vector<BoneLabel> next = labelling.now();
    std::erase_if(next,
                  [&](const BoneLabel& label) { return label.bone == bone || label.node == name; });
    next.push_back({.bone = bone, .node = name});
    std::sort(next.begin(), next.end(), is_before);
    labelling.change(std::move(next));
    return {};
}

void unlabel_bone(motion::Bone bone, BoneLabelling& labelling) {
    std::vector<BoneLabel> next = labelling.now();
    std::erase_if(next, [bone](const BoneLabel& label) { return label.bone == bone; });
    labelling.change(std::move(next));
}

void set_rest_axis(motion::Bone bone, const glm::vec3& axis, BoneLabelling& labelling) {
    std::vector<BoneLabel> next = labelling.now();
    for (BoneLabel& label : next) {
        label.axis = label.bone == bone ? axis : label.axis;
    }
    labelling.change(std::move(next));
}

glm::vec3 next_rest_axis(const glm::vec3& axis) noexcept {
    if (axis == glm::vec3(0.0F)) {
        return {1.0F, 0.0F, 0.0F};
    }
    const float side = axis.x + axis.y + axis.z;
    if (axis.z != 0.0F) {
        return side > 0.0F ? glm::vec3(-1.0F, 0.0F, 0.0F) : glm::vec3(0.0F);
    }
    return {0.0F, axis.x, axis.y};
}

Expected<void> save_labels(const std::filesystem::path& file, BoneLabelling& labelling) {
    if (labelling.now().empty()) {
        std::error_code error;
        std::filesystem::remove(file, error);
        if (error) {
            return fail(printable(file.string()) + ": cannot remove it: " + error.message());
        }
    } else if (auto written = write_file(file, render::bone_labels_text(labelling.now()));
               !written) {
        return written;
    }
    labelling.mark_saved();
    return {};
}

}  // namespace raks::engine
