#include "apps/reports/bound.hpp"

#include <cmath>

#include <fmt/format.h>

namespace raks::apps {

std::string bound_cell(const std::optional<Bound>& bound, int digits) {
    if (!bound) {
        return "";
    }
    const auto number = [&](double value) { return fmt::format("{:.{}f}", value, digits); };
    if (std::isinf(bound->lowest)) {
        return "<= " + number(bound->highest);
    }
    if (std::isinf(bound->highest)) {
        return ">= " + number(bound->lowest);
    }
    return number(bound->lowest) + ".." + number(bound->highest);
}

}  // namespace raks::apps
