#pragma once

#include <nlohmann/json_fwd.hpp>

#include "models/gaussian_hmm.hpp"
#include "models/json_fields.hpp"

/// A Gaussian HMM as part of a JSON document.
namespace raks::models {

/// The fields of a model as a JSON object, without format and version.
[[nodiscard]] nlohmann::ordered_json hmm_json(const GaussianHmm& model);

/// Reads those fields; faults are noted in the document. Call validate() on the result: sizes may
/// disagree.
[[nodiscard]] GaussianHmm read_hmm(const JsonDocument::Field& fields);

}  // namespace raks::models
