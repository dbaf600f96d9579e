#include "io/readers/config_file.h"

#include "io/readers/config_entries.h"

namespace clsurf::io {

std::vector<ConfigEntry> read_config(const std::string& path) {
    const TomlFile file(path);
    return config_entries(file, path, file.root());
}

}  // namespace clsurf::io
