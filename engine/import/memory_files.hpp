// Files for assimp that are in memory. Third-party types: for engine/import alone.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/import/side_source.hpp"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

namespace raks::engine {

/// The model under one name, and beside it what its importer fetches. Nothing can be written.
class MemoryFiles final : public Assimp::IOSystem {
 public:
    /// `model`: its bytes, which must outlive this, as they must all streams.
    MemoryFiles(std::string name, std::string_view model, const ImportWays& ways)
        : name_(std::move(name)), model_(model), ways_(ways) {}

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;
    void Close(Assimp::IOStream* stream) override;

 private:
    const std::string* fetched(std::string_view file) const;

    std::string name_;
    std::string_view model_;
    const ImportWays& ways_;
    mutable std::map<std::string, Expected<std::string>, std::less<>> beside_;
};

}  // namespace raks::engine
