#include "io/formats/program_identity.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/file_name.h"
#include "io/files/json_value.h"
#include "io/files/sha256.h"

namespace clsurf::io {
namespace {

constexpr std::size_t hash_digits = 64;

bool same_hash(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string size_text(const ProgramReference& program) {
    return program.size ? fmt::format("{} bytes, ", *program.size) : std::string();
}

std::string short_hash(const ProgramReference& program) { return program.sha256.substr(0, 12) + "…"; }

std::string_view text_of_program(const Source& program) {
    return {reinterpret_cast<const char*>(program.bytes.data()), program.bytes.size()};
}

std::string with_line_ends(std::string_view text, std::string_view line_end) {
    std::string changed;
    changed.reserve(text.size() + text.size() / 16);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
        if (text[i] == '\n')
            changed += line_end;
        else
            changed += text[i];
    }
    return changed;
}

std::string hash_of(std::string_view text) { return sha256(std::as_bytes(std::span(text.data(), text.size()))); }

}  // namespace

ProgramReference identify(const Source& program) {
    ProgramReference reference{file_name(program.name), sha256(program.bytes), program.bytes.size(), {}};
    if (std::string lf = hash_of(with_line_ends(text_of_program(program), "\n")); lf != reference.sha256)
        reference.sha256_lf = std::move(lf);
    return reference;
}

std::string with_programs(const std::string& metadata, std::span<const ProgramReference> programs) {
    auto json = parse_bounded(metadata);
    if (!json.is_object()) json = Json::object();
    Json list = Json::array();
    for (const ProgramReference& program : programs) {
        Json entry{{"name", program.name}, {"sha256", program.sha256}};
        if (program.size) entry["size"] = *program.size;
        if (!program.sha256_lf.empty()) entry["sha256_lf"] = program.sha256_lf;
        list.push_back(std::move(entry));
    }
    json["programs"] = std::move(list);
    return dump_compact(json);
}

ProgramIdentity check_identity(const Source& program, const Log& log, Diagnostics& diagnostics) {
    std::vector<const ProgramReference*> hashed;
    for (const ProgramReference& known : log.programs) {
        if (known.sha256.size() == hash_digits) hashed.push_back(&known);
    }
    if (hashed.empty()) return ProgramIdentity::unknown;
    const ProgramReference given = identify(program);
    const auto ran_with = [&](std::string_view hash) {
        return std::any_of(hashed.begin(), hashed.end(), [&](const ProgramReference* known) {
            return same_hash(known->sha256, hash) || same_hash(known->sha256_lf, hash);
        });
    };
    // Logs of other writers have one hash, that of the unchanged file.
    if (ran_with(given.sha256) || ran_with(given.sha256_lf.empty() ? given.sha256 : given.sha256_lf) ||
        ran_with(hash_of(with_line_ends(text_of_program(program), "\r\n"))))
        return ProgramIdentity::same;
    const auto namesake = std::find_if(hashed.begin(), hashed.end(), [&](const ProgramReference* known) {
        return file_name(known->name) == given.name;
    });
    const bool edited = namesake != hashed.end();
    const ProgramReference& ran = edited ? **namesake : *hashed.front();
    diagnostics.add({Severity::warning, "log.program", Place::of_file(log.name),
                     fmt::format("{} {}: the log was recorded with {} ({}SHA-256 {}), this file has {}SHA-256 {}",
                                 program.name, edited ? "was edited after the run" : "is not the program that ran",
                                 ran.name, size_text(ran), short_hash(ran), size_text(given), short_hash(given)),
                     "points are mapped to lines only where the two agree; use the file that ran"});
    return edited ? ProgramIdentity::edited : ProgramIdentity::other;
}

}  // namespace clsurf::io
