#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace raks::models {

/// A document as text that people can read and compare: one line for each field, lists of plain
/// values on one line; numbers in the shortest form that reads back to the same bits.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document);

}  // namespace raks::models
