#include "engine/import/fbx_connections.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <string_view>

#include "base/printable.hpp"
#include "engine/import/fbx_records.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

/// A geometry or a model.
struct FbxObject {
    std::int64_t id = 0;
    std::string_view name;
};

/// From a child to its parent: both must be objects of the file.
struct FbxConnection {
    std::int64_t child = 0;
    std::int64_t parent = 0;
    std::size_t parent_at = 0;  ///< where the parent's number stands
};

constexpr std::size_t kTextHead = 5;     // a text's type and length, which are in front of it
constexpr std::size_t kNumberBytes = 9;  // of a number of 64 bits, with its type

/// A text without the length before it; empty: the property is none.
std::string_view text_at(std::string_view bytes, std::size_t at) {
    return bytes[at] == 'S' ? bytes.substr(at + kTextHead, fbx_number<std::uint32_t>(bytes, at + 1))
                            : std::string_view();
}

/// A connection as the file has it: where its record and its first properties are. Four are looked
/// at; fewer: there are no more.
struct FbxLink {
    std::size_t name_at = 0;
    std::vector<std::size_t> properties;
};

/// What there is to connect in a file whose records are good.
class Connections {
 public:
    explicit Connections(std::string_view bytes) : bytes_(bytes), records_(bytes) {
        for_each_in(kFbxHead, bytes.size(), [&](std::size_t at, const FbxRecord& record) {
            const std::string_view name = name_of(at, record);
            if (name == "Objects" || name == "Connections") {
                for_each_in(first_in(at, record),
                            static_cast<std::size_t>(record.end),
                            [&](std::size_t inner, const FbxRecord& one) {
                                name == "Objects" ? take_object(inner, one)
                                                  : take_connection(inner, one);
                            });
            }
        });
    }

    /// Those of geometries whose model is not there.
    [[nodiscard]] std::vector<FbxConnection> astray() const {
        std::vector<FbxConnection> found;
        for (const FbxConnection& connection : connections_) {
            if (geometries_.contains(connection.child) && !models_.contains(connection.parent)) {
                found.push_back(connection);
            }
        }
        return found;
    }

    /// Mesh models without a geometry, in the order of the file.
    [[nodiscard]] std::vector<FbxObject> bare() const {
        std::set<std::int64_t> clad;
        for (const FbxConnection& connection : connections_) {
            if (geometries_.contains(connection.child)) {
                clad.insert(connection.parent);
            }
        }
        std::vector<FbxObject> found;
        for (const FbxObject& model : mesh_models_) {
            if (!clad.contains(model.id)) {
                found.push_back(model);
            }
        }
        return found;
    }

    /// All connections, as they stand.
    [[nodiscard]] const std::vector<FbxLink>& links() const { return links_; }

 private:
    std::string_view name_of(std::size_t at, const FbxRecord& record) const {
        return bytes_.substr(at + records_.head_bytes(), record.name_bytes);
    }

    std::size_t properties_of(std::size_t at, const FbxRecord& record) const {
        return at + records_.head_bytes() + record.name_bytes;
    }

    std::size_t first_in(std::size_t at, const FbxRecord& record) const {
        return properties_of(at, record) + static_cast<std::size_t>(record.property_bytes);
    }

    template <typename Use>
    void for_each_in(std::size_t at, std::size_t end, const Use& use) const {
        while (at < end && records_.head_bytes() <= end - at) {
            const FbxRecord record = records_.record_at(at);
            if (record.end == 0) {
                return;
            }
            use(at, record);
            at = static_cast<std::size_t>(record.end);
        }
    }

    /// Where the first properties are, so many at most.
    std::vector<std::size_t> first_of(std::size_t at,
                                      const FbxRecord& record,
                                      std::size_t most) const {
        std::vector<std::size_t> places;
        const std::size_t end = first_in(at, record);
        std::size_t place = properties_of(at, record);
        while (places.size() < most && place < end) {
            places.push_back(place);
            place += static_cast<std::size_t>(records_.property_bytes(place, end));
        }
        return places;
    }

    /// A number, a name, a kind.
    void take_object(std::size_t at, const FbxRecord& record) {
        const std::vector<std::size_t> places = first_of(at, record, 3);
        if (places.size() < 3 || bytes_[places[0]] != 'L') {
            return;
        }
        const std::string_view full = text_at(bytes_, places[1]);
        const FbxObject object{.id = fbx_number<std::int64_t>(bytes_, places[0] + 1),
                               .name = full.substr(0, full.find('\0'))};
        const bool is_mesh = text_at(bytes_, places[2]) == "Mesh";
        if (name_of(at, record) == "Geometry" && is_mesh) {
            geometries_.insert(object.id);
        } else if (name_of(at, record) == "Model") {
            models_.insert(object.id);
            if (is_mesh) {
                mesh_models_.push_back(object);
            }
        }
    }

    /// "OO" from object to object, the child, the parent.
    void take_connection(std::size_t at, const FbxRecord& record) {
        if (name_of(at, record) != "C") {
            return;
        }
        const std::vector<std::size_t> places = first_of(at, record, 4);
        links_.push_back({.name_at = at + records_.head_bytes(), .properties = places});
        if (places.size() >= 3 && text_at(bytes_, places[0]) == "OO" && bytes_[places[1]] == 'L' &&
            bytes_[places[2]] == 'L') {
            connections_.push_back({.child = fbx_number<std::int64_t>(bytes_, places[1] + 1),
                                    .parent = fbx_number<std::int64_t>(bytes_, places[2] + 1),
                                    .parent_at = places[2] + 1});
        }
    }

    std::string_view bytes_;
    FbxRecords records_;
    std::set<std::int64_t> geometries_;
    std::set<std::int64_t> models_;
    std::vector<FbxObject> mesh_models_;
    std::vector<FbxConnection> connections_;
    std::vector<FbxLink> links_;
};

/// The kind of a connection and the types of what it connects: "PO LSL".
std::string shape_of(std::string_view bytes, const FbxLink& link) {
    std::string shape;
    for (std::size_t i = 0; i < link.properties.size(); ++i) {
        shape += i == 0 ? std::string(text_at(bytes, link.properties[0])) + " "
                        : std::string(1, bytes[link.properties[i]]);
    }
    return shape;
}

/// Makes OP of a connection of kind PO whose property is its property `name`, 2 or 3; it moves to
/// the end, where OP has it.
void make_op(std::string& bytes, const FbxLink& link, std::size_t name) {
    bytes.replace(link.properties[0] + kTextHead, 2, "OP");
    if (name == 2) {
        const auto at = [&](std::size_t place) {
            return bytes.begin() + static_cast<std::ptrdiff_t>(place);
        };
        std::rotate(
            at(link.properties[2]), at(link.properties[3]), at(link.properties[3] + kNumberBytes));
    }
}

/// What assimp would refuse the file at, of a binary FBX.
void mend_links(std::string& bytes,
                const std::vector<FbxLink>& links,
                std::vector<std::string>& notes) {
    std::size_t left_out = 0;
    for (const FbxLink& link : links) {
        const std::string shape = shape_of(bytes, link);
        if (shape == "PO LSL" || shape == "PO LLS") {
            make_op(bytes, link, shape == "PO LSL" ? 2 : 3);
        } else if (shape.rfind("PP ", 0) != 0 && shape.substr(0, 5) != "OO LL" &&
                   shape.substr(0, 6) != "OP LLS") {
            bytes[link.name_at] = 'c';  // a record that nobody asks for
            ++left_out;
        }
    }
    if (left_out > 0) {
        notes.push_back(
            fmt::format("{} of its connections are of no kind that is read: left out", left_out));
    }
}

/// A number or a text in quotes of a text FBX, and where what follows it begins. Empty: neither.
std::string_view word_at(std::string_view text, std::size_t at) {
    const bool is_text = at < text.size() && text[at] == '"';
    const std::size_t end =
        is_text ? text.find('"', at + 1) : text.find_first_not_of("-0123456789", at);
    return end == std::string_view::npos ? std::string_view()
                                         : text.substr(at, end - at + (is_text ? 1 : 0));
}

/// Where the next of several words with commas between them begins; npos: there is none.
std::size_t after_comma(std::string_view text, std::size_t at) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t comma = text.find_first_not_of(kBlanks, at);
    return comma == std::string_view::npos || text[comma] != ','
               ? std::string_view::npos
               : text.find_first_not_of(kBlanks, comma + 1);
}

/// The connections of kind PO of a text FBX.
void mend_text_links(std::string& text) {
    constexpr std::string_view kKind = "\"PO\"";
    for (std::size_t kind = text.find(kKind); kind != std::string::npos;
         kind = text.find(kKind, kind + 1)) {
        const std::size_t key = text.find_last_not_of(" \t", kind == 0 ? 0 : kind - 1);
        if (key == std::string::npos || key < 1 || text.compare(key - 1, 2, "C:") != 0) {
            continue;
        }
        std::array<std::string_view, 3> words;
        std::size_t at = kind + kKind.size();
        for (std::string_view& word : words) {
            at = after_comma(text, at);
            word = at == std::string::npos ? std::string_view() : word_at(text, at);
            if (word.empty()) {
                break;
            }
            at += word.size();
        }
        if (words[2].empty() || words[1].front() != '"' || words[2].front() == '"') {
            continue;
        }
        const auto between = std::string(words[1].data() + words[1].size(), words[2].data());
        const std::string turned = std::string(words[2]) + between + std::string(words[1]);
        text.replace(at - turned.size(), turned.size(), turned);
        text.replace(kind, kKind.size(), "\"OP\"");
    }
}

}  // namespace

void mend_fbx_connections(std::string& bytes, std::vector<std::string>& notes) {
    if (!is_binary_fbx(bytes)) {
        mend_text_links(bytes);
        return;
    }
    const Connections found(bytes);
    mend_links(bytes, found.links(), notes);
    const std::vector<FbxConnection> astray = found.astray();
    const std::vector<FbxObject> bare = found.bare();
    for (std::size_t i = 0; i < astray.size() && i < bare.size(); ++i) {
        notes.push_back(
            fmt::format("a mesh is connected to a model that is not there: put on \"{}\"",
                        printable(bare[i].name, 60)));
        std::memcpy(bytes.data() + astray[i].parent_at, &bare[i].id, sizeof(bare[i].id));
    }
}

}  // namespace raks::engine
