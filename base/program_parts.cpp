#include "base/program_parts.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <system_error>

#include "base/file.hpp"

namespace raks {

namespace fs = std::filesystem;

// Not by PATH: all parts must be of the same build.
Expected<fs::path> find_program_part(const std::string& name,
                                     const std::string& folder,
                                     const char* variable) {
    std::error_code ignored;
    const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    const char* const named =
        std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): never set here
    const bool is_named = named != nullptr && *named != '\0';
    const std::array places = {is_named ? fs::path(named) : here / name,
                               is_named ? fs::path(named) : here.parent_path() / folder / name};
    for (const fs::path& place : places) {
        if (is_there(place)) {
            return place;
        }
    }
    return fail(
        places.front().string() +
        ": is not there; it is a part of raks, and has to lie beside it; install raks anew");
}

Expected<void*> load_program_part(const std::string& name,
                                  const std::string& folder,
                                  const char* variable,
                                  const char* function) {
    const auto place = find_program_part(name, folder, variable);
    if (!place) {
        return fail(place.error());
    }
    void* const module = dlopen(place->c_str(), RTLD_NOW | RTLD_LOCAL);
    if (void* const found = module == nullptr ? nullptr : dlsym(module, function)) {
        return found;
    }
    const char* const reason =
        dlerror();  // NOLINT(concurrency-mt-unsafe): glibc's is of the thread
    return fail(place->string() +
                ": cannot be loaded: " + (reason == nullptr ? "it is of another build" : reason));
}

}  // namespace raks
