#pragma once
// The build result of viz/page (viz/page/dist), embedded in the program.

#include <string_view>

namespace clsurf::io {

[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_style();

}  // namespace clsurf::io
