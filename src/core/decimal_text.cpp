#include "core/decimal_text.h"

#include <fmt/format.h>

namespace clsurf {

std::string fixed_text(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
    return text;
}

std::string signed_text(double value, int decimals) {
    const std::string text = fixed_text(value, decimals);
    return text.starts_with('-') ? text : "+" + text;
}

}  // namespace clsurf
