#include <string>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/given_away.hpp"
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

Expected<std::string> bytes_of(const AvatarExportArguments& arguments, const Path& file) {
    const bool is_vrm = arguments.output.extension() == ".vrm";
    auto model =
        is_vrm ? engine::load_to_give_away(file, arguments.options) : render::load_model(file);
    if (!model) {
        return fail(model.error());
    }
    const std::string shown = printable(file.string());
    for (const std::string& warning : model->warnings) {
        say(fmt::format("{}: {}", shown, warning));
    }
    if (!is_vrm) {
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
    if (ending != ".vrm" && ending != ".glb") {
        return fail(fmt::format("{}: an avatar is exported as .vrm or .glb",
                                printable(arguments.output.string())));
    }
    const auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(file.error());
    }
    if (file->empty()) {
        return fail("the mannequin cannot be exported yet; name a file");
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
