// Models out: VRM 1.0.
#pragma once

#include <string>

#include "base/expected.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// A figure as VRM 1.0: all that glb_bytes writes, its bones, expressions, gaze, springs,
/// constraints and MToon. Its nodes rest in a T-pose, face +z, in metres. Of its licence the terms
/// that VRM 1.0 has are kept, by their own names; what is not said is VRM's own default, which
/// allows the least. Clips are left out, which VRM has in files of their own. The same model gives
/// the same bytes. Errors: bones that VRM asks for are missing, no title or no author, more than
/// 4 GiB. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> vrm_bytes(const Model& model);

}  // namespace raks::render
