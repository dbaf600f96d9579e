#include "cli/version_text.h"

#include <fmt/format.h>

#include "cli/versions.h"
#include "core/error.h"
#include "core/version.h"
#include "viz/gl_context.h"

namespace clsurf::cli {

namespace {

std::string renderer_text() {
    try {
        const auto context = viz::make_gl_context("osmesa", 1, 1);
        return fmt::format("OpenGL {}, {}", context->version(), context->renderer());
    } catch (const SystemError& error) { return fmt::format("none: {}", error.what()); }
}

}  // namespace

std::string version_text() {
    return fmt::format("clsurf {}\ncommit    {}\ncompiler  {}\nlibraries {}\nOSMesa    {}\n", version, source_commit(),
                       compiler_version, library_versions, renderer_text());
}

}  // namespace clsurf::cli
