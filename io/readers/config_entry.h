#pragma once
// ConfigEntry: a key of a TOML table that is the name of an option.

#include <string>
#include <vector>

#include "core/place.h"

namespace clsurf::io {

struct ConfigEntry {
    std::string key;
    std::vector<std::string> values;  ///< as typed on a command line; several for an array
    bool is_flag = false;             ///< true or false: `on`, no values
    bool on = false;
    Place where;
};

}  // namespace clsurf::io
