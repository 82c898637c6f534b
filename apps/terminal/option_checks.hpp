#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

/// Checks for the values of options.
namespace raks::apps {

/// Accepts numbers in [lowest, highest] and, unlike CLI::Range, refuses NaN (which is neither below
/// nor above). The fault: `--bpm: "nan" is no number from 50 to 230`.
template <typename Number>
[[nodiscard]] CLI::Validator in_range(Number lowest, Number highest) {
    CLI::Validator validator;
    validator.description(fmt::format("{}..{}", lowest, highest));
    validator.operation([lowest, highest](std::string& word) {
        Number number{};
        if (CLI::detail::lexical_cast(word, number) && number >= lowest && number <= highest) {
            return std::string();
        }
        return fmt::format("\"{}\" is no{} number from {} to {}",
                           printable(word, 40),
                           std::is_integral_v<Number> ? " whole" : "",
                           lowest,
                           highest);
    });
    return validator;
}

/// Accepts one of these names (of static storage). The fault suggests the nearest: `--role: "folow"
/// is unknown; did you mean "follow"?`
[[nodiscard]] inline CLI::Validator one_of(std::vector<std::string_view> names) {
    CLI::Validator validator;
    validator.description(fmt::format("{}", fmt::join(names, "|")));
    validator.operation([names](std::string& word) {
        const bool is_known = std::find(names.begin(), names.end(), word) != names.end();
        return is_known ? std::string() : unknown_name("", printable(word, 40), names).substr(1);
    });
    return validator;
}

/// Adds an option whose value is one of `names` (of static storage), where names[i] is the
/// enumerator of value i.
template <typename Enum, std::size_t Count>
CLI::Option* add_named_option(CLI::App& app,
                              const char* option,
                              Enum& value,
                              const std::array<std::string_view, Count>& names,
                              const char* help) {
    return app
        .add_option_function<std::string>(
            option,
            [&value, &names](const std::string& word) {
                value =
                    static_cast<Enum>(std::find(names.begin(), names.end(), word) - names.begin());
            },
            help)
        ->check(one_of({names.begin(), names.end()}));
}

}  // namespace raks::apps
