#pragma once
// A surface in pieces for ParaView: a .pvtp file lists the pieces and the fields of their points.

#include <string>
#include <vector>

namespace clsurf::io {

/// The text of a .pvtp file in `folder` (empty: the present one) for .vtp pieces of clsurf export. Throws InputError: a
/// file is not such a piece, or has different columns from the first one.
[[nodiscard]] std::string pvtp_text(const std::vector<std::string>& pieces, const std::string& folder);

}  // namespace clsurf::io
