#include "engine/import/fbx_connections.hpp"

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

/// A text without the length before it; empty: the property is none.
std::string_view text_at(std::string_view bytes, std::size_t at) {
    return bytes[at] == 'S' ? bytes.substr(at + 5, fbx_number<std::uint32_t>(bytes, at + 1))
                            : std::string_view();
}

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

    /// Where the first three properties are; fewer: there are no more.
    std::vector<std::size_t> three_of(std::size_t at, const FbxRecord& record) const {
        std::vector<std::size_t> places;
        const std::size_t end = first_in(at, record);
        std::size_t place = properties_of(at, record);
        while (places.size() < 3 && place < end) {
            places.push_back(place);
            place += static_cast<std::size_t>(records_.property_bytes(place, end));
        }
        return places;
    }

    /// A number, a name, a kind.
    void take_object(std::size_t at, const FbxRecord& record) {
        const std::vector<std::size_t> places = three_of(at, record);
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
        const std::vector<std::size_t> places = three_of(at, record);
        if (places.size() == 3 && text_at(bytes_, places[0]) == "OO" && bytes_[places[1]] == 'L' &&
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
};

}  // namespace

void mend_fbx_connections(std::string& bytes, std::vector<std::string>& notes) {
    if (!is_binary_fbx(bytes)) {
        return;
    }
    const Connections found(bytes);
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
