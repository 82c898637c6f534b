#include <gtest/gtest.h>

#include "base/file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {
namespace {

// Made by: XDG_CONFIG_HOME=/nonexistent raks config show > config/default.toml
TEST(DefaultConfig, the_installed_file_lists_every_key_with_its_default) {
    const auto file = read_file(std::filesystem::path(RAKS_SOURCE_DIR) / "config/default.toml");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(*file, to_toml({}));
}

}  // namespace
}  // namespace raks::engine
