#include "viz/image_library.h"

#include <dlfcn.h>

#include <future>
#include <string>

#include "core/error.h"

namespace clsurf::viz {
namespace {

constexpr const char* file_name = "libclsurf_image.so";
constexpr const char* entry_name = "clsurf_image_library";

const ImageLibrary* load() {
    void* library = ::dlopen(file_name, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) return nullptr;
    using Entry = const ImageLibrary* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(library, entry_name));
    return entry == nullptr ? nullptr : entry();
}

const std::shared_future<const ImageLibrary*>& loading() {
    static const std::shared_future<const ImageLibrary*> future = std::async(std::launch::async, load).share();
    return future;
}

}  // namespace

const ImageLibrary& image_library() {
    const ImageLibrary* library = loading().get();
    if (library == nullptr)
        throw SystemError(std::string(file_name) + " cannot be loaded: the installation of clsurf is incomplete");
    return *library;
}

ImageLibraryPreload::ImageLibraryPreload() { (void)loading(); }
ImageLibraryPreload::~ImageLibraryPreload() { loading().wait(); }

}  // namespace clsurf::viz
