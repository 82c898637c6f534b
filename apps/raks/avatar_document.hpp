#pragma once

#include <string>
#include "base/json.hpp"

#include "render/model/model.hpp"

namespace raks::apps {

/// What is in a model, for programs: "raks-avatar", version 1. Counts and measures, the humanoid,
/// materials, the licence, warnings. `file`: as it was named.
[[nodiscard]] Json avatar_document(const render::Model& model, const std::string& file);

/// The same for people.
[[nodiscard]] std::string avatar_text(const render::Model& model, const std::string& file);

}  // namespace raks::apps
