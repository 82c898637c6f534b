#include <string>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/given_away.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/posed_text.hpp"
#include "render/export/glb_writer.hpp"
#include "render/export/vrm_writer.hpp"
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

/// The model that is meant, in the way that its format has figures.
Expected<render::Model> model_of(const AvatarExportArguments& arguments, const Path& file) {
    if (file.empty()) {
        return engine::mannequin_to_give_away();
    }
    return arguments.output.extension() == ".vrm"
               ? engine::load_to_give_away(file, arguments.options)
               : render::load_model(file);
}

/// Its mesh at rest; its materials go into a file beside it.
Expected<std::string> obj_of(const render::Model& model, const Path& output) {
    Path materials = output;
    materials.replace_extension(".mtl");
    if (auto written = write_file(materials, render::mtl_text(model)); !written) {
        return fail(written.error());
    }
    const render::AvatarRig rig = render::build_rig(model);
    return render::obj_text(
        model, rig, render::RigState(rig), model.name, materials.filename().string());
}

Expected<std::string> bytes_of(const AvatarExportArguments& arguments, const Path& file) {
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
    if (ending == ".glb") {
        return render::glb_bytes(*model);
    }
    if (auto complete = complete_licence(arguments, *model); !complete) {
        return fail(std::move(complete.error()).in(shown));
    }
    auto bytes = render::vrm_bytes(*model);
    return bytes ? bytes : fail(std::move(bytes.error()).in(shown));
}

}  // namespace

ExitCode avatar_export(const AvatarExportArguments& arguments) {
    const std::string ending = arguments.output.extension().string();
    if (ending != ".vrm" && ending != ".glb" && ending != ".obj") {
        return fail(fmt::format("{}: an avatar is exported as .vrm, .glb or .obj",
                                printable(arguments.output.string())));
    }
    const auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(file.error());
    }
    if (auto possible = check_output(arguments.output, {*file}); !possible) {
        return fail(possible.error());
    }
    const auto bytes = bytes_of(arguments, *file);
    if (!bytes) {
        return fail(bytes.error());
    }
    if (auto written = write_file(arguments.output, *bytes); !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
