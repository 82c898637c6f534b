// The form of a grammar's file, for its reader and its writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raks::motion {

inline constexpr std::string_view kGrammarFormat = "raks-dance";  ///< `format` in the file
inline constexpr std::int64_t kGrammarVersion = 1;                ///< the newest that is read
/// Names in files, by FigureGrammar::Starts
inline constexpr std::array<std::string_view, 2> kStartsNames = {"common", "own"};

}  // namespace raks::motion
