#include "apps/dances/known_dances.hpp"

#include "engine/setup/dance_catalogue.hpp"

namespace raks::apps {

Expected<engine::AnalyzerModels> load_models_of_known_dances(engine::TaggerUse tagger) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    return engine::load_analyzer_models(catalogue->list(), tagger);
}

}  // namespace raks::apps
