#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace raks {

/// A JSON document that is being written (RFC 8259); the keys of an object keep the order in which
/// they are added. It is no reader.
///
///     Json document = {{"format", "raks-example"}, {"version", 1}};
///     Json& rows = document["rows"] = Json::array();
///     rows.push_back({{"time", 0.5}, {"label", "salsa"}});
///     print(document.text(2));
///
/// A list in braces whose members are all pairs of a text and a value is an object, every other one
/// an array. Threads: one at a time. Real-time: no (allocates).
class Json {
 public:
    Json() noexcept = default;                           ///< null
    Json(std::nullptr_t /*null*/) noexcept {}            // NOLINT(google-explicit-constructor)
    Json(std::string text) : value_(std::move(text)) {}  // NOLINT(google-explicit-constructor)
    Json(std::string_view text)                          // NOLINT(google-explicit-constructor)
        : value_(std::string(text)) {}
    Json(const char* text) : value_(std::string(text)) {}   // NOLINT(google-explicit-constructor)
    Json(std::same_as<bool> auto truth) : value_(truth) {}  // NOLINT(google-explicit-constructor)
    /// Numbers that are not finite become null.
    Json(std::floating_point auto number)  // NOLINT(google-explicit-constructor)
        : value_(static_cast<double>(number)) {}
    Json(std::signed_integral auto number)  // NOLINT(google-explicit-constructor)
        : value_(static_cast<std::int64_t>(number)) {}
    /// Whole numbers without a sign.
    template <std::unsigned_integral Number>
    requires(!std::same_as<Number, bool>)
        Json(Number number)  // NOLINT(google-explicit-constructor)
        : value_(static_cast<std::uint64_t>(number)) {}
    /// An array of what can be a value.
    template <std::ranges::input_range Values>
    requires(!std::convertible_to<Values, std::string_view> &&
             std::constructible_from<Json, std::ranges::range_value_t<Values>>)
        Json(const Values& values)
        : value_(Array()) {  // NOLINT(google-explicit-constructor)
        for (const auto& value : values) {
            push_back(Json(value));
        }
    }
    Json(std::initializer_list<Json> values);  ///< object or array, see above

    /// `values` as an array, whatever they are.
    [[nodiscard]] static Json array(std::initializer_list<Json> values = {});
    /// Without a key.
    [[nodiscard]] static Json object();

    /// The value of a key, null where it is new. Null becomes an object. The reference holds until
    /// the next key is added.
    Json& operator[](std::string_view key);
    /// Adds a value to an array. Null becomes an array.
    void push_back(Json value);
    /// The last value of an array that is not empty. The reference holds until the next
    /// push_back().
    [[nodiscard]] Json& back();
    /// Of an array or object: how many it has; 0 of every other value.
    [[nodiscard]] std::size_t size() const noexcept;

    /// The document as text. `indent`: spaces a level, each value on a line of its own; nothing:
    /// all on one line. Bytes that are no UTF-8 become U+FFFD.
    [[nodiscard]] std::string text(std::optional<int> indent = std::nullopt) const;

 private:
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;

    friend struct JsonText;

    std::variant<std::nullptr_t,
                 bool,
                 std::int64_t,
                 std::uint64_t,
                 double,
                 std::string,
                 Array,
                 Object>
        value_ = nullptr;
};

}  // namespace raks
