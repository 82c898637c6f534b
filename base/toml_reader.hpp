#pragma once

#include "base/toml_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"

/// Reads TOML and reports the first fault as one clear line. Include it in source files only,
/// because it brings in toml++. Parsing itself is parse_toml, below.
namespace raks {

/// Limits of a number, both included.
struct NumberRange {
    double lowest;   ///< least
    double highest;  ///< greatest
};
/// Remembers the first fault and its place. Reading continues after a fault with harmless values.
class TomlComplaints {
 public:
    /// `file`: its name, for messages.
    explicit TomlComplaints(std::string file) : file_(std::move(file)) {}

    /// Sets what is being read, for messages: "figure \"box\"". Empty: the file itself.
    void enter(std::string context) { context_ = std::move(context); }

    /// Notes a fault at the line of a node; only the first one is kept.
    void complain(const toml::node& node, const std::string& message) {
        complain(node.source().begin.line, message);
    }
    /// Notes a fault at a line, from 1.
    void complain(std::size_t line, const std::string& message) {
        if (!fault_) {
            fault_ = Error{fmt::format("{}: line {}: {}{}{}",
                                       file_,
                                       line,
                                       printable(context_),
                                       context_.empty() ? "" : ": ",
                                       printable(message))};
        }
    }
    /// Notes a fault of the whole file.
    void complain(const std::string& message) {
        if (!fault_) {
            fault_ = Error{file_ + ": " + printable(message)};
        }
    }

    /// Complains of keys that are not among `known`, with the nearest known one.
    void check_keys(const toml::table& table, std::span<const std::string_view> known) {
        for (const auto& [key, value] : table) {
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
                complain(value, unknown_name("key", key.str(), known));
            }
        }
    }

    /// Complains where a file's `format` is another, or its `version` none from 1 to `newest`: a
    /// newer one may mean things that this program would misread.
    void check_head(const toml::table& root, std::string_view format, std::int64_t newest) {
        if (root["format"].value<std::string>() != std::string(format)) {
            complain(fmt::format("format must be \"{}\"", format));
        }
        const auto version = root["version"].value_exact<std::int64_t>();
        if (!version || *version < 1 || *version > newest) {
            complain(fmt::format("version must be a number up to {}; is Raks older than the file?",
                                 newest));
        }
    }

    /// A finite number within `range`; 0 after a complaint. `name`: the key, for messages.
    double number(const toml::node& node, std::string_view name, NumberRange range) {
        const std::optional<double> value =
            node.is_number() ? node.value<double>() : std::optional<double>();
        if (!value) {
            complain(node, fmt::format("{} must be a number", name));
            return 0.0;
        }
        if (!(*value >= range.lowest && *value <= range.highest)) {
            complain(node,
                     fmt::format(
                         "{} is {}, must be {} to {}", name, *value, range.lowest, range.highest));
            return 0.0;
        }
        return *value;
    }

    /// A whole number in a range; 0 after a complaint.
    int whole(const toml::node& node, std::string_view name, NumberRange range) {
        const double value = number(node, name, range);
        if (value != std::floor(value)) {
            complain(node, fmt::format("{} is {}, must be a whole number", name, value));
            return 0;
        }
        return static_cast<int>(value);
    }

    /// Index of a text in `known`; 0 after a complaint. `name`: the kind of thing, for messages.
    std::size_t word(const toml::node& node,
                     std::string_view name,
                     std::span<const std::string_view> known) {
        const std::optional<std::string> value = node.value_exact<std::string>();
        const auto found = value ? std::find(known.begin(), known.end(), *value) : known.end();
        if (found == known.end()) {
            complain(node,
                     value ? unknown_name(name, *value, known)
                           : fmt::format("{} must be a text in quotes", name));
            return 0;
        }
        return static_cast<std::size_t>(found - known.begin());
    }

    /// The value of a key that must exist; null after a complaint. `form`: "tempo = [...]", for
    /// messages.
    const toml::node* needed(const toml::table& table,
                             std::string_view key,
                             std::string_view form) {
        const toml::node* const node = table.get(key);
        if (node == nullptr) {
            complain(table, fmt::format("needs {}", form));
        }
        return node;
    }

    /// Sets `target` to the number under the key, if there is one.
    template <typename Number>
    void read(const toml::table& table, std::string_view key, NumberRange range, Number& target) {
        if (const toml::node* const node = table.get(key)) {
            target = number(*node, key, range);
        }
    }

    /// The numbers of an array of a fixed length; zeros after a complaint.
    template <std::size_t Count>
    std::array<double, Count> numbers(const toml::node& node,
                                      std::string_view name,
                                      NumberRange range,
                                      std::string_view form) {
        std::array<double, Count> values{};
        const toml::array* const array = node.as_array();
        if (array == nullptr || array->size() != Count) {
            complain(node, fmt::format("{} must be {}", name, form));
            return values;
        }
        for (std::size_t i = 0; i < Count; ++i) {
            values[i] = number((*array)[i], name, range);
        }
        return values;
    }

    /// The text under a key; empty where there is none, and after a complaint.
    std::string text(const toml::table& table, std::string_view key) {
        const toml::node* const node = table.get(key);
        if (node == nullptr) {
            return {};
        }
        if (!node->is_string()) {
            complain(*node, fmt::format("{} must be a text in quotes", key));
        }
        return node->value_or(std::string());
    }

    [[nodiscard]] bool is_sound() const noexcept { return !fault_; }  ///< no fault so far
    [[nodiscard]] const Error& fault() const { return *fault_; }      ///< only where !is_sound()

 private:
    std::string file_;
    std::string context_;
    std::optional<Error> fault_;
};

inline constexpr std::size_t kLongestToml = std::size_t{1} << 20U;   ///< bytes: 1 MiB
inline constexpr std::size_t kMostKeyParts = 16;                     ///< "a.b.c" has 3
inline constexpr std::size_t kDeepestToml = TOML_MAX_NESTED_VALUES;  ///< arrays and tables within

/// Parses a TOML document: the only way into the TOML library, so that no text can end the program.
/// `name`: the file's, for messages. Errors, as `NAME: line 2, column 5: ...`: a fault of the
/// syntax, more than kMostKeyParts in a dotted key, values nested deeper than kDeepestToml; and
/// more than kLongestToml bytes. Throws nothing but std::bad_alloc. Threads: any. Real-time: no.
[[nodiscard]] Expected<toml::table> parse_toml(std::string_view text, const std::string& name);

/// A text as a value of a TOML document, in quotes. `text`: UTF-8.
[[nodiscard]] std::string toml_quoted(std::string_view text);

}  // namespace raks
