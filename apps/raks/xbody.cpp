#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "apps/xbody/shown_model.hpp"
#include "apps/xbody/xbody_picture.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/avatar_files.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Errors: what can be said before anything is read.
Expected<XbodyPicture> check(const XbodyArguments& arguments) {
    if (arguments.output.extension() != ".png") {
        return fail(
            fmt::format("{}: a picture is written as .png", printable(arguments.output.string())));
    }
    const auto size = engine::parse_size(arguments.size);
    if (!size) {
        return fail("--size: " + size.error().message);
    }
    auto possible = check_output(arguments.output,
                                 {arguments.model, engine::AvatarClip::file_of(arguments.motion)});
    if (!possible) {
        return fail(std::move(possible.error()));
    }
    return XbodyPicture{.frame = arguments.frame,
                        .view = arguments.view,
                        .size = *size,
                        .has_names = arguments.has_names};
}

Expected<ShownModel> load(const XbodyArguments& arguments) {
    auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(std::move(file.error()));
    }
    if (file->empty()) {
        return fail("the mannequin is no file: it is made by Raks itself");
    }
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    return load_shown_model(
        {std::move(*file), arguments.options, arguments.motion, std::move(*joints)});
}

}  // namespace

ExitCode xbody(const XbodyArguments& arguments) {
    const auto picture = check(arguments);
    if (!picture) {
        return fail(picture.error());
    }
    const auto model = load(arguments);
    if (!model) {
        return fail(model.error());
    }
    for (const std::string& note : model->notes) {
        say(fmt::format("{}: {}", printable(arguments.model), note));
    }
    return exit_code_of(write_xbody_picture(arguments.output, *model, *picture));
}

}  // namespace raks::apps
