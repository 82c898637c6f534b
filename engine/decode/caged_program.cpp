#include "engine/decode/caged_program.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "base/talking_child.hpp"
#include "engine/decode/confine.hpp"

namespace raks::engine {

std::optional<CagedArguments> arguments_of_raks(int argc, char** argv) {
    struct stat status {};
    if (fstat(kTalkSocket, &status) != 0 || !S_ISSOCK(status.st_mode)) {
        return std::nullopt;
    }
    CagedArguments arguments{.words = {argv + std::min(argc, 1), argv + argc}};
    if (!arguments.words.empty() && arguments.words.back() == "--no-sandbox") {
        arguments.words.pop_back();
        arguments.is_to_be_caged = false;
    }
    return arguments;
}

bool enter_cage(const CagedArguments& arguments, const Cage& cage) {
    if (cage.seconds) {
        const rlimit processor{*cage.seconds, *cage.seconds};
        static_cast<void>(setrlimit(RLIMIT_CPU, &processor));
    }
    return !arguments.is_to_be_caged || confine(cage.more_memory) == Confinement::whole;
}

}  // namespace raks::engine
