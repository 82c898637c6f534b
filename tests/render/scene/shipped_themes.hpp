// The themes of config/themes, as tests without a program find them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>

#include "base/file.hpp"
#include "render/scene/theme.hpp"
#include "tests/base/source_tree.hpp"

namespace raks::render {

/// All of them by name. A file that cannot be read fails the test and is left out.
inline const std::map<std::string, Theme, std::less<>>& shipped_themes() {
    static const auto themes = [] {
        std::map<std::string, Theme, std::less<>> read;
        const auto files = list_folder(raks::test::kSourceTree / "config/themes").value();
        for (const auto& file : files) {
            const std::string name = file.stem().string();
            auto theme = parse_theme(read_text_file(file, 1U << 20U).value(), name, file.string());
            EXPECT_TRUE(theme) << (theme ? "" : theme.error().message);
            if (theme) {
                read.emplace(name, std::move(*theme));
            }
        }
        return read;
    }();
    return themes;
}

/// One that there is.
inline const Theme& shipped_theme(std::string_view name) {
    return shipped_themes().find(name)->second;
}

}  // namespace raks::render
