// Made dance: a motion to music, made by `raks dance` beside this process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

#include "base/expected.hpp"

namespace raks::apps {

/// A dance that is on its way. What was made is removed with it. Threads: one.
class MadeDance {
 public:
    /// Starts `program` as `raks dance MUSIC -o FILE`. Errors: the system's.
    [[nodiscard]] static Expected<MadeDance> begin(const std::filesystem::path& program,
                                                   const std::filesystem::path& music);
    MadeDance(MadeDance&& other) noexcept;             ///< `other` is empty then
    MadeDance& operator=(MadeDance&& other) noexcept;  ///< likewise
    ~MadeDance();                                      ///< ends it, where it is not done

    /// The file that was made; none: it is not done. Errors: the program says that it cannot be.
    [[nodiscard]] Expected<std::optional<std::filesystem::path>> take();

 private:
    MadeDance() = default;

    std::filesystem::path music_;
    std::filesystem::path folder_;  // its own; empty: nothing is there
    pid_t child_ = -1;              // -1: it has ended
};

}  // namespace raks::apps
