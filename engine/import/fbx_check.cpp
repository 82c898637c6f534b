#include "engine/import/fbx_check.hpp"

#include <cstdint>
#include <vector>

#include "engine/import/fbx_records.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::size_t kDeepestRecord = 64;
constexpr std::uint32_t kOldest = 7100;  // of 2011; assimp reads none before
constexpr std::uint32_t kNewest = 7900;

tl::unexpected<Error> damaged(std::size_t offset, const char* what) {
    return fail(fmt::format("is damaged: the record at byte {} {}", offset, what));
}

/// The records of a file.
class RecordWalk {
 public:
    explicit RecordWalk(std::string_view bytes) : records_(bytes), bytes_(bytes.size()) {}

    Expected<void> run() {
        std::size_t at = kFbxHead;
        while (true) {
            const std::size_t limit = ends_.empty() ? bytes_ : ends_.back();
            if (!ends_.empty() && at == limit) {
                ends_.pop_back();
                continue;
            }
            if (records_.head_bytes() > limit - at) {
                return damaged(at, "is cut off");
            }
            const FbxRecord record = records_.record_at(at);
            if (record.end == 0) {
                if (ends_.empty()) {
                    return {};
                }
                // It closes the list of its parent.
                if (at + records_.head_bytes() != limit) {
                    return damaged(at, "closes a list too soon");
                }
                at = limit;
                continue;
            }
            const std::size_t body = at + records_.head_bytes() + record.name_bytes;
            if (record.end > limit || body > record.end ||
                record.property_bytes > record.end - body) {
                return damaged(at, "does not lie within the one that it is in");
            }
            const auto first = static_cast<std::size_t>(body + record.property_bytes);
            if (auto good = check_properties(record, body, first); !good) {
                return good;
            }
            ends_.push_back(static_cast<std::size_t>(record.end));
            if (ends_.size() > kDeepestRecord) {
                return damaged(at, "lies too deep");
            }
            at = first;
        }
    }

 private:
    Expected<void> check_properties(const FbxRecord& record,
                                    std::size_t at,
                                    std::size_t end) const {
        for (std::uint64_t i = 0; i < record.properties; ++i) {
            const std::uint64_t size = at < end ? records_.property_bytes(at, end) : 0;
            if (size == 0) {
                return damaged(at, "has properties of an unknown type");
            }
            at += static_cast<std::size_t>(size);
        }
        return at == end ? Expected<void>() : damaged(at, "has properties of another length");
    }

    FbxRecords records_;
    std::size_t bytes_;
    std::vector<std::size_t> ends_;
};

/// Braces outside of texts and comments: as many close as open, and not too many at a time.
Expected<void> check_braces(std::string_view text) {
    std::size_t depth = 0;
    bool is_text = false;
    bool is_comment = false;
    for (const char c : text) {
        if (is_comment) {
            is_comment = c != '\n';
        } else if (c == '"') {
            is_text = !is_text;
        } else if (is_text) {
            continue;
        } else if (c == ';') {
            is_comment = true;
        } else if (c == '{') {
            ++depth;
        } else if (c == '}' && depth-- == 0) {
            return fail("is damaged: a brace closes that was not opened");
        }
        if (depth > kDeepestRecord) {
            return fail("is damaged: too many braces inside one another");
        }
    }
    return depth == 0 && !is_text ? Expected<void>()
                                  : fail("is cut off: a brace or a text is not closed");
}

}  // namespace

Expected<void> check_fbx(std::string_view bytes) {
    if (is_binary_fbx(bytes)) {
        if (bytes.size() < kFbxHead) {
            return fail("is cut off within its header; copy it again");
        }
        const std::uint32_t version = fbx_version(bytes);
        if (version < kOldest || version > kNewest) {
            return fail(fmt::format(
                "FBX version {}: {} to {} are read; save it as GLB, in Blender for example",
                version,
                kOldest,
                kNewest));
        }
        return RecordWalk(bytes).run();
    }
    if (bytes.find("FBXHeaderExtension") == std::string_view::npos ||
        bytes.find('\0') != std::string_view::npos) {
        return fail("is not FBX");
    }
    return check_braces(bytes);
}

}  // namespace raks::engine
