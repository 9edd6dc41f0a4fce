# foveray_embed_text(TARGET SYMBOL FILE): makes the file's text available to the target's sources as
# `inline constexpr std::string_view SYMBOL` in "embedded/SYMBOL.h", so that it cannot be missing at run time.
function(foveray_embed_text target symbol file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/include/embedded/${symbol}.h)
  file(CONFIGURE OUTPUT ${header} @ONLY CONTENT
"#pragma once
#include <string_view>
inline constexpr std::string_view @symbol@ = R\"embedded(@text@)embedded\";
")
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/include)
endfunction()
