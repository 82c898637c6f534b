#include "base/file_set.hpp"

#include <cstddef>
#include <string>
#include <utility>

#include "base/pending_file.hpp"

namespace raks {

Error named_as(const std::filesystem::path& path, const std::filesystem::path& part, Error error) {
    const std::string name = part.string();
    if (const std::size_t at = error.message.find(name); !name.empty() && at != std::string::npos) {
        error.message.replace(at, name.size(), path.string());
    }
    return error;
}

Expected<void> write_files(const std::vector<NamedFile>& files) {
    std::vector<PendingFile> pending;
    for (const NamedFile& file : files) {
        auto made = PendingFile::create(file.path);
        if (!made) {
            return fail(std::move(made.error()));
        }
        if (auto written = made->write(file.bytes); !written) {
            return written;
        }
        pending.push_back(std::move(*made));
    }
    for (PendingFile& file : pending) {
        if (auto committed = file.commit(); !committed) {
            return committed;
        }
    }
    return {};
}

}  // namespace raks
