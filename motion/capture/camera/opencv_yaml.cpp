#include "motion/capture/camera/opencv_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/printable.hpp"

namespace raks::capture {

namespace {

using Entries = std::map<std::string, YamlEntry, std::less<>>;

std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t from = std::min(text.find_first_not_of(kBlanks), text.size());
    text.remove_prefix(from);
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// "10.", "1e+02" and "-.5" are numbers; ".Nan" and "nan" are none that is of use.
std::optional<double> finite_number(std::string_view text) noexcept {
    text = trimmed(text);
    double value = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole_text = result.ptr == text.data() + text.size();
    return result.ec == std::errc() && is_whole_text && std::isfinite(value) ? std::optional(value)
                                                                             : std::nullopt;
}

// Splits the text into its keys. Lines that go on (a list in brackets) are joined.
Expected<Entries> split(std::string_view text, const std::string& name) {
    Entries entries;
    YamlEntry* entry = nullptr;
    std::string* open_value = nullptr;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        ++number;
        const std::string_view content = trimmed(line);
        const std::size_t colon = content.find(": ");
        const bool is_heading = content.ends_with(':');
        if (content.empty() || content.front() == '#' || content.front() == '%' ||
            content == "---" || content == "...") {
            continue;
        }
        const bool is_inner = line.front() == ' ' || line.front() == '\t';
        if (colon == std::string_view::npos && !is_heading) {
            if (open_value != nullptr && is_inner) {
                *open_value += ' ';
                *open_value += content;
            }
            continue;
        }
        const std::string key(content.substr(0, is_heading ? content.size() - 1 : colon));
        const std::string_view value =
            is_heading ? std::string_view() : trimmed(content.substr(colon + 1));
        if (!is_inner) {
            const auto [place, is_new] = entries.try_emplace(key);
            if (!is_new) {
                return fail(fmt::format(
                    "{}: line {}: key {} is there twice", name, number, printable(key)));
            }
            entry = &place->second;
            entry->line = number;
            entry->value = value;
            open_value = &entry->value;
        } else if (entry != nullptr) {
            open_value = &entry->inner.try_emplace(key).first->second;
            *open_value = value;
        }
    }
    return entries;
}

std::string_view without_quotes(std::string_view word) noexcept {
    const bool is_quoted = word.size() >= 2 && (word.front() == '"' || word.front() == '\'') &&
                           word.back() == word.front();
    return is_quoted ? word.substr(1, word.size() - 2) : word;
}

}  // namespace

Expected<YamlEntries> YamlEntries::parse(std::string_view text, std::string name) {
    if (text.size() > kLongestYaml) {
        return fail(fmt::format("{}: has {} bytes, more than {}", name, text.size(), kLongestYaml));
    }
    if (!text.starts_with("%YAML")) {
        return fail(fmt::format("{}: line 1: does not begin with %YAML:1.0", name));
    }
    auto entries = split(text, name);
    if (!entries) {
        return fail(std::move(entries.error()));
    }
    YamlEntries read;
    read.entries_ = std::move(*entries);
    read.name_ = std::move(name);
    return read;
}

Expected<const YamlEntry*> YamlEntries::entry(std::string_view key) const {
    const auto found = entries_.find(key);
    if (found == entries_.end()) {
        return fail(fmt::format("{}: has no {}: is it a file of calibrated cameras?", name_, key));
    }
    return &found->second;
}

Expected<int> YamlEntries::picture_size(std::string_view key) const {
    const auto found = entry(key);
    if (!found) {
        return fail(found.error());
    }
    constexpr double kLargest = 65'535.0;
    const std::optional<double> value = finite_number((*found)->value);
    if (!value || *value < 1.0 || *value > kLargest || *value != std::floor(*value)) {
        return fail(complaint(key, "must be a whole number of pixels"));
    }
    return static_cast<int>(*value);
}

Expected<std::vector<double>> YamlEntries::matrix(std::string_view key) const {
    const auto found = entry(key);
    if (!found) {
        return fail(found.error());
    }
    const YamlEntry& matrix = **found;
    const auto inner = [&](std::string_view part) -> std::string_view {
        const auto at = matrix.inner.find(part);
        return at == matrix.inner.end() ? std::string_view() : std::string_view(at->second);
    };
    const std::optional<double> rows = finite_number(inner("rows"));
    const std::optional<double> columns = finite_number(inner("cols"));
    std::string_view data = inner("data");
    if (matrix.value != kYamlMatrixTag || !rows || !columns || !data.starts_with('[') ||
        !data.ends_with(']')) {
        return fail(
            complaint(key, "must be an !!opencv-matrix with rows, cols, dt and data: [ ... ]"));
    }
    data = data.substr(1, data.size() - 2);
    std::vector<double> numbers;
    while (!trimmed(data).empty()) {
        const std::string_view word = data.substr(0, data.find(','));
        data.remove_prefix(std::min(word.size() + 1, data.size()));
        const std::optional<double> number = finite_number(word);
        if (!number) {
            return fail(complaint(
                key, fmt::format("\"{}\" is not a number", printable(trimmed(word), 40))));
        }
        numbers.push_back(*number);
    }
    if (static_cast<double>(numbers.size()) != *rows * *columns) {
        return fail(complaint(
            key, fmt::format("has {} numbers, not {} x {}", numbers.size(), *rows, *columns)));
    }
    return numbers;
}

Expected<std::vector<std::string>> YamlEntries::words(std::string_view key) const {
    const auto found = entry(key);
    if (!found) {
        return fail(found.error());
    }
    std::string_view value = trimmed((*found)->value);
    const bool is_in_brackets = value.starts_with('[') && value.ends_with(']');
    const std::string_view between = is_in_brackets ? "," : "- ";
    if (is_in_brackets) {
        value = value.substr(1, value.size() - 2);
    } else if (value.starts_with("- ")) {
        value.remove_prefix(2);
    } else {
        return fail(complaint(key, "must be a list: one a line behind a dash"));
    }
    std::vector<std::string> words;
    while (!value.empty()) {
        const std::size_t end = std::min(value.find(between), value.size());
        words.emplace_back(without_quotes(trimmed(value.substr(0, end))));
        value.remove_prefix(std::min(end + between.size(), value.size()));
    }
    return words;
}

std::string YamlEntries::complaint(std::string_view key, std::string_view what) const {
    const auto found = entries_.find(key);
    return fmt::format(
        "{}: line {}: {} {}", name_, found == entries_.end() ? 0 : found->second.line, key, what);
}

}  // namespace raks::capture
