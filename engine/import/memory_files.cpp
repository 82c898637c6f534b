#include "engine/import/memory_files.hpp"

#include <algorithm>
#include <cstring>
#include <memory>

namespace raks::engine {
namespace {

/// Bytes that are read like a file.
class MemoryStream final : public Assimp::IOStream {
 public:
    explicit MemoryStream(std::string_view bytes) : bytes_(bytes) {}

    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        if (size == 0) {
            return 0;
        }
        const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
        if (whole > 0) {
            std::memcpy(to, bytes_.data() + at_, whole * size);
            at_ += whole * size;
        }
        return whole;
    }
    std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override {
        return 0;
    }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t start = origin == aiOrigin_SET   ? 0
                                  : origin == aiOrigin_CUR ? at_
                                                           : bytes_.size();
        const std::size_t place = start + offset;  // wraps where the offset is negative
        if (place > bytes_.size()) {
            return aiReturn_FAILURE;
        }
        at_ = place;
        return aiReturn_SUCCESS;
    }
    [[nodiscard]] std::size_t Tell() const override { return at_; }
    [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

 private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// A name as the model gives it: assimp puts "./" or the folder of the model in front.
std::string_view plain(std::string_view file) {
    while (file.substr(0, 2) == "./") {
        file.remove_prefix(2);
    }
    return file;
}

}  // namespace

const std::string* MemoryFiles::fetched(std::string_view file) const {
    const std::string_view name = plain(file);
    auto found = beside_.find(name);
    if (found == beside_.end()) {
        found = beside_.emplace(std::string(name), ways_.fetch(name)).first;
    }
    return found->second ? &*found->second : nullptr;
}

bool MemoryFiles::Exists(const char* file) const {
    return plain(file) == name_ || fetched(file) != nullptr;
}

Assimp::IOStream* MemoryFiles::Open(const char* file, const char* mode) {
    if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr) {
        return nullptr;
    }
    if (plain(file) == name_) {
        return std::make_unique<MemoryStream>(model_).release();  // Close() takes it back
    }
    const std::string* const bytes = fetched(file);
    return bytes == nullptr ? nullptr : std::make_unique<MemoryStream>(*bytes).release();
}

void MemoryFiles::Close(Assimp::IOStream* stream) {
    const std::unique_ptr<Assimp::IOStream> owned(stream);
}

}  // namespace raks::engine
