// MMD text: the standard names of MikuMikuDance as the bytes of its files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raks::motion {

/// How the bytes of a name stand for characters.
enum class MmdCode { windows_932, gbk, utf8 };
inline constexpr MmdCode kMmdCodes[] = {MmdCode::windows_932, MmdCode::gbk, MmdCode::utf8};

/// A standard name, given in UTF-8, in another code. Only the characters of the standard names of
/// bones and morphs are known, so that no conversion table of the system is needed. None: it has
/// another character, or one that the code lacks.
[[nodiscard]] std::optional<std::string> mmd_bytes(std::string_view utf8, MmdCode code);

/// The same name with its digits and Latin letters narrow: `左足ＩＫ` becomes `左足IK`.
[[nodiscard]] std::string narrow(std::string_view utf8);
/// And wide: `左足IK` becomes `左足ＩＫ`.
[[nodiscard]] std::string wide(std::string_view utf8);

}  // namespace raks::motion
