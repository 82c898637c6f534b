#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// Pose and face of one dancer for programs that show an avatar, by the VMC protocol: OSC over UDP
/// (docs/reference/files.md). `HOST[:39539][,dancer=N][,rate=HZ][,travel=hips|root|none][,way=X]
/// [,rotations=normalised|raw][,yaw=DEG][,lead=MS]`. Errors: the target.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_vmc(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_vmc(const std::string& target);

}  // namespace raks::engine
