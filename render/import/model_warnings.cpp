#include "render/import/model_warnings.hpp"

#include <algorithm>

#include "base/printable.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostWarnings = 40;

}  // namespace

void warn(Model& model, const std::string& line) {
    std::vector<std::string>& warnings = model.warnings;
    if (warnings.size() > kMostWarnings) {
        return;
    }
    if (warnings.size() == kMostWarnings) {
        warnings.emplace_back("there are more like these");
        return;
    }
    std::string fit = printable(line, 300);
    if (std::find(warnings.begin(), warnings.end(), fit) == warnings.end()) {
        warnings.push_back(std::move(fit));
    }
}

}  // namespace raks::render
