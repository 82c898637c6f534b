#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace raks::models {

/// A document as text for people and diffs: one line for each field, lists of plain values on one
/// line; numbers in their shortest form that reads back to the same bits.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document);

}  // namespace raks::models
