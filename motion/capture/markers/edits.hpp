// Edits: what a person corrected in tracks (paper, section 3.1: user intervention).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// What an edit does.
enum class EditKind {
    set,      ///< the marker is at this pixel of a camera at this frame
    hide,     ///< the marker's spots are not believed in these frames
    swap,     ///< from this frame on the two markers are each other
    fill,     ///< the marker's places in these frames are made from those around them
    exchange  ///< left and right are exchanged in what a camera's network saw in these frames
};

/// One edit. `edits.jsonl` has one such a line:
///
///     {"edit": "set", "frame": 120, "camera": "left", "marker": "head", "u": 310.5, "v": 92.0}
///     {"edit": "hide", "marker": "head", "first": 130, "last": 150}
///     {"edit": "swap", "frame": 200, "marker": "left_wrist", "other": "right_wrist"}
///     {"edit": "fill", "marker": "c7", "first": 40, "last": 52}
///
/// Takes without markers know `set`, `hide` (of a joint, of one camera's sights of it, or of all
/// that a camera sees) and `exchange`, of all limbs or of these:
///
///     {"edit": "hide", "camera": "left", "first": 130, "last": 150}
///     {"edit": "hide", "camera": "left", "marker": "left_wrist", "first": 130, "last": 150}
///     {"edit": "exchange", "camera": "left", "first": 200, "last": 214}
///     {"edit": "exchange", "camera": "left", "limbs": "legs", "first": 200, "last": 214}
struct Edit {
    EditKind kind = EditKind::set;
    std::string marker{};   ///< empty: exchange, or hide of all that a camera sees
    std::string other{};    ///< of swap
    std::string camera{};   ///< of set and exchange; of hide where it is of one camera
    std::size_t first = 0;  ///< frame
    std::size_t last = 0;   ///< frame, included; of hide, fill and exchange, else `first`
    glm::dvec2 pixel{};     ///< of set
    std::string limbs{};    ///< of exchange: "arms" or "legs"; empty: both

    friend bool operator==(const Edit&, const Edit&) = default;
};

/// Edits as such lines. Numbers read back to the same bits.
[[nodiscard]] std::string edits_text(const std::vector<Edit>& edits);
/// Reads them. Errors, one line with its number: no JSON, an unknown edit or key, values missing or
/// out of range, a stretch that ends before it begins, a marker swapped with itself. Blank lines
/// are passed over.
[[nodiscard]] Expected<std::vector<Edit>> read_edits(std::string_view text,
                                                     const std::string& file);

}  // namespace raks::capture
