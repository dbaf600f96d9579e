#include "viz/loaded_library.h"

#include <dlfcn.h>

namespace clsurf::viz {

const void* load_table(const char* file, const char* entry) {
    void* library = ::dlopen(file, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) return nullptr;
    using Entry = const void* (*)();
    const auto get = reinterpret_cast<Entry>(::dlsym(library, entry));
    return get == nullptr ? nullptr : get();
}

}  // namespace clsurf::viz
