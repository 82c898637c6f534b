#include "audio/genre/tag_evidence.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "audio/genre/genre_model.hpp"

namespace raks::audio {
namespace {

// Nobody reads a longer tag; a damaged file may have one.
constexpr std::size_t kMostTextBytes = 4096;

using Place = GenreWords::Place;

// A genre in numbers: "17", as ID3 counts them.
bool is_number(const std::vector<std::string>& part) {
    constexpr std::size_t kMostDigits = 3;
    return part.size() == 1 && part.front().size() <= kMostDigits &&
           std::all_of(part.front().begin(), part.front().end(), [](char c) {
               return c >= '0' && c <= '9';
           });
}

// Rows of the table that a text holds, from its start to its end.
void find_rows(Place place,
               std::string_view text,
               const GenreWords& table,
               std::vector<GenreWords::Found>& rows) {
    const bool has_sign = text.find('-') != std::string_view::npos;  // "-1": no genre is known
    for (const auto& part : parts_of(text.substr(0, kMostTextBytes))) {
        const bool is_counted = place == Place::genre && is_number(part) && !has_sign;
        for (std::size_t at = 0; at < part.size();) {
            auto found = table.longest(is_counted ? Place::number : place, part, at);
            at += std::max<std::size_t>(found.count, 1);
            if (found.count > 0) {
                rows.push_back(std::move(found));
            }
        }
    }
}

void add_rows(std::span<const GenreWords::Found> rows, float strength, TagEvidence& evidence) {
    const auto counts = [](const GenreWords::Found& row) {
        return row.dance != GenreWords::kNothing;
    };
    const auto total = std::count_if(rows.begin(), rows.end(), counts);
    for (const GenreWords::Found& row : rows) {
        if (std::find(evidence.words.begin(), evidence.words.end(), row.words) ==
            evidence.words.end()) {
            evidence.words.push_back(row.words);
        }
        if (!counts(row)) {
            continue;
        }
        auto& dances = evidence.dances;
        auto dance = std::find_if(dances.begin(), dances.end(), [&](const auto& each) {
            return each.first == row.dance;
        });
        if (dance == dances.end()) {
            dance = dances.insert(dances.end(), {std::string(row.dance), 0.0F});
        }
        dance->second =
            std::min(kGenreTagStrength, dance->second + strength / static_cast<float>(total));
    }
}

}  // namespace

std::string_view TagEvidence::dance() const noexcept {
    const auto most =
        std::max_element(dances.begin(), dances.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
        });
    return most == dances.end() ? std::string_view() : std::string_view(most->first);
}

TagEvidence evidence_of(const TagTexts& tags, const GenreWords& table) {
    TagEvidence evidence;
    std::vector<GenreWords::Found> rows;
    find_rows(Place::genre, tags.genre, table, rows);
    add_rows(rows, kGenreTagStrength, evidence);
    rows.clear();
    for (const std::string_view text : {tags.title, tags.artist, tags.album}) {
        find_rows(Place::title, text, table, rows);
    }
    add_rows(rows, kTitleStrength, evidence);
    return evidence;
}

GenreLogProbabilities prior_of(const TagEvidence& evidence, const GenreModel& model) {
    GenreLogProbabilities prior{};
    const float most =
        evidence.is_by_person ? std::numeric_limits<float>::max() : kGenreTagStrength;
    for (const auto& [dance, strength] : evidence.dances) {
        const auto genre = std::find(model.genres.begin(), model.genres.end(), dance);
        float& of_class = prior[static_cast<std::size_t>(genre - model.genres.begin())];
        of_class = std::min(most, of_class + strength);
    }
    return prior;
}

}  // namespace raks::audio
