// What the programs have in common that read for raks what others wrote, in a cage.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace raks::engine {

/// What such a program returns to a person who starts it.
inline constexpr int kWrongUsage = 2;

/// What such a program is started with.
struct CagedArguments {
    std::vector<std::string_view> words;  ///< all but the last, if that is "--no-sandbox"
    bool is_to_be_caged = true;
};

/// What raks, which speaks over kTalkSocket, gives; nothing where somebody else is the starter.
[[nodiscard]] std::optional<CagedArguments> arguments_of_raks(int argc, char** argv);

/// How much of the machine a program gets.
struct Cage {
    std::uint64_t more_memory = 0;  ///< bytes, as confine() has it
    std::optional<rlim_t> seconds;  ///< of the processor; none: as many as it takes
};

/// Confines this process, for good, if it is to be. False: this kernel refuses seccomp, which is to
/// be told to raks; all else holds. Libraries must be loaded before. Threads: the only one.
[[nodiscard]] bool enter_cage(const CagedArguments& arguments, const Cage& cage);

}  // namespace raks::engine
