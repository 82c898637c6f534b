#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "audio/music/styles/style_book_reader.hpp"

namespace raks::audio {

/// The styles that come with Raks; empty, and a failed test, where they cannot be read.
inline const StyleBook& shipped_styles() {
    static const StyleBook book = [] {
        auto loaded = load_styles(std::filesystem::path(RAKS_SOURCE_DIR) / "config" / "styles");
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? std::move(*loaded) : StyleBook{};
    }();
    return book;
}

}  // namespace raks::audio
