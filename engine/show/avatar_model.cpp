#include "engine/show/avatar_model.hpp"

#include <algorithm>
#include <utility>

#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/standing_model.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

}  // namespace

Expected<void> find_bones(render::Model& model, const fs::path& labels) {
    if (labels.empty()) {
        return render::map_humanoid(model);
    }
    const auto read = render::load_labels(labels);
    if (!read) {
        return fail(read.error());
    }
    if (model.character.humanoid.nodes[0] >= 0) {
        model.warnings.push_back(printable(labels.string()) +
                                 ": not needed, the model names its bones itself");
    }
    return render::map_humanoid(model, &*read);
}

Expected<AvatarModel> load_avatar_model(const fs::path& file, const AvatarOptions& options) {
    auto model = render::load_model(file);
    if (!model) {
        return fail(std::move(model.error()));
    }
    if (auto found = find_bones(*model, find_labels(file, options.labels)); !found) {
        return fail(std::move(found.error()).in(printable(file.string())));
    }
    const std::string missing = render::missing_bones(model->character.humanoid);
    if (!missing.empty()) {
        return fail(printable(file.string()) + ": no figure that can dance: it lacks " + missing);
    }
    render::RigOptions rig = stand_model(*model, options.height);
    return AvatarModel{std::move(*model), std::move(rig)};
}

Expected<void> check_has_surface(const render::Model& model, const fs::path& file) {
    const auto is_drawn = [&](const render::ModelNode& node) {
        return node.mesh >= 0 &&
               !model.meshes[static_cast<std::size_t>(node.mesh)].primitives.empty();
    };
    if (std::any_of(model.nodes.begin(), model.nodes.end(), is_drawn)) {
        return {};
    }
    return fail(fmt::format("{}: {}", printable(file.string()), kMotionAlone));
}

}  // namespace raks::engine
