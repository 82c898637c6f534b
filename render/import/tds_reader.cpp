#include "render/import/tds_reader.hpp"

#include <fmt/format.h>

#include "render/import/import_budget.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/tds_file.hpp"
#include "render/import/tds_materials.hpp"
#include "render/import/tds_nodes.hpp"
#include "render/import/tds_tracks.hpp"

namespace raks::render {
namespace {

/// What the file has and Raks does not show.
void note_left_out_of_tds(const TdsFile& file, Model& model) {
    if (file.cameras > 0) {
        warn(model, fmt::format("{} cameras are left out", file.cameras));
    }
    if (file.lights > 0) {
        warn(model, fmt::format("{} lights are left out", file.lights));
    }
    for (const std::string& note : file.notes) {
        warn(model, note);
    }
}

}  // namespace

Expected<Model> read_tds(std::span<const std::byte> file, const SideFiles& side) {
    const auto parsed = parse_tds(file);
    if (!parsed) {
        return fail(parsed.error());
    }
    Model model;
    model.format = fmt::format("3DS v{}", parsed->version);
    // What was parsed takes no more than three times the file.
    const std::size_t taken = 4 * file.size();
    ImportBudget budget(taken < kMostModelBytes ? kMostModelBytes - taken : 0);
    const auto materials = add_tds_materials(*parsed, side, budget, model);
    if (const auto good = add_tds_nodes(*parsed, materials, budget, model); !good) {
        return fail(good.error());
    }
    add_tds_clip(*parsed, budget, model);
    note_left_out_of_tds(*parsed, model);
    return model;
}

}  // namespace raks::render
