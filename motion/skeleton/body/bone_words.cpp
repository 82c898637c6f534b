#include "motion/skeleton/body/bone_words.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "motion/skeleton/body/bone_vocabulary.hpp"

namespace raks::motion {
namespace {

bool is_number(std::string_view word) { return word.front() >= '0' && word.front() <= '9'; }

enum class LetterKind : std::uint8_t { other, lower, upper, digit };

LetterKind letter_kind(char c) {
    if (c >= 'a' && c <= 'z') {
        return LetterKind::lower;
    }
    if (c >= 'A' && c <= 'Z') {
        return LetterKind::upper;
    }
    return c >= '0' && c <= '9' ? LetterKind::digit : LetterKind::other;
}

/// Whether a word begins at `at`, which is no separator, though a letter or number stands before.
bool begins_word(std::string_view text, std::size_t at) {
    const LetterKind here = letter_kind(text[at]);
    const LetterKind before = letter_kind(text[at - 1]);
    if ((here == LetterKind::digit) != (before == LetterKind::digit)) {
        return true;
    }
    if (here == LetterKind::upper && before == LetterKind::lower) {
        return true;
    }
    // "LThumb": the last of several capitals belongs to what follows.
    return here == LetterKind::upper && before == LetterKind::upper && at + 1 < text.size() &&
           letter_kind(text[at + 1]) == LetterKind::lower;
}

/// "L5", "T8", "C7": a joint of the spine by its vertebra, as MVN has them.
bool is_vertebra(const std::vector<std::string>& words) {
    return words.size() == 2 && is_number(words[1]) && words[1].size() <= 2 &&
           (words[0] == "l" || words[0] == "t" || words[0] == "c");
}

BodyPart finger_part(std::string_view core) {
    // "handthumb", "findex", "indexfinger", "littlefinger"
    for (const std::string_view before : {"hand", "f"}) {
        if (core.size() > before.size() && core.substr(0, before.size()) == before) {
            core.remove_prefix(before.size());
        }
    }
    constexpr std::string_view kFinger = "finger";
    if (core.size() > kFinger.size() && core.ends_with(kFinger)) {
        core.remove_suffix(kFinger.size());
    }
    const PartName* const part = part_named(core);
    return part != nullptr && part->part >= BodyPart::thumb ? part->part : BodyPart::none;
}

/// A part that is said with upper or lower behind it: "armUpper" is the upper arm.
const PartName* part_with_end(std::string_view core) {
    for (const std::string_view end : {"upper", "lower", "up", "low"}) {
        if (core.size() > end.size() && core.ends_with(end)) {
            core.remove_suffix(end.size());
            return part_named(std::string(end) + std::string(core));
        }
    }
    return nullptr;
}

/// Whether joined words name a part, with the part and its doubt in `read`.
bool names_part(std::string_view core, BoneWords& read) {
    const PartName* part = part_named(core);
    part = part != nullptr ? part : part_with_end(core);
    if (part != nullptr) {
        read.part = part->part;
        read.doubt += part->doubt;
    } else {
        read.part = finger_part(core);
    }
    return read.part != BodyPart::none;
}

/// "lfemur", "lefthand", "handright": a side without a sign or capital between.
void split_side(std::string_view core, BoneWords& read) {
    for (const Side side : kSides) {
        for (const std::string_view word : words_of_side(side)) {
            if (read.part != BodyPart::none || core.size() <= word.size()) {
                continue;
            }
            const std::size_t others = core.size() - word.size();
            const bool is_found =
                (core.starts_with(word) && names_part(core.substr(word.size()), read)) ||
                (core.ends_with(word) && names_part(core.substr(0, others), read));
            if (is_found) {
                read.side = side;
            }
        }
    }
}

void set_part(std::string_view core, BoneWords& read) {
    if (!names_part(core, read) && !read.side) {
        split_side(core, read);
    }
    if (read.part == BodyPart::hips && read.side) {
        read.part = BodyPart::upper_leg;  // "l_hip"
        read.doubt += 10;
    }
}

}  // namespace

std::vector<std::string> words_of_name(std::string_view name) {
    if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos) {
        name.remove_prefix(colon + 1);
    }
    const std::string text = in_english(name.substr(0, 200));
    std::vector<std::string> words;
    bool is_within = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const LetterKind kind = letter_kind(text[i]);
        if (kind == LetterKind::other) {
            is_within = false;
            continue;
        }
        if (!is_within || begins_word(text, i)) {
            words.emplace_back();
        }
        is_within = true;
        words.back() +=
            kind == LetterKind::upper ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
    }
    return words;
}

std::unordered_set<std::string> shared_words(const std::vector<std::vector<std::string>>& names) {
    std::unordered_map<std::string, std::size_t> counts;
    for (const std::vector<std::string>& words : names) {
        const std::unordered_set<std::string> once(words.begin(), words.end());
        for (const std::string& word : once) {
            ++counts[word];
        }
    }
    std::unordered_set<std::string> shared;
    for (const auto& [word, count] : counts) {
        if (2 * count > names.size() && names.size() > 4 && part_named(word) == nullptr &&
            !side_of_word(word)) {
            shared.insert(word);
        }
    }
    return shared;
}

BoneWords read_bone_words(const std::vector<std::string>& words,
                          const std::unordered_set<std::string>& noise) {
    BoneWords read;
    std::string core;
    if (is_vertebra(words)) {
        read.part = words.front() == "c" ? BodyPart::neck : BodyPart::spine;
        return read;
    }
    for (const std::string& word : words) {
        if (is_number(word)) {
            if (read.finger < 0 && core.ends_with("finger") && word.size() <= 2) {
                read.finger = word.front() - '0';
            }
        } else if (const std::optional<Side> side = side_of_word(word)) {
            read.side = side;
        } else if (word == "twist" || word == "roll" || (word == "joint" && core == "hip")) {
            read.doubt += 20;  // CMU's LHipJoint lies between the hips and the hip
        } else if (word == "org") {
            read.doubt += 15;
        } else if (word == "metacarpal") {
            read.is_metacarpal = true;
        } else if (word != "proximal" && word != "intermediate" && word != "distal" &&
                   noise.count(word) == 0 &&
                   (!is_empty_word(word) || (word == "base" && core == "spine"))) {
            core += word;  // Kinect's SpineBase is the hips
        }
    }
    set_part(core, read);
    return read;
}

}  // namespace raks::motion
