#include "program/text/nc_text.h"

#include <cstddef>
#include <utility>

namespace clsurf {

std::string without_end_zeros(std::string number) {
    if (number.find('.') == std::string::npos) return number;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number;
}

std::vector<std::string> fanuc_nurbs_lines(const std::vector<std::string>& points,
                                           const std::vector<std::string>& knots) {
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < knots.size(); ++k) {
        std::string line = (k == 0 ? "G06.2 P4 K" : "K") + knots[k];
        if (k < points.size()) line += " " + points[k];
        lines.push_back(std::move(line));
    }
    return lines;
}

std::string_view line_end_of(std::string_view text) {
    const std::size_t end = text.find('\n');
    return end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

}  // namespace clsurf
