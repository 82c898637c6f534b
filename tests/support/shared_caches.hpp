#pragma once

#include <filesystem>
#include <string>

namespace raks::test {

/// A folder of this build for what its tests may share, beside the running test program.
inline std::filesystem::path shared_folder(const std::string& name) {
    const std::filesystem::path folder =
        std::filesystem::canonical("/proc/self/exe").parent_path() / name;
    std::filesystem::create_directories(folder);
    return folder;
}

/// Lets the tests of one build share solved dances, which take seconds to solve: links
/// `cache`/raks/dances to a shared folder. Nothing else of a cache is shared. What lies there is
/// keyed by the program that solved it, so that a new build solves anew. `name`: of the program
/// that solves them, each has a folder of its own.
inline void share_solved_dances(const std::filesystem::path& cache, const std::string& name) {
    std::filesystem::create_directories(cache / "raks");
    std::filesystem::create_directory_symlink(shared_folder("solved_dances/" + name),
                                              cache / "raks" / "dances");
}

}  // namespace raks::test
