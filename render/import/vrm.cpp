#include "render/import/vrm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.hpp"
#include "render/import/lenient.hpp"
#include "render/import/node_tree.hpp"
#include "render/import/vrm_parts.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostTerms = 100;  // VRM knows 14

/// A text, "true" or "false", or texts joined by ", "; anything else is empty, with a warning.
std::string term_text(const JsonField& field, Model& model) {
    JsonFaults no_truth;
    const bool truth = field.noting_to(no_truth).truth_or(false);
    if (!no_truth.any()) {
        return truth ? "true" : "false";
    }
    if (!field.is_array()) {
        return lenient_text(field, model);
    }
    std::string all;
    for (const JsonField& item : field.items()) {
        const std::string one = item.is_text() ? lenient_text(item, model) : std::string();
        all += all.empty() || one.empty() ? one : ", " + one;
    }
    return all;
}

}  // namespace

bool is_known_version(const JsonField& extension, Model& model) {
    const JsonField field = extension["specVersion"];
    const std::string version = field.is_text() ? lenient_text(field, model) : std::string();
    if (version == "1.0") {
        return true;
    }
    if (version.empty() || version.rfind("1.", 0) == 0) {
        warn(model, field.line(fmt::format("\"{}\" is not 1.0; read as 1.0", version)));
        return true;
    }
    return false;
}

std::size_t morphs_of_node(const Model& model, int node) {
    const int mesh = node_of(model, node).mesh;
    if (mesh < 0) {
        return 0;
    }
    const ModelMesh& found = model.meshes[static_cast<std::size_t>(mesh)];
    return found.primitives.empty() ? 0 : found.primitives.front().morphs.size();
}

void read_terms(const JsonField& meta,
                std::initializer_list<std::string_view> others,
                Model& model) {
    for (const auto& [key, field] : meta.entries()) {
        if (std::find(others.begin(), others.end(), key) != others.end()) {
            continue;
        }
        if (model.character.licence.terms.size() == kMostTerms) {
            warn(model, meta.line("says more than 100 things about its use; the rest is left out"));
            return;
        }
        std::string value = term_text(field, model);
        if (!value.empty()) {
            model.character.licence.terms.emplace_back(printable(key, 100), std::move(value));
        }
    }
}

Expected<void> read_character(const JsonField& root, Model& model) {
    const JsonField extensions = root["extensions"];
    const JsonField vrm1 = extensions["VRMC_vrm"];
    const JsonField vrm0 = extensions["VRM"];
    const JsonField animation = extensions["VRMC_vrm_animation"];
    read_mtoon1(root["materials"], model);
    if (vrm1.exists()) {
        if (vrm0.exists()) {
            warn(model, "both VRM 0.x and 1.0 are in the file; VRM 1.0 is read");
        }
        if (Expected<void> read = read_vrm1(vrm1, model); !read) {
            return read;
        }
    } else if (vrm0.exists()) {
        return read_vrm0(vrm0, model);
    } else if (animation.exists()) {
        return read_vrm_animation(animation, model);
    }
    read_constraints(root["nodes"], model);
    if (const JsonField springs = extensions["VRMC_springBone"]; springs.exists()) {
        read_springs1(springs, model);
    }
    return {};
}

}  // namespace raks::render
