// Built against an installed clsurf: its headers are found, its libraries link, its values are
// right.

#include <array>
#include <cstdio>
#include <string_view>

#include "core/spelling.h"
#include "core/version.h"
#include "io/mapped_file.h"

int main(int, char** arguments) {
    const clsurf::io::Source itself = clsurf::io::map_file(arguments[0]);
    const std::array<std::string_view, 2> words{"speed", "jerk"};
    const std::string_view nearest = clsurf::nearest_word("sped", words);
    std::printf("clsurf %s: %.*s, %zu bytes\n", clsurf::version, static_cast<int>(nearest.size()), nearest.data(),
                itself.bytes.size());
    return nearest == "speed" && itself.bytes.size() > 1000 ? 0 : 1;
}
