#include "engine/dance_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/suggest.hpp"
#include "engine/settings.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {
namespace {

/// The figures of each dance, as files below models/trained.
struct DanceFiles {
    std::string_view dance;
    std::array<std::string_view, 1> figures;
};
constexpr std::array<DanceFiles, 1> kDances = {{{"salsa", {"salsa_basic_lead.json"}}}};

constexpr std::string_view kAuto = "auto";

}  // namespace

std::vector<std::string> known_dances() {
    std::vector<std::string> names;
    names.reserve(std::size(kDances));
    for (const DanceFiles& files : kDances) {
        names.emplace_back(files.dance);
    }
    return names;
}

Expected<void> check_dance(const std::string& dance) {
    std::vector<std::string_view> known = {kAuto};
    for (const DanceFiles& files : kDances) {
        known.push_back(files.dance);
    }
    if (std::find(known.begin(), known.end(), dance) == known.end()) {
        return fail(unknown_name("dance", dance, known));
    }
    return {};
}

std::string dance_to_load(const Settings& settings) {
    return settings.dance == kAuto ? settings.fallback_dance : settings.dance;
}

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const std::string& dance) {
    if (auto checked = check_dance(dance); !checked) {
        return fail(checked.error());
    }
    const auto files =
        std::find_if(kDances.begin(), kDances.end(), [&](const DanceFiles& candidate) {
            return candidate.dance == dance;
        });
    std::vector<motion::FigureModel> figures;
    for (const std::string_view name : files->figures) {
        const auto path = data_path(std::filesystem::path("models") / "trained" / name);
        if (!path) {
            return fail(path.error());
        }
        auto figure = motion::load_figure(*path);
        if (!figure) {
            return fail(figure.error());
        }
        figures.push_back(std::move(*figure));
    }
    return motion::DanceLibrary::build(figures, motion::mannequin_skeleton());
}

}  // namespace raks::engine
