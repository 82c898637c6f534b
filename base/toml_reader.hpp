#pragma once

#include <toml++/toml.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "base/suggest.hpp"

/// Reading TOML with one clear line for the first fault. For source files alone: it brings in
/// toml++.
namespace raks {

struct NumberRange {
    double lowest;
    double highest;
};
/// Remembers the first fault and where it was; reading goes on harmlessly after it.
class TomlComplaints {
 public:
    explicit TomlComplaints(std::string file) : file_(std::move(file)) {}

    /// What is being read: "figure \"box\"". Empty: the file.
    void enter(std::string context) { context_ = std::move(context); }

    void complain(const toml::node& node, const std::string& message) {
        complain(node.source().begin.line, message);
    }
    void complain(std::size_t line, const std::string& message) {
        if (!fault_) {
            fault_ = Error{fmt::format("{}: line {}: {}{}{}",
                                       file_,
                                       line,
                                       context_,
                                       context_.empty() ? "" : ": ",
                                       message)};
        }
    }
    void complain(const std::string& message) {
        if (!fault_) {
            fault_ = Error{file_ + ": " + message};
        }
    }

    void check_keys(const toml::table& table, std::span<const std::string_view> known) {
        for (const auto& [key, value] : table) {
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
                complain(value, unknown_name("key", key.str(), known));
            }
        }
    }

    /// A finite number in a range; 0 after a complaint.
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

    /// The place of a text in `known`; 0 after a complaint. `name`: the kind of thing.
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

    /// What is under a key that must be there; null after a complaint. `form`: "tempo = [...]".
    const toml::node* needed(const toml::table& table,
                             std::string_view key,
                             std::string_view form) {
        const toml::node* const node = table.get(key);
        if (node == nullptr) {
            complain(table, fmt::format("needs {}", form));
        }
        return node;
    }

    /// Sets `target` when the key is there.
    template <typename Number>
    void read(const toml::table& table, std::string_view key, NumberRange range, Number& target) {
        if (const toml::node* const node = table.get(key)) {
            target = number(*node, key, range);
        }
    }

    /// Numbers of an array of a fixed length; zeros after a complaint.
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

    [[nodiscard]] bool is_sound() const noexcept { return !fault_; }
    [[nodiscard]] const Error& fault() const { return *fault_; }

 private:
    std::string file_;
    std::string context_;
    std::optional<Error> fault_;
};

}  // namespace raks
