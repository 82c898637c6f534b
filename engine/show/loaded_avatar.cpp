#include "engine/show/loaded_avatar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <utility>

#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/standing_model.hpp"
#include "render/avatar/model_avatar.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/image.hpp"
#include "render/import/model_reader.hpp"
#include "render/mannequin/mannequin.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

/// All images of a model, unpacked; what cannot be read is left empty, with a warning. Images
/// beyond the memory that a character is worth are halved.
std::vector<render::Image> unpacked(render::Model& model) {
    std::vector<render::Image> images;
    for (const render::ModelImage& packed : model.images) {
        render::Image& image = images.emplace_back();
        if (packed.packed.empty()) {
            continue;  // the reader has said why
        }
        Expected<render::Image> read = render::decode_image(packed.packed, packed.halvings);
        if (read) {
            image = std::move(*read);
        } else {
            model.warnings.push_back(fmt::format(
                "image {}: {}; drawn white", printable(packed.name), read.error().message));
        }
    }
    return images;
}

/// The model's bones: its own map, or what names and shape say.
Expected<void> find_bones(render::Model& model) {
    if (auto mapped = render::map_humanoid(model); !mapped) {
        return mapped;
    }
    const std::string missing = render::missing_bones(model.character.humanoid);
    if (!missing.empty()) {
        return fail("no figure that can dance: it lacks " + missing);
    }
    return {};
}

}  // namespace

std::string credit_line(const render::Licence& licence, const std::string& file) {
    std::string line = printable(licence.title.empty() ? file : licence.title);
    if (!licence.authors.empty()) {
        line +=
            fmt::format(" by {}", printable(fmt::format("{}", fmt::join(licence.authors, ", "))));
    }
    if (!licence.name.empty()) {
        line += ", " + printable(licence.name);
    }
    if (licence.is_credit_required) {
        line += " (credit required)";
    }
    return line;
}

LoadedAvatar mannequin() {
    return {.avatar = std::make_shared<render::Avatar>(render::build_mannequin()),
            .name = std::string(kMannequinName),
            .credit = {},
            .is_credit_required = false,
            .warnings = {}};
}

Expected<LoadedAvatar> load_avatar(const std::string& name, std::optional<float> height) {
    const Expected<fs::path> path = find_avatar(name);
    if (!path) {
        return fail(path.error());
    }
    if (path->empty()) {
        return mannequin();
    }
    Expected<render::Model> model = render::load_model(*path);
    if (!model) {
        return fail(std::move(model.error()));
    }
    if (auto found = find_bones(*model); !found) {
        return fail(std::move(found.error()).in(printable(path->string())));
    }
    const render::RigOptions options = stand_model(*model, height);
    std::vector<render::Image> images = unpacked(*model);
    auto avatar =
        std::make_shared<render::Avatar>(render::build_avatar(*model, std::move(images), options));
    std::vector<std::string> warnings = std::move(model->warnings);
    warnings.insert(warnings.end(), avatar->rig->warnings.begin(), avatar->rig->warnings.end());
    return LoadedAvatar{.avatar = std::move(avatar),
                        .name = path->string(),
                        .credit = credit_line(model->character.licence, path->filename().string()),
                        .is_credit_required = model->character.licence.is_credit_required,
                        .warnings = std::move(warnings)};
}

}  // namespace raks::engine
