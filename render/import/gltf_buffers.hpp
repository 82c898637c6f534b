#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/import/gltf_file.hpp"
#include "render/import/import_budget.hpp"
#include "render/import/json_field.hpp"
#include "render/import/model_unpacker.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The bytes of a file: its buffers and the views of them, meshopt's unpacked. Everything that
/// they claim is checked when it is made; bytes are fetched when they are asked for.
class GltfBuffers {
 public:
    /// `file`, `side` and `budget` must outlive it. Faults: see JsonField; a view beyond its
    /// buffer, a stride that cannot be.
    GltfBuffers(const GltfFile& file,
                const SideFiles& side,
                const JsonField& root,
                ImportBudget& budget,
                Model& model);

    [[nodiscard]] std::size_t view_count() const noexcept { return views_.size(); }
    /// Length of a view in bytes, as it says.
    [[nodiscard]] std::uint64_t length(int view) const { return views_[at(view)].length; }
    /// Where it begins in its buffer; of unpacked ones 0.
    [[nodiscard]] std::uint64_t offset(int view) const;
    /// 34962: vertices, 34963: indices; 0: it does not say.
    [[nodiscard]] std::int64_t target(int view) const { return views_[at(view)].target; }
    /// Bytes from element to element; 0: they touch.
    [[nodiscard]] std::size_t stride(int view) const { return views_[at(view)].stride; }
    /// All bytes of a view. Empty after a fault, which is noted at `user`: the buffer is not
    /// there, too short, packed wrongly.
    [[nodiscard]] std::span<const std::byte> bytes(int view, const JsonField& user);
    /// Fetches what nothing asked for: a buffer that cannot be had is a fault all the same.
    void check_unread();

 private:
    struct Buffer {
        JsonField field;
        std::uint64_t length = 0;
        bool is_fetched = false;
        bool is_fallback = false;          ///< for readers without meshopt
        std::vector<std::byte> own;        ///< what was read for it
        std::span<const std::byte> bytes;  ///< in `own` or in the file
    };
    /// EXT_meshopt_compression
    struct Packed {
        int buffer = 0;
        std::uint64_t offset = 0;
        std::uint64_t length = 0;
        UnpackRequest how;
        bool is_good = false;  ///< `how` is one that can be
        bool is_unpacked = false;
        std::vector<std::byte> unpacked;
    };
    struct View {
        int buffer = 0;
        std::uint64_t offset = 0;
        std::uint64_t length = 0;
        std::size_t stride = 0;
        std::int64_t target = 0;
        std::optional<Packed> packed;
    };
    static std::size_t at(int index) { return static_cast<std::size_t>(index); }
    void read_buffers(const JsonField& list);
    void read_views(const JsonField& list);
    void check_range(const JsonField& field, int buffer, std::uint64_t offset, std::uint64_t size);
    Packed read_packed(const JsonField& field, const View& view);
    std::span<const std::byte> fetch(int buffer, const JsonField& user);
    std::vector<std::byte> fetched(Buffer& buffer, const JsonField& user);
    std::span<const std::byte> unpack(Packed& packed, const JsonField& user);

    const GltfFile& file_;
    const SideFiles& side_;
    ImportBudget& budget_;
    Model& model_;
    std::vector<Buffer> buffers_;
    std::vector<View> views_;
    ModelUnpacker unpacker_;
};

}  // namespace raks::render
