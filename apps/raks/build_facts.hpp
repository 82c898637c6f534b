#pragma once

namespace raks::apps {

/// What this program was built from. Threads: any.
struct BuildFacts {
    const char* version;   ///< "0.1.0"
    const char* commit;    ///< of the sources, or "unknown"
    const char* compiler;  ///< "GNU 12.2.0, Release"
};
[[nodiscard]] BuildFacts build_facts() noexcept;

}  // namespace raks::apps
