// What a reader in a process of its own may have of what lies beside a model.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/import/side_files.hpp"

namespace raks::render {

/// Files beside a model for a reader that may have been taken over by it: pictures (.png, .jpg,
/// .jpeg, .webp, .bmp, .tga), materials (.mtl) and buffers (.bin) whose names stand in the model or
/// in a .mtl that was handed out before. The folders before a name are the reader's own guesses.
/// Threads: one. Real-time: no.
class WantedFiles {
 public:
    /// `model`: the bytes of its file; they and `side` must outlive this.
    WantedFiles(std::span<const std::byte> model, const SideFiles& side);

    /// All of a file, or of a data URI. `uri`: as for SideFiles::read. Errors: those of
    /// SideFiles::read and read_data_uri; another kind of file; one that nothing names.
    [[nodiscard]] Expected<std::vector<std::byte>> read(std::string_view uri,
                                                        std::size_t max_bytes);

 private:
    [[nodiscard]] bool is_named(std::string_view name) const;

    const SideFiles& side_;
    std::span<const std::byte> model_;
    std::vector<std::string> texts_;  // that name files, beside the model itself
};

/// Whether a text names a file, however it spells it: as it is, with "%20", with "&amp;" or with
/// "\u00e9". Characters beyond ASCII stand for one another: programs disagree about their codes.
[[nodiscard]] bool spells_name(std::string_view text, std::string_view name);

}  // namespace raks::render
