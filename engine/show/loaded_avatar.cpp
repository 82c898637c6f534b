#include "engine/show/loaded_avatar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "base/parallel.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "render/avatar/model_avatar.hpp"
#include "render/import/image_file.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/model/sub_meshes.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

/// Those of `packed`, unpacked, as large as their halvings say; what cannot be read is left empty,
/// with a line in `warnings`.
std::vector<render::Image> unpacked(const std::vector<render::ModelImage>& packed,
                                    std::vector<std::string>& warnings) {
    std::vector<render::Image> images;
    render::ModelUnpacker unpacker;
    for (const render::ModelImage& one : packed) {
        render::Image& image = images.emplace_back();
        if (one.packed.empty()) {
            continue;  // it is not drawn, or the reader has said why
        }
        Expected<render::Image> read = render::decode_image(unpacker, one.packed, one.halvings);
        if (read) {
            image = std::move(*read);
        } else {
            warnings.push_back(fmt::format(
                "image {}: {}; drawn white", printable(one.name), read.error().message));
        }
    }
    if (unpacker.is_uncaged()) {
        warnings.emplace_back(render::kUncagedWarning);
    }
    return images;
}

/// The images that materials of a model use, unpacked; the others are empty.
std::shared_ptr<render::SurfaceImages> drawn_images(render::Model& model) {
    std::vector<render::ModelImage> packed = model.images;
    const std::vector<bool> is_used = render::used_images(model);
    for (std::size_t i = 0; i < packed.size(); ++i) {
        if (!is_used[i]) {
            packed[i].packed.clear();
        }
    }
    std::vector<render::Image> images = unpacked(packed, model.warnings);
    return std::make_shared<render::SurfaceImages>(std::move(images), [packed = std::move(packed)] {
        std::vector<std::string> said_before;
        return unpacked(packed, said_before);
    });
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

std::vector<std::string> credits_of(const std::vector<LoadedAvatar>& avatars) {
    std::vector<std::string> credits;
    for (const LoadedAvatar& avatar : avatars) {
        if (!avatar.credit.empty() &&
            std::find(credits.begin(), credits.end(), avatar.credit) == credits.end()) {
            credits.push_back(avatar.credit);
        }
    }
    return credits;
}

LoadedAvatar mannequin(render::Costume costume) {
    return {.avatar = std::make_shared<render::Avatar>(
                render::build_mannequin({render::MannequinBuild::follow, costume})),
            .name = std::string(kMannequinName),
            .credit = {},
            .is_credit_required = false,
            .warnings = {},
            .is_mannequin = true};
}

std::shared_ptr<const render::Avatar> mannequin_partner(render::Costume costume) {
    return std::make_shared<render::Avatar>(
        render::build_mannequin({render::MannequinBuild::lead, costume}));
}

std::vector<LoadedAvatar> dressed(std::vector<LoadedAvatar> avatars, render::Costume costume) {
    std::shared_ptr<const render::Avatar> made;
    for (LoadedAvatar& avatar : avatars) {
        if (avatar.is_mannequin && avatar.avatar->style.costume != costume) {
            made = made == nullptr ? mannequin(costume).avatar : made;
            avatar.avatar = made;
        }
    }
    return avatars;
}

LoadedAvatar make_avatar(AvatarModel& figure,
                         const std::string& file,
                         std::size_t most_image_bytes) {
    render::Model& model = figure.model;
    render::fit_images(most_image_bytes, model);
    auto avatar = std::make_shared<render::Avatar>(
        render::build_avatar_with(drawn_images(model), model, figure.options));
    std::vector<std::string> warnings = model.warnings;
    warnings.insert(warnings.end(), avatar->rig->warnings.begin(), avatar->rig->warnings.end());
    return {.avatar = std::move(avatar),
            .name = {},
            .credit = credit_line(model.character.licence, file),
            .is_credit_required = model.character.licence.is_credit_required,
            .warnings = std::move(warnings),
            .is_mannequin = false};
}

Expected<LoadedAvatar> load_avatar(const std::string& name, const AvatarOptions& options) {
    const Expected<fs::path> path = find_avatar(name);
    if (!path) {
        return fail(path.error());
    }
    if (path->empty()) {
        return mannequin(options.costume);
    }
    Expected<AvatarModel> figure = load_avatar_model(*path, options);
    if (!figure) {
        return fail(std::move(figure.error()));
    }
    if (auto checked = check_has_surface(figure->model, *path); !checked) {
        return fail(std::move(checked.error()));
    }
    LoadedAvatar loaded = make_avatar(*figure, path->filename().string(), options.most_image_bytes);
    loaded.name = path->string();
    return loaded;
}

Expected<std::vector<LoadedAvatar>> load_avatars(const std::vector<std::string>& names,
                                                 const AvatarOptions& options) {
    std::vector<std::string> different;
    for (const std::string& name : names) {
        if (std::find(different.begin(), different.end(), name) == different.end()) {
            different.push_back(name);
        }
    }
    std::vector<std::optional<Expected<LoadedAvatar>>> loaded(different.size());
    run_parallel(loaded.size(),
                 static_cast<int>(std::thread::hardware_concurrency()),
                 [&](std::size_t i) { loaded[i].emplace(load_avatar(different[i], options)); });
    std::vector<LoadedAvatar> avatars;
    for (const std::string& name : names) {
        const auto place = std::find(different.begin(), different.end(), name) - different.begin();
        const Expected<LoadedAvatar>& one = *loaded[static_cast<std::size_t>(place)];
        if (!one) {
            return fail(one.error());
        }
        avatars.push_back(*one);
    }
    return avatars;
}

std::vector<motion::Skeleton> dance_bodies_of(const std::vector<LoadedAvatar>& avatars) {
    std::vector<motion::Skeleton> bodies;
    bodies.reserve(avatars.size());
    for (const LoadedAvatar& avatar : avatars) {
        bodies.push_back(render::dance_body(*avatar.avatar));
    }
    return bodies;
}

Costumes costumes_of(const std::vector<LoadedAvatar>& avatars, Partners partners) {
    Costumes costumes;
    const auto index_of = [&costumes](const std::shared_ptr<const render::Avatar>& body) {
        auto& bodies = costumes.bodies;
        const auto found = std::find(bodies.begin(), bodies.end(), body);
        const auto index = static_cast<std::size_t>(found - bodies.begin());
        if (found == bodies.end()) {
            bodies.push_back(body);
        }
        return index;
    };
    std::shared_ptr<const render::Avatar> lead;
    for (const LoadedAvatar& avatar : avatars) {
        std::vector<std::size_t>& builds = costumes.builds.emplace_back();
        builds.push_back(index_of(avatar.avatar));
        if (avatar.is_mannequin && partners == Partners::all) {
            lead = lead == nullptr ? mannequin_partner(avatar.avatar->style.costume) : lead;
            builds.push_back(index_of(lead));
        }
    }
    return costumes;
}

}  // namespace raks::engine
