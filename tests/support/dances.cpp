#include "tests/support/dances.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace raks::test {

std::shared_ptr<const DanceList> shipped_dances() {
    auto file = load_dances(std::string(RAKS_SOURCE_DIR) + "/models/trained/dances.toml");
    if (!file) {
        throw std::runtime_error(file.error().message);
    }
    return std::make_shared<const DanceList>(std::move(file->dances));
}

}  // namespace raks::test
