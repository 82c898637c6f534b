#include "base/dance_list.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/assert.hpp"
#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks {
namespace {

constexpr std::size_t kLongestName = 40;  // bytes
// Words that options or reports use for something other than a dance, and "dances": a dance's
// grammar lies in NAME.toml, where a folder has its list of dances in dances.toml.
constexpr std::array<std::string_view, 7> kTakenNames = {
    "auto", "keep", "stand", "unknown", "other", "none", "dances"};

// ASCII only, because names become parts of file names on any system.
bool is_letter_or_digit(char c) noexcept {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool is_taken(std::string_view name) noexcept {
    return std::find(kTakenNames.begin(), kTakenNames.end(), name) != kTakenNames.end();
}

}  // namespace

bool is_dance_name(std::string_view name) noexcept {
    return !name.empty() && name.size() <= kLongestName && is_letter_or_digit(name.front()) &&
           std::all_of(name.begin(),
                       name.end(),
                       [](char c) { return is_letter_or_digit(c) || c == '-' || c == '_'; }) &&
           !is_taken(name);
}

// The name may come from a file: it is made printable before it is shown.
std::string why_no_dance_name(std::string_view name) {
    const std::string shown = printable(name, kLongestName);
    if (is_taken(name)) {
        return fmt::format("\"{}\" cannot name a dance: it means something else here", shown);
    }
    return fmt::format(
        "\"{}\" cannot name a dance: letters a-z, digits, '-' and '_', 1 to {} of them",
        shown,
        kLongestName);
}

std::string made_dance_name(std::string_view text) {
    std::string name;
    for (const char c : text) {
        const bool is_kept = is_letter_or_digit(c) || c == '-';
        if (is_kept ? !(c == '-' && name.empty()) : !name.empty() && name.back() != '_') {
            name += is_kept ? c : '_';
        }
    }
    name.resize(std::min(name.size(), kLongestName));
    while (!name.empty() && !is_letter_or_digit(name.back())) {
        name.pop_back();
    }
    if (name.empty()) {
        return "dance";
    }
    return is_taken(name) ? "dance_" + name : name;
}

DanceList::DanceList(std::vector<DanceInfo> dances) : dances_(std::move(dances)) {
    RAKS_ASSERT(dances_.size() <= kMostDances);
}

// A linear search: lists are short, and nothing real-time asks by name.
DanceId DanceList::id_of(std::string_view name) const noexcept {
    const auto found = std::find_if(
        dances_.begin(), dances_.end(), [name](const DanceInfo& d) { return d.name == name; });
    return found == dances_.end() ? DanceId::none : static_cast<DanceId>(found - dances_.begin());
}

std::string_view DanceList::name_of(DanceId id) const noexcept {
    const DanceInfo* const dance = find(id);
    return dance != nullptr ? std::string_view(dance->name) : "unknown";
}

std::string_view DanceList::title_of(DanceId id) const noexcept {
    const DanceInfo* const dance = find(id);
    return dance != nullptr ? std::string_view(dance->title) : std::string_view();
}

std::vector<std::string_view> DanceList::names() const {
    std::vector<std::string_view> names;
    for (const DanceInfo& dance : dances_) {
        names.emplace_back(dance.name);
    }
    return names;
}

}  // namespace raks
