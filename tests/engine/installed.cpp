#include "tests/engine/installed.hpp"

#include <stdexcept>

#include "engine/setup/dance_cache.hpp"
#include "engine/setup/dance_files.hpp"

namespace raks::engine::installed {
namespace {

template <typename Value>
Value value_of(Expected<Value> expected) {
    if (!expected) {
        throw std::runtime_error(expected.error().message);
    }
    return std::move(*expected);
}

}  // namespace

const DanceCatalogue& dances() {
    static const DanceCatalogue catalogue = value_of(DanceCatalogue::load());
    return catalogue;
}

const AnalyzerModels& models() {
    static const AnalyzerModels loaded =
        value_of(load_analyzer_models(dances().list(), {TaggerUse::off, FileTags::read}));
    return loaded;
}

std::shared_ptr<const motion::DanceLibrary> library_of(const std::string& dance) {
    return value_of(load_dance(dances(),
                               dance,
                               motion::mannequin_skeleton(),
                               motion::DanceRole::lead,
                               {},
                               DanceCache({})));
}

Cast solo(const std::string& dance) {
    return cast_of(library_of(dance), motion::mannequin_skeleton(), 1);
}

}  // namespace raks::engine::installed
