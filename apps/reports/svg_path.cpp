#include "apps/reports/svg_path.hpp"

#include <iterator>

#include <fmt/format.h>

namespace raks::apps {

void SvgPath::to(double x, double y) {
    fmt::format_to(std::back_inserter(data_), "{}{:.1f} {:.1f}", is_drawing_ ? 'L' : 'M', x, y);
    is_drawing_ = true;
}

void SvgPath::close() {
    data_ += is_drawing_ ? "Z" : "";
    is_drawing_ = false;
}

}  // namespace raks::apps
