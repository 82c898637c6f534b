#include "models/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace raks::models {
namespace {

using Json = nlohmann::ordered_json;

// An array of numbers, texts, true, false or null only: it fits on one line.
bool is_plain_list(const Json& value) {
    return value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& entry) {
               return entry.is_primitive();
           });
}

/// Names that are not UTF-8 (of files, from tables) get replacement characters.
std::string dumped(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Recursive; each level is indented by one space.
void write(const Json& value, int depth, std::string& out) {
    if (value.is_primitive() || is_plain_list(value)) {
        out += dumped(value);
        return;
    }
    const bool is_object = value.is_object();
    const std::string margin(static_cast<std::size_t>(depth) + 1, ' ');
    out += is_object ? '{' : '[';
    const char* separator = "\n";  // of the first entry; the others follow a comma
    for (const auto& [key, entry] : value.items()) {
        out += separator + margin;
        if (is_object) {
            out += dumped(key) + ": ";
        }
        write(entry, depth + 1, out);
        separator = ",\n";
    }
    out += '\n' + margin.substr(1) + (is_object ? '}' : ']');
}

}  // namespace

std::string json_text(const Json& document) {
    std::string out;
    write(document, 0, out);
    return out + "\n";
}

}  // namespace raks::models
