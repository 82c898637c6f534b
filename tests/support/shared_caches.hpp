#pragma once

#include <filesystem>
#include <string>

namespace raks::test {

/// Lets the tests of one build share solved dances, which take seconds to solve: links
/// `cache`/raks/dances to a folder beside the running test program. Nothing else of a cache is
/// shared. What lies there is keyed by the program that solved it, so that a new build solves anew.
/// `name`: of the program that solves them, each has a folder of its own.
inline void share_solved_dances(const std::filesystem::path& cache, const std::string& name) {
    namespace fs = std::filesystem;
    const fs::path kept = fs::canonical("/proc/self/exe").parent_path() / "solved_dances" / name;
    fs::create_directories(kept);
    fs::create_directories(cache / "raks");
    fs::create_directory_symlink(kept, cache / "raks" / "dances");
}

}  // namespace raks::test
