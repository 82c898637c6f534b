#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

/// How much a test tries, where all of it takes too long for every run: the environment says so.
namespace raks::test {

/// Whether the environment variable is "whole".
inline bool is_whole(const char* variable) {
    const char* const text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): never set
    return text != nullptr && std::string_view(text) == "whole";
}

/// The number that the environment variable holds; none: it is not set.
inline std::optional<std::int64_t> number_from(const char* variable) {
    const char* const text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): never set
    return text == nullptr ? std::nullopt : std::optional<std::int64_t>(std::atoll(text));
}

}  // namespace raks::test
