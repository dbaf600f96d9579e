#include "io/files/overwrite_guard.h"

#include <unistd.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"

namespace clsurf::io {
namespace {

/// Two names with the same Inode are the same file.
struct Inode {
    dev_t device = 0;
    ino_t number = 0;
    friend bool operator==(const Inode&, const Inode&) = default;
};

/// An output: the file that it replaces, or the folder and the name of a new file.
struct Output {
    int number = 0;
    std::string path;  ///< as given by the user
    std::optional<Inode> replaced;
    std::optional<Inode> folder;
    std::string name;  ///< name in that folder
};

struct Input {
    std::string path;
    Inode inode;
};

std::mutex mutex;
bool guarded = false;
int last_number = 0;
std::vector<Input> inputs;
std::vector<Output> outputs;

std::optional<Inode> inode_of(const struct stat& status) {
    if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return std::nullopt;
    return Inode{status.st_dev, status.st_ino};
}

std::optional<Inode> inode_at(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return inode_of(status);
}

[[noreturn]] void refuse(const Output& output, const std::string& input) {
    throw UsageError(
        output.path == input
            ? fmt::format("the output '{}' is an input: it would be overwritten", output.path)
            : fmt::format("the output '{}' is the input '{}': it would be overwritten", output.path, input),
        "choose another name for the output");
}

/// Both are the same file, now or once they are written.
bool same(const Output& a, const Output& b) {
    if (a.replaced || b.replaced) return a.replaced == b.replaced;
    return a.folder && a.folder == b.folder && a.name == b.name;
}

}  // namespace

void guard_inputs() {
    const std::scoped_lock lock(mutex);
    guarded = true;
    struct stat status {};
    if (::fstat(STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode))
        outputs.push_back({++last_number, "standard output", inode_of(status), {}, {}});
}

void guard_input(const std::string& path, const struct stat& status) {
    const std::scoped_lock lock(mutex);
    const std::optional<Inode> inode = inode_of(status);
    if (!guarded || !inode) return;
    for (const Output& output : outputs) {
        if (output.replaced == inode) refuse(output, path);
    }
    const bool known = std::any_of(inputs.begin(), inputs.end(), [&](const Input& i) { return i.inode == *inode; });
    if (!known) inputs.push_back({path, *inode});
}

void guard_input(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) guard_input(path, status);
}

OutputClaim::OutputClaim(const std::string& path) {
    const std::scoped_lock lock(mutex);
    if (!guarded) return;
    Output output{last_number + 1, path, inode_at(path), inode_at(folder_of(path)), file_name(path)};
    for (const Input& input : inputs) {
        if (output.replaced == input.inode) refuse(output, input.path);
    }
    for (const Output& other : outputs) {
        if (same(output, other))
            throw UsageError(fmt::format("two outputs have one file: '{}' and '{}'", other.path, output.path));
    }
    number_ = ++last_number;
    outputs.push_back(std::move(output));
}

void OutputClaim::release() {
    if (number_ == 0) return;
    const std::scoped_lock lock(mutex);
    std::erase_if(outputs, [&](const Output& output) { return output.number == number_; });
    number_ = 0;
}

}  // namespace clsurf::io
