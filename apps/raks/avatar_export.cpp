#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/avatar_model.hpp"
#include "engine/show/given_away.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/posed_text.hpp"
#include "render/export/glb_writer.hpp"
#include "render/export/segmented_model.hpp"
#include "render/export/tds_writer.hpp"
#include "render/export/vrm_writer.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

/// What the options say of whose work it is, over what the file says.
Expected<void> complete_licence(const AvatarExportArguments& arguments, render::Model& model) {
    render::Licence& licence = model.character.licence;
    if (!arguments.title.empty()) {
        licence.title = arguments.title;
    } else if (licence.title.empty()) {
        licence.title = model.name;
    }
    if (!arguments.authors.empty()) {
        licence.authors = arguments.authors;
    }
    if (!arguments.licence.empty()) {
        licence.name = arguments.licence;
    }
    if (licence.authors.empty()) {
        return fail("it does not say whose work it is: give --author NAME");
    }
    if (licence.name.empty()) {
        return fail("it does not say what may be done with it: give --licence TEXT");
    }
    return {};
}

/// A figure cut into rigid parts as it stands, any other thing as it is stored.
Expected<render::Model> load_segmented(const Path& file, const engine::AvatarOptions& options) {
    auto stored = render::load_model(file);
    if (!stored) {
        return stored;
    }
    const bool is_figure = engine::find_bones(*stored, options.labels) &&
                           render::missing_bones(stored->character.humanoid).empty();
    if (!is_figure && options.labels.empty()) {
        stored->warnings.emplace_back("it has no bones of a body: it is written as it is stored");
        return render::segmented_model(*stored);
    }
    const auto figure = engine::load_to_give_away(file, options);
    return figure ? Expected<render::Model>(render::segmented_model(*figure))
                  : fail(figure.error());
}

/// The model that is meant, in the way that its format has figures.
Expected<render::Model> model_of(const AvatarExportArguments& arguments, const Path& file) {
    const std::string ending = arguments.output.extension().string();
    if (file.empty()) {
        return ending == ".3ds" ? render::segmented_model(engine::mannequin_to_give_away())
                                : engine::mannequin_to_give_away();
    }
    return ending == ".vrm"   ? engine::load_to_give_away(file, arguments.options)
           : ending == ".3ds" ? load_segmented(file, arguments.options)
                              : render::load_model(file);
}

/// Which part is which bone, for Raks and for people; no text: of none it is known.
NamedFile labels_of(const render::Model& model,
                    const std::vector<std::string>& names,
                    const Path& output) {
    std::vector<render::BoneLabel> labels;
    const auto& bones = model.character.humanoid.nodes;
    for (std::size_t i = 0; i < bones.size(); ++i) {
        if (bones[i] >= 0) {
            labels.push_back({.bone = static_cast<motion::Bone>(i),
                              .node = names[static_cast<std::size_t>(bones[i])]});
        }
    }
    Path file = output;
    file.replace_extension(".labels.toml");
    return {file, labels.empty() ? std::string() : render::bone_labels_text(labels)};
}

/// Its parts; before them its pictures and the labels of a figure's bones, which go beside it.
Expected<std::vector<NamedFile>> tds_of(const render::Model& model, const Path& output) {
    auto made = render::tds_export(model, output.stem().string());
    if (!made) {
        return fail(made.error());
    }
    std::vector<NamedFile> files;
    for (const render::TdsPicture& picture : made->pictures) {
        files.push_back(
            {output.parent_path() / picture.name,
             {reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size()}});
    }
    if (NamedFile labels = labels_of(model, made->node_names, output); !labels.bytes.empty()) {
        files.push_back(std::move(labels));
    }
    files.push_back({output, std::move(made->bytes)});
    return files;
}

/// Its mesh at rest; before it its materials, which go into a file beside it.
std::vector<NamedFile> obj_of(const render::Model& model, const Path& output) {
    Path materials = output;
    materials.replace_extension(".mtl");
    const render::AvatarRig rig = render::build_rig(model);
    std::string mesh = render::obj_text(
        model, rig, render::RigState(rig), model.name, materials.filename().string());
    return {{materials, render::mtl_text(model)}, {output, std::move(mesh)}};
}

Expected<std::vector<NamedFile>> one_file(const Path& output, Expected<std::string> bytes) {
    if (!bytes) {
        return fail(std::move(bytes.error()));
    }
    return std::vector<NamedFile>{{output, std::move(*bytes)}};
}

/// What is to be written, the model itself last.
Expected<std::vector<NamedFile>> files_of(const AvatarExportArguments& arguments,
                                          const Path& file) {
    auto model = model_of(arguments, file);
    if (!model) {
        return fail(model.error());
    }
    const std::string shown = printable(file.empty() ? arguments.model : file.string());
    for (const std::string& warning : model->warnings) {
        say(fmt::format("{}: {}", shown, warning));
    }
    const std::string ending = arguments.output.extension().string();
    if (ending == ".obj") {
        return obj_of(*model, arguments.output);
    }
    if (ending == ".3ds") {
        return tds_of(*model, arguments.output);
    }
    if (ending == ".glb") {
        return one_file(arguments.output, render::glb_bytes(*model));
    }
    if (auto complete = complete_licence(arguments, *model); !complete) {
        return fail(std::move(complete.error()).in(shown));
    }
    auto bytes = render::vrm_bytes(*model);
    return bytes ? one_file(arguments.output, std::move(bytes))
                 : fail(std::move(bytes.error()).in(shown));
}

}  // namespace

ExitCode avatar_export(const AvatarExportArguments& arguments) {
    const std::string ending = arguments.output.extension().string();
    if (ending != ".vrm" && ending != ".glb" && ending != ".3ds" && ending != ".obj") {
        return fail(fmt::format("{}: an avatar is exported as .vrm, .glb, .3ds or .obj",
                                printable(arguments.output.string())));
    }
    const auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(file.error());
    }
    if (auto possible = check_output(arguments.output, {*file}); !possible) {
        return fail(possible.error());
    }
    const auto files = files_of(arguments, *file);
    if (!files) {
        return fail(files.error());
    }
    // What goes beside the model may have the name of labels that the command has read.
    const std::vector<Path> read = {*file, engine::find_labels(*file, arguments.options.labels)};
    for (const NamedFile& written : *files) {
        if (auto possible = check_is_no_input(written.path, read); !possible) {
            return fail(possible.error());
        }
    }
    return exit_code_of(write_files(*files));
}

}  // namespace raks::apps
