#pragma once
// What viz/page is built to (viz/page/dist), as the build put it into the program.

#include <string_view>

namespace clsurf::io {

[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_style();

}  // namespace clsurf::io
