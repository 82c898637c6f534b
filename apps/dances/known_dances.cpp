#include "apps/dances/known_dances.hpp"

#include "engine/setup/dance_catalogue.hpp"

namespace raks::apps {

Expected<engine::AnalyzerModels> load_models_of_known_dances(const engine::GenreAids& aids) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    return engine::load_analyzer_models(catalogue->list(), aids);
}

}  // namespace raks::apps
