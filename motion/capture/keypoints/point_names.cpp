#include "motion/capture/keypoints/point_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/suggest.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

namespace raks::capture {
namespace {

// What others call the joints of one side; behind it ours, without the side.
constexpr auto kOtherWords = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"bigtoe", "foot_index"},
     {"toe", "foot_index"},
     {"footindex", "foot_index"},
     {"hand", "wrist"},
     {"eyeinner", "eye_inner"},
     {"eyeouter", "eye_outer"},
     {"shoulder", "shoulder"},
     {"elbow", "elbow"},
     {"wrist", "wrist"},
     {"hip", "hip"},
     {"knee", "knee"},
     {"ankle", "ankle"},
     {"heel", "heel"},
     {"eye", "eye"},
     {"ear", "ear"},
     {"foot", "ankle"},
     {"thumb", "thumb"},
     // "RHJC": the joint centres of laboratories of gait.
     {"hjc", "hip"},
     {"kjc", "knee"},
     {"ajc", "ankle"},
     {"sjc", "shoulder"},
     {"ejc", "elbow"},
     {"wjc", "wrist"}});

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// The words of a name in lower case: split at all that is no letter and before capitals.
std::vector<std::string> words_of_name(std::string_view name) {
    std::vector<std::string> words;
    bool is_new = true;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!is_letter(c)) {
            is_new = true;
            continue;
        }
        const bool is_start = is_capital(c) && i > 0 && !is_capital(name[i - 1]);
        // "LWrist": a capital before a capital and a small letter.
        const bool is_after_letter = is_capital(c) && i > 0 && is_capital(name[i - 1]) &&
                                     i + 1 < name.size() && is_letter(name[i + 1]) &&
                                     !is_capital(name[i + 1]);
        if (is_new || is_start || is_after_letter) {
            words.emplace_back();
        }
        is_new = false;
        words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return words;
}

}  // namespace

Expected<PointNameMap> read_point_names(std::string_view text, const std::string& file) {
    motion::TableRows rows(motion::without_byte_order_mark(text), '\t');
    motion::TableRow row;
    PointNameMap map;
    while (rows.next(row)) {
        const auto fault = [&](const std::string& what) {
            return fail(fmt::format("{}: line {}: {}", file, row.number, what));
        };
        if (row.cells.front().starts_with('#')) {
            continue;
        }
        if (row.cells.size() != 2) {
            return fault("must be a name, a tab and the joint that it means");
        }
        const auto point = body_point_named(row.cells[1]);
        if (!point) {
            return fault(unknown_name("joint", row.cells[1], body_point_names()));
        }
        const bool is_twice = std::any_of(map.begin(), map.end(), [&](const auto& entry) {
            return entry.first == row.cells[0] || entry.second == *point;
        });
        if (is_twice) {
            return fault("its name or its joint was there before");
        }
        map.emplace_back(row.cells[0], *point);
    }
    return map;
}

std::optional<BodyPoint> body_point_meant(std::string_view name, const PointNameMap& map) {
    for (const auto& [theirs, point] : map) {
        if (theirs == name) {
            return point;
        }
    }
    if (const auto point = body_point_named(name)) {
        return point;
    }
    std::string side;
    std::string rest;
    for (const std::string& word : words_of_name(name)) {
        if (word == "l" || word == "left") {
            side = "left";
        } else if (word == "r" || word == "right") {
            side = "right";
        } else {
            rest += word;
        }
    }
    if (rest == "nose") {
        return BodyPoint::nose;
    }
    // "RHJC" and "lwrist": the side is the first letter of the only word.
    if (side.empty() && (rest.starts_with('l') || rest.starts_with('r'))) {
        side = rest.front() == 'l' ? "left" : "right";
        rest.erase(0, 1);
    }
    const auto found = std::find_if(kOtherWords.begin(), kOtherWords.end(), [&](const auto& word) {
        return word.first == rest;
    });
    if (side.empty() || found == kOtherWords.end()) {
        return std::nullopt;
    }
    return body_point_named(fmt::format("{}_{}", side, found->second));
}

}  // namespace raks::capture
