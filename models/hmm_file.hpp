#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "models/gaussian_hmm.hpp"

namespace raks::models {

/// Format name and version of a file with one model.
inline constexpr std::string_view kHmmFormat = "raks-hmm";
inline constexpr int kHmmVersion = 1;

/// JSON text of a model; numbers in their shortest form that reads back to the same bits.
[[nodiscard]] std::string hmm_text(const GaussianHmm& model);

/// Reads and validates. The error is one line that names the field; the caller adds the file.
[[nodiscard]] Expected<GaussianHmm> parse_hmm(std::string_view text);

/// The same from and to a file (at most 64 MiB). Threads: workers. Real-time: no.
[[nodiscard]] Expected<GaussianHmm> load_hmm(const std::filesystem::path& path);
[[nodiscard]] Expected<void> save_hmm(const GaussianHmm& model, const std::filesystem::path& path);

}  // namespace raks::models
