// Bone vocabulary: the words that tools and people use for the parts of a body.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "motion/skeleton/body/bone_words.hpp"
#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// A word for a part: lower case, joined of the words of a name.
struct PartName {
    std::string_view name;
    BodyPart part;
    int doubt = 0;  ///< as BoneWords::doubt
};

/// The part that joined words name; null: none is known.
[[nodiscard]] const PartName* part_named(std::string_view name);

/// Whether a word says nothing of the part: "joint", "def".
[[nodiscard]] bool is_empty_word(std::string_view word);

/// The words of a side, longer ones first where one begins another.
[[nodiscard]] std::span<const std::string_view> words_of_side(Side side);

/// The side that a word names.
[[nodiscard]] std::optional<Side> side_of_word(std::string_view word);

/// A name whose Japanese words are English ones between blanks, letters with marks plain ones.
[[nodiscard]] std::string in_english(std::string_view name);

}  // namespace raks::motion
