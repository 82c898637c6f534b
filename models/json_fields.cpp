#include "models/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace raks::models {
namespace {

constexpr int kDeepest = 32;  // levels of brackets

/// Do brackets (outside strings) nest deeper than kDeepest? Checked before parsing, so that
/// no file makes the parser build a tree of them.
bool is_too_deep(std::string_view text) noexcept {
    int depth = 0;
    bool is_in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        // A backslash escapes the next character, which may be a quote.
        if (is_in_string) {
            i += c == '\\' ? 1U : 0U;
            is_in_string = c != '"';
        } else if (c == '"') {
            is_in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kDeepest) {
                return true;
            }
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return false;
}

// "line 12" of a byte in the text; the parser reports bytes.
std::string place_in(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    return fmt::format("line {}", line);
}

}  // namespace

JsonDocument::JsonDocument()
    : json_(std::make_unique<nlohmann::json>()), fault_(std::make_unique<std::optional<Error>>()) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

Expected<JsonDocument> JsonDocument::parse(std::string_view text,
                                           std::string_view format,
                                           int version) {
    if (is_too_deep(text)) {
        return fail("brackets nest too deep: not a file of Raks");
    }
    JsonDocument document;
    // The parser throws; exceptions end here.
    try {
        *document.json_ = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        return fail(fmt::format("not JSON ({}): cut off or edited by hand? fetch or train it again",
                                place_in(text, error.byte)));
    } catch (const nlohmann::json::exception&) {
        return fail("holds a number that is out of range");
    }
    if (!document.json_->is_object()) {
        return fail(fmt::format("not a {} file", format));
    }
    // Format before version: a version means nothing in another kind of file.
    const Field root = document.root();
    if (!root.has("format") || root["format"].text() != format) {
        return fail(fmt::format("not a {0} file (no \"format\": \"{0}\")", format));
    }
    const int found = root["version"].whole(1, 1'000'000);
    if (auto ok = document.finish(); !ok) {
        return fail(std::move(ok.error()));
    }
    if (found > version) {
        return fail(
            fmt::format("version {} is newer than {}, the newest this program reads; update Raks",
                        found,
                        version));
    }
    return document;
}

// Fields point into the heap, so the document may move while they exist.
JsonDocument::Field JsonDocument::root() { return {json_.get(), "", fault_.get()}; }

Expected<void> JsonDocument::finish() const {
    if (fault_->has_value()) {
        return fail(**fault_);
    }
    return {};
}

// The first fault is the cause; later ones often follow from it.
void JsonDocument::Field::complain(const std::string& what) const {
    if (!fault_->has_value()) {
        *fault_ = Error{fmt::format("{} {}", path_.empty() ? "the file" : path_, what)};
    }
}

// The path grows like an expression: "genres[2].name".
JsonDocument::Field JsonDocument::Field::operator[](std::string_view key) const {
    Field child{
        nullptr, path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key), fault_};
    if (has(key)) {
        child.value_ = &*value_->find(std::string(key));
    } else {
        child.complain("is missing");
    }
    return child;
}

JsonDocument::Field JsonDocument::Field::operator[](std::size_t index) const {
    Field child{nullptr, fmt::format("{}[{}]", path_, index), fault_};
    if (value_ != nullptr && value_->is_array() && index < value_->size()) {
        child.value_ = &(*value_)[index];
    } else {
        child.complain("is missing");
    }
    return child;
}

bool JsonDocument::Field::has(std::string_view key) const {
    return value_ != nullptr && value_->is_object() && value_->contains(std::string(key));
}

// No list: a fault, and no entries, so that loops over it end at once.
std::size_t JsonDocument::Field::size() const {
    if (value_ == nullptr || !value_->is_array()) {
        complain("is not a list");
        return 0;
    }
    return value_->size();
}

double JsonDocument::Field::number() const {
    if (value_ == nullptr || !value_->is_number()) {
        complain("is not a number");
        return 0.0;
    }
    const double number = value_->get<double>();
    if (!std::isfinite(number)) {
        complain("is not finite");
        return 0.0;
    }
    return number;
}

int JsonDocument::Field::whole(int lowest, int highest) const {
    const double found = number();
    if (!(found >= lowest && found <= highest) || found != std::floor(found)) {
        complain(
            fmt::format("is {}, must be a whole number from {} to {}", found, lowest, highest));
        return lowest;
    }
    return static_cast<int>(found);
}

std::string JsonDocument::Field::text() const {
    if (value_ == nullptr || !value_->is_string()) {
        complain("is not a text");
        return {};
    }
    return value_->get<std::string>();
}

std::vector<double> JsonDocument::Field::numbers() const {
    std::vector<double> result(size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const nlohmann::json& entry = (*value_)[i];
        // The slow path only for faults: building a path for each number costs.
        result[i] = entry.is_number() ? entry.get<double>() : (*this)[i].number();
        if (!std::isfinite(result[i])) {
            (*this)[i].complain("is not finite");
        }
    }
    return result;
}

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
