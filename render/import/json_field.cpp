#include "render/import/json_field.hpp"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/printable.hpp"

namespace raks::render {
namespace {

namespace dom = simdjson::dom;

constexpr std::size_t kDeepestJson = 64;
/// So many paths are remembered, 100 MB; of what is read later, the path of the whole is told.
constexpr std::size_t kMostSteps = 4'000'000;
/// Above so many keys, those that stand twice are found by sorting.
constexpr std::size_t kFewKeys = 16;

/// What a dom::element is made of: a document and a place on its tape. Keeps simdjson's 30,000
/// lines out of the header.
struct Place {
    const void* document;
    std::size_t index;
};
static_assert(sizeof(dom::element) == sizeof(Place) && std::is_trivially_copyable_v<dom::element>);

dom::element element_of(const void* document, std::size_t place) {
    return std::bit_cast<dom::element>(Place{document, place});
}

Place place_of(dom::element element) { return std::bit_cast<Place>(element); }

bool has_key_twice(const dom::object& object, std::vector<std::string_view>& keys) {
    keys.clear();
    for (const auto field : object) {
        keys.push_back(field.key);
    }
    if (keys.size() > kFewKeys) {
        std::sort(keys.begin(), keys.end());
        return std::adjacent_find(keys.begin(), keys.end()) != keys.end();
    }
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (std::find(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(i), keys[i]) !=
            keys.begin() + static_cast<std::ptrdiff_t>(i)) {
            return true;
        }
    }
    return false;
}

/// Whether an object in `element`, at most kDeepestJson deep, has a key twice.
bool has_keys_twice(dom::element element, std::vector<std::string_view>& keys) {
    if (dom::object object; element.get(object) == simdjson::SUCCESS) {
        if (has_key_twice(object, keys)) {
            return true;
        }
        for (const auto field : object) {
            if (has_keys_twice(field.value, keys)) {
                return true;
            }
        }
    } else if (dom::array array; element.get(array) == simdjson::SUCCESS) {
        for (const dom::element item : array) {
            if (has_keys_twice(item, keys)) {
                return true;
            }
        }
    }
    return false;
}

std::string_view kind_of(dom::element element) {
    switch (element.type()) {
        case dom::element_type::ARRAY:
            return "a list";
        case dom::element_type::OBJECT:
            return "an object";
        case dom::element_type::STRING:
            return "a text";
        case dom::element_type::BOOL:
            return "true or false";
        case dom::element_type::NULL_VALUE:
            return "null";
        default:
            return "a number";
    }
}

}  // namespace

// ---- JsonFaults

Expected<void> JsonFaults::finish() const {
    if (first_) {
        return fail(*first_);
    }
    return {};
}

void JsonFaults::add(const std::string& line) {
    if (!first_) {
        first_ = Error{printable(line)};
    }
}

std::uint32_t JsonFaults::step(const Step& step) {
    if (steps_.size() >= kMostSteps) {
        return step.parent;
    }
    steps_.push_back(step);
    return static_cast<std::uint32_t>(steps_.size() - 1);
}

std::string JsonFaults::path(std::uint32_t step) const {
    std::string path;
    for (; step != 0; step = steps_[step].parent) {
        const Step& here = steps_[step];
        path = here.key.data() == nullptr
                   ? fmt::format("[{}]{}", here.index, path)
                   : fmt::format("{}{}{}", here.parent == 0 ? "" : ".", here.key, path);
    }
    return path;
}

// ---- JsonField

JsonField JsonField::operator[](std::string_view key) const {
    dom::object object;
    if (exists() && element_of(document_, place_).get(object) == simdjson::SUCCESS) {
        for (const auto field : object) {
            if (field.key == key) {
                const Place place = place_of(field.value);
                // The document's own key: it lives as long as the path may be asked for.
                return {place.document,
                        place.index,
                        *faults_,
                        faults_->step({.parent = step_, .index = 0, .key = field.key})};
            }
        }
    }
    return {nullptr, 0, *faults_, faults_->step({.parent = step_, .index = 0, .key = key})};
}

JsonField JsonField::noting_to(JsonFaults& faults, std::string_view prefix) const {
    std::uint32_t step = 0;
    if (!prefix.empty()) {
        step = faults.step({.parent = 0, .index = 0, .key = faults.prefixes_.emplace_back(prefix)});
    }
    return {document_, place_, faults, step};
}

bool JsonField::is_object() const { return exists() && element_of(document_, place_).is_object(); }

bool JsonField::is_array() const { return exists() && element_of(document_, place_).is_array(); }

bool JsonField::is_text() const { return exists() && element_of(document_, place_).is_string(); }

bool JsonField::is_number() const { return exists() && element_of(document_, place_).is_number(); }

std::vector<JsonField> JsonField::items(std::size_t most) const {
    std::vector<JsonField> items;
    if (!exists()) {
        return items;
    }
    dom::array array;
    if (element_of(document_, place_).get(array) != simdjson::SUCCESS) {
        complain_of_kind("a list");
        return items;
    }
    std::uint32_t index = 0;
    for (const dom::element item : array) {
        if (index == most) {
            complain(fmt::format("has more than {} entries", most));
            return {};
        }
        const std::uint32_t step = faults_->step({.parent = step_, .index = index++, .key = {}});
        const Place place = place_of(item);
        items.push_back({place.document, place.index, *faults_, step});
    }
    return items;
}

std::vector<JsonField> JsonField::objects(std::size_t most) const {
    std::vector<JsonField> all = items(most);
    for (const JsonField& item : all) {
        if (!item.is_object()) {
            item.complain_of_kind("an object");
        }
    }
    return all;
}

std::vector<std::pair<std::string_view, JsonField>> JsonField::entries() const {
    std::vector<std::pair<std::string_view, JsonField>> entries;
    if (!exists()) {
        return entries;
    }
    dom::object object;
    if (element_of(document_, place_).get(object) != simdjson::SUCCESS) {
        complain_of_kind("an object");
        return entries;
    }
    for (const auto field : object) {
        const std::uint32_t step = faults_->step({.parent = step_, .index = 0, .key = field.key});
        const Place place = place_of(field.value);
        entries.emplace_back(field.key, JsonField{place.document, place.index, *faults_, step});
    }
    return entries;
}

std::size_t JsonField::size() const {
    if (!exists()) {
        return 0;
    }
    const dom::element element = element_of(document_, place_);
    // simdjson's own size() ends at 0xFFFFFF.
    std::size_t size = 0;
    if (dom::array array; element.get(array) == simdjson::SUCCESS) {
        for ([[maybe_unused]] const dom::element item : array) {
            ++size;
        }
    } else if (dom::object object; element.get(object) == simdjson::SUCCESS) {
        for ([[maybe_unused]] const auto field : object) {
            ++size;
        }
    }
    return size;
}

std::string_view JsonField::text() const {
    std::string_view text;
    if (!exists() || element_of(document_, place_).get(text) != simdjson::SUCCESS) {
        complain_of_kind("a text");
    }
    return text;
}

std::string_view JsonField::text_or(std::string_view otherwise) const {
    return exists() ? text() : otherwise;
}

bool JsonField::truth_or(bool otherwise) const {
    bool truth = otherwise;
    if (exists() && element_of(document_, place_).get(truth) != simdjson::SUCCESS) {
        complain_of_kind("true or false");
    }
    return truth;
}

float JsonField::number(float lowest, float highest) const {
    double number = 0.0;
    if (!exists() || element_of(document_, place_).get(number) != simdjson::SUCCESS) {
        complain_of_kind("a number");
        return 0.0F;
    }
    if (!(number >= static_cast<double>(lowest) && number <= static_cast<double>(highest))) {
        complain(fmt::format("{} is not in {} .. {}", number, lowest, highest));
        return 0.0F;
    }
    return static_cast<float>(number);
}

float JsonField::number_or(float otherwise, float lowest, float highest) const {
    return exists() ? number(lowest, highest) : otherwise;
}

std::int64_t JsonField::whole(std::int64_t lowest, std::int64_t highest) const {
    std::int64_t number = 0;
    double broken = 0.0;
    if (!exists()) {
        complain_of_kind("a number");
        return 0;
    }
    const dom::element element = element_of(document_, place_);
    if (element.get(number) != simdjson::SUCCESS) {
        if (element.get(broken) != simdjson::SUCCESS) {
            complain_of_kind("a number");
            return 0;
        }
        constexpr double kExact = 9007199254740992.0;  // 2^53
        if (broken != std::floor(broken) || std::abs(broken) > kExact) {
            complain(fmt::format("{} is not a whole number", broken));
            return 0;
        }
        number = static_cast<std::int64_t>(broken);
    }
    if (number < lowest || number > highest) {
        complain(highest == std::numeric_limits<std::int64_t>::max()
                     ? fmt::format("{} is less than {}", number, lowest)
                     : fmt::format("{} is not in {} .. {}", number, lowest, highest));
        return 0;
    }
    return number;
}

std::int64_t JsonField::whole_or(std::int64_t otherwise,
                                 std::int64_t lowest,
                                 std::int64_t highest) const {
    return exists() ? whole(lowest, highest) : otherwise;
}

int JsonField::index(std::size_t count) const {
    const std::int64_t number =
        whole(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
    if (number < 0 || static_cast<std::uint64_t>(number) >= count) {
        complain(fmt::format("{} does not exist: there are {}, counted from 0", number, count));
        return 0;
    }
    return static_cast<int>(number);
}

int JsonField::index_or_none(std::size_t count) const { return exists() ? index(count) : -1; }

std::vector<float> JsonField::numbers(std::size_t most) const {
    std::vector<float> numbers;
    const std::size_t count = size();
    if (!exists()) {
        return numbers;
    }
    if (!is_array() || count > most) {
        complain(is_array() ? fmt::format("has {} numbers, more than {}", count, most)
                            : "is not a list of numbers");
        return numbers;
    }
    numbers.resize(count);
    read_exactly(numbers.data(), count);
    return numbers;
}

void JsonField::read_exactly(float* out, std::size_t count) const {
    dom::array array;
    if (element_of(document_, place_).get(array) != simdjson::SUCCESS || size() != count) {
        complain(fmt::format("is not a list of {} numbers", count));
        return;
    }
    std::vector<float> numbers;
    numbers.reserve(count);
    for (const dom::element item : array) {
        double number = 0.0;
        if (item.get(number) != simdjson::SUCCESS) {
            complain(fmt::format("[{}] is not a number", numbers.size()));
            return;
        }
        if (std::abs(number) > static_cast<double>(std::numeric_limits<float>::max())) {
            complain(fmt::format("[{}] is {}, too large", numbers.size(), number));
            return;
        }
        numbers.push_back(static_cast<float>(number));
    }
    std::copy(numbers.begin(), numbers.end(), out);
}

std::size_t JsonField::choice_or(std::size_t otherwise,
                                 std::initializer_list<std::string_view> words) const {
    if (!exists()) {
        return otherwise;
    }
    const std::string_view word = text();
    const auto* const found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        complain(fmt::format("\"{}\" is not one of {}", word, fmt::join(words, ", ")));
        return 0;
    }
    return static_cast<std::size_t>(found - words.begin());
}

std::string JsonField::path() const { return faults_->path(step_); }

void JsonField::complain(const std::string& what) const {
    if (!faults_->any()) {
        faults_->add(line(what));
    }
}

std::string JsonField::line(std::string_view what) const {
    const std::string place = printable(path(), 200);
    return place.empty() ? printable(what) : fmt::format("{}: {}", place, printable(what));
}

void JsonField::complain_of_kind(std::string_view wanted) const {
    complain(exists() ? fmt::format("is {}, not {}", kind_of(element_of(document_, place_)), wanted)
                      : "is missing");
}

// ---- JsonDocument

struct JsonDocument::Parsed {
    dom::parser parser;
    dom::element root;
};

JsonDocument::JsonDocument(std::unique_ptr<Parsed> parsed) : parsed_(std::move(parsed)) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

Expected<JsonDocument> JsonDocument::parse(std::string_view text) {
    auto parsed = std::make_unique<Parsed>();
    if (parsed->parser.allocate(text.size(), kDeepestJson) != simdjson::SUCCESS) {
        return fail("holds too much JSON");
    }
    const auto error = parsed->parser.parse(text.data(), text.size()).get(parsed->root);
    if (error == simdjson::DEPTH_ERROR) {
        return fail(fmt::format("has JSON that is nested deeper than {} levels", kDeepestJson));
    }
    if (error != simdjson::SUCCESS) {
        return fail(fmt::format("is not JSON: {}", simdjson::error_message(error)));
    }
    if (!parsed->root.is_object()) {
        return fail("is not an object of JSON");
    }
    if (std::vector<std::string_view> keys; has_keys_twice(parsed->root, keys)) {
        return fail("has a key twice in one object");
    }
    return JsonDocument(std::move(parsed));
}

JsonField JsonDocument::root(JsonFaults& faults) const {
    const Place place = place_of(parsed_->root);
    return {place.document, place.index, faults, 0};
}

}  // namespace raks::render
