// Models out: 3DS.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// A picture that lies beside a 3DS file.
struct TdsPicture {
    std::string name;  ///< of the file
    std::vector<std::byte> bytes;
};

/// A model as 3DS.
struct TdsExport {
    std::string bytes;
    std::vector<TdsPicture> pictures;
    /// What each node of the model is called in the file: no two the same.
    std::vector<std::string> node_names;
};

/// A model of rigid parts (segmented_model) as 3DS, version 3: an object for each mesh, its axes
/// and pivot those of its node, the nodes as the keyframer's hierarchy with one key each, materials
/// with colour, transparency, two sides, glow and the colour's texture. Z is up, a unit a metre.
/// Names have 10 characters at most, those of bones a word for each part ("UpArmL"). A mesh of more
/// than 65,535 vertices or triangles is divided among nodes below its own. Skins, morph targets and
/// clips are left out. `stem`: what names of pictures begin with. Errors: more than 65,534 nodes,
/// more than 4 GiB, skins. Threads: any. Real-time: no.
[[nodiscard]] Expected<TdsExport> tds_export(const Model& model, const std::string& stem);

}  // namespace raks::render
