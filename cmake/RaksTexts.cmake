# raks_embed_texts(target header constant name file ...): the sources of `target` may include the header
# "HEADER", whose `constant` is an array of pairs: a name and the text of the file.
function(raks_embed_texts target header constant)
    set(entries "")
    while(ARGN)
        list(POP_FRONT ARGN name file)
        file(READ ${file} text)
        string(APPEND entries "    {\"${name}\",\n     R\"embedded(${text})embedded\"},\n")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    endwhile()
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/texts/${header} @ONLY CONTENT [[
#pragma once

#include <string_view>
#include <utility>

namespace raks {

inline constexpr std::pair<std::string_view, std::string_view> @constant@[] = {
@entries@};

}  // namespace raks
]])
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/texts)
endfunction()
