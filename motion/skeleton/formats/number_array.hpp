// Number array: an array of numbers by its shape, as NumPy and JSON files hold them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace raks::motion {

/// Numbers by their shape.
struct NumberArray {
    std::vector<std::size_t> shape;  ///< empty: a single number
    std::vector<double> values;      ///< row-major, as many as the shape says; may be NaN
};

/// Arrays by their names in a file.
using NumberArrays = std::map<std::string, NumberArray>;

/// The shape as Python writes it: "(120, 72)", "(3,)", "()".
[[nodiscard]] std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace raks::motion
