#include "tests/support/dances.hpp"

#include <algorithm>
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

std::vector<std::filesystem::path> written_dances() {
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies")) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace raks::test
