#pragma once

#include <nlohmann/json_fwd.hpp>

#include "models/gaussian_hmm.hpp"
#include "models/json_fields.hpp"

/// A model as part of another document.
namespace raks::models {

/// The fields of a model, without format and version.
[[nodiscard]] nlohmann::ordered_json hmm_json(const GaussianHmm& model);

/// Reads those fields; faults are the document's. Validate what comes back: sizes may disagree.
[[nodiscard]] GaussianHmm read_hmm(const JsonDocument::Field& fields);

}  // namespace raks::models
