#include "base/json.hpp"

#include <algorithm>
#include <type_traits>

#include <nlohmann/json.hpp>

namespace raks {

/// What nlohmann's library, which writes the text, makes of a value.
struct JsonText {
    using Other = nlohmann::ordered_json;

    static Other of(const Json& json) {
        return std::visit(
            [](const auto& value) -> Other {
                using Value = std::decay_t<decltype(value)>;
                if constexpr (std::is_same_v<Value, Json::Array>) {
                    Other array = Other::array();
                    for (const Json& member : value) {
                        array.push_back(of(member));
                    }
                    return array;
                } else if constexpr (std::is_same_v<Value, Json::Object>) {
                    Other object = Other::object();
                    for (const auto& [key, member] : value) {
                        object[key] = of(member);
                    }
                    return object;
                } else {
                    return Other(value);
                }
            },
            json.value_);
    }

    // "key" and its value in braces.
    static bool is_member(const Json& json) {
        const auto* const pair = std::get_if<Json::Array>(&json.value_);
        return pair != nullptr && pair->size() == 2 &&
               std::holds_alternative<std::string>(pair->front().value_);
    }
};

Json::Json(std::initializer_list<Json> values) {
    if (!std::all_of(values.begin(), values.end(), JsonText::is_member)) {
        value_ = Array(values);
        return;
    }
    Object members;
    for (const Json& value : values) {
        const auto& pair = std::get<Array>(value.value_);
        members.emplace_back(std::get<std::string>(pair[0].value_), pair[1]);
    }
    value_ = std::move(members);
}

Json Json::array(std::initializer_list<Json> values) {
    Json json;
    json.value_ = Array(values);
    return json;
}

Json Json::object() {
    Json json;
    json.value_ = Object();
    return json;
}

Json& Json::operator[](std::string_view key) {
    if (std::holds_alternative<std::nullptr_t>(value_)) {
        value_ = Object();
    }
    auto& members = std::get<Object>(value_);
    const auto known = std::find_if(
        members.begin(), members.end(), [key](const auto& member) { return member.first == key; });
    return known != members.end() ? known->second
                                  : members.emplace_back(std::string(key), Json()).second;
}

void Json::push_back(Json value) {
    if (std::holds_alternative<std::nullptr_t>(value_)) {
        value_ = Array();
    }
    std::get<Array>(value_).push_back(std::move(value));
}

Json& Json::back() { return std::get<Array>(value_).back(); }

std::size_t Json::size() const noexcept {
    if (const auto* const array = std::get_if<Array>(&value_)) {
        return array->size();
    }
    const auto* const object = std::get_if<Object>(&value_);
    return object != nullptr ? object->size() : 0;
}

std::string Json::text(std::optional<int> indent) const {
    return JsonText::of(*this).dump(
        indent.value_or(-1), ' ', false, JsonText::Other::error_handler_t::replace);
}

}  // namespace raks
