#pragma once
// Pieces of a surface for ParaView: a .pvtp file names them, and what their points have.

#include <string>
#include <vector>

namespace clsurf::io {

/// The text of a .pvtp file in `folder` (empty: the present one) for .vtp pieces of clsurf export. Throws InputError: a
/// file that is no such piece, or has other columns than the first one.
[[nodiscard]] std::string pvtp_text(const std::vector<std::string>& pieces, const std::string& folder);

}  // namespace clsurf::io
