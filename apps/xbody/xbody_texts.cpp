#include "apps/xbody/xbody_texts.hpp"

#include "base/printable.hpp"
#include "render/model/model_survey.hpp"
#include "render/model/sub_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

constexpr std::size_t kWidth = 50;  // letters in a line

std::string material_name(const render::Model& model, int material) {
    return material < 0 ? std::string("no material")
                        : printable(model.materials[static_cast<std::size_t>(material)].name, 24);
}

std::string textures_text(const render::SubMesh& part) {
    std::string text;
    for (const auto& [width, height] : part.textures) {
        text += fmt::format("{}{}x{}", text.empty() ? "" : ", ", width, height);
    }
    return text.empty() ? "no texture" : text;
}

void add_wrapped(std::vector<XbodyLine>& lines, std::string_view text, bool is_warning) {
    for (std::string& line : wrapped(text, kWidth)) {
        lines.push_back({.text = std::move(line), .is_warning = is_warning});
    }
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    while (text.size() > width) {
        const std::size_t space = text.rfind(' ', width);
        const bool has_space = space != std::string_view::npos && space > 0;
        const std::size_t end = has_space ? space : width;
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(has_space ? end + 1 : end);
    }
    lines.emplace_back(text);
    return lines;
}

std::string xbody_title(const ShownModel& model) {
    return "Raks: xbody " + printable(model.file().filename().string());
}

std::vector<XbodyLine> mesh_lines(const render::Model& model) {
    std::vector<XbodyLine> lines;
    for (const render::SubMesh& part : render::sub_meshes(model)) {
        const auto& node = model.nodes[static_cast<std::size_t>(part.node)];
        lines.push_back(
            {.text = fmt::format(
                 "{} / {}", printable(node.name, 24), material_name(model, part.material)),
             .is_title = true});
        lines.push_back({.text = fmt::format("{} vertices, {} triangles, {}",
                                             part.vertices,
                                             part.triangles,
                                             textures_text(part))});
        lines.push_back(
            {.text = fmt::format("{} joints, {} morph targets", part.joints, part.morphs)});
        if (part.box) {
            const glm::vec3 size = part.box->high - part.box->low;
            lines.push_back(
                {.text = fmt::format("box {:.3g} x {:.3g} x {:.3g}", size.x, size.y, size.z)});
        }
        if (part.uneven_weights > 0) {
            lines.push_back(
                {.text = fmt::format("{} vertices: weights do not sum to 1", part.uneven_weights),
                 .is_warning = true});
        }
    }
    return lines;
}

std::vector<XbodyLine> file_lines(const ShownModel& model) {
    const render::ModelSurvey survey = render::survey(model.as_read);
    std::vector<XbodyLine> lines = {
        {.text = printable(model.file().filename().string(), 40) + ": " + survey.format,
         .is_title = true}};
    add_wrapped(lines,
                fmt::format("{} vertices, {} triangles, {} meshes of {} parts, {} joints of {} "
                            "nodes, {} images, {} animations, {} expressions, {} springs",
                            survey.vertices,
                            survey.triangles,
                            survey.meshes,
                            survey.primitives,
                            survey.joints,
                            survey.nodes,
                            survey.images,
                            survey.animations,
                            survey.expressions,
                            survey.springs),
                false);
    const render::Licence& licence = model.as_read.character.licence;
    lines.push_back({.text = "Licence", .is_title = true});
    const auto add = [&lines](std::string_view what, const std::string& value) {
        if (!value.empty()) {
            add_wrapped(lines, fmt::format("{}: {}", what, printable(value, 200)), false);
        }
    };
    add("title", licence.title);
    add("by", fmt::format("{}", fmt::join(licence.authors, ", ")));
    add("copyright", licence.copyright);
    add("licence", licence.name);
    add("credit", licence.is_credit_required ? "must be given" : "");
    for (const auto& [key, value] : licence.terms) {
        add(printable(key, 60), value);
    }
    if (lines.back().is_title) {
        lines.push_back({.text = "the file says nothing of it"});
    }
    lines.push_back({.text = "Mended or left out", .is_title = true});
    for (const std::string& note : model.notes) {
        add_wrapped(lines, note, true);
    }
    if (model.notes.empty()) {
        lines.push_back({.text = "nothing"});
    }
    return lines;
}

std::vector<XbodyLine> film_lines(const ShownModel& model, const std::filesystem::path& folder) {
    std::vector<XbodyLine> lines;
    add_wrapped(lines,
                fmt::format("{} As large as the view.",
                            model.clip ? fmt::format("A film has all {} frames, at the rate below.",
                                                     model.frame_count())
                                       : std::string("It stands: a film has one picture.")),
                false);
    add_wrapped(lines,
                fmt::format("Into {}: raks-{}-1, then -2 and on.",
                            folder.empty() ? std::string("the folder that raks was started in")
                                           : printable(folder.string()),
                            printable(model.file().stem().string(), 40)),
                false);
    return lines;
}

}  // namespace raks::apps
