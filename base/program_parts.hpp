#pragma once

#include <filesystem>
#include <string>

#include "base/expected.hpp"

namespace raks {

/// A program or module that is a part of ours: `name` beside the running program (as it is built)
/// or in `folder` of what it is installed under ("libexec/raks"). A path in the environment's
/// `variable` goes before both. Errors: it is not there. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::filesystem::path> find_program_part(const std::string& name,
                                                                const std::string& folder,
                                                                const char* variable);

/// The function `function` of such a module, loaded once found, and never unloaded. Errors: it is
/// not there, cannot be loaded (says why), or is of another build.
/// Threads: one at a time. Real-time: no.
[[nodiscard]] Expected<void*> load_program_part(const std::string& name,
                                                const std::string& folder,
                                                const char* variable,
                                                const char* function);

}  // namespace raks
