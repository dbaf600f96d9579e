#include "field/field_set.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "core/spelling.h"
#include "field/channel_fields.h"
#include "log/channel.h"

namespace clsurf {

FieldSet::FieldSet(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation)
    : FieldSet(log.records) {
    add(std::make_shared<const PositionFields>(log, path, passes, std::move(derivation)));
    add(std::make_shared<const ChannelFields>(log));
}

FieldSet& FieldSet::add(std::shared_ptr<const FieldProvider> provider) {
    const std::string prefix(provider->prefix());
    for (FieldInfo& info : provider->fields()) {
        Entry entry{std::move(info), {}, providers_.size()};
        entry.own_name = entry.info.name;
        if (find_name(entry.own_name) != nullptr) {
            if (prefix.empty()) throw std::logic_error("two fields are called '" + entry.own_name + "'");
            entry.info.name = prefix + entry.own_name;
        }
        entries_.push_back(std::move(entry));
    }
    providers_.push_back(std::move(provider));
    return *this;
}

std::vector<FieldInfo> FieldSet::fields() const {
    std::vector<FieldInfo> infos;
    for (const Entry& entry : entries_) infos.push_back(entry.info);
    return infos;
}

bool FieldSet::can_compute(std::string_view name) const {
    const std::optional<Found> found = find(name);
    return found && providers_[found->entry->provider]->can_compute(found->entry->own_name);
}

std::vector<std::string> FieldSet::report_names(std::size_t most) const {
    std::vector<const Entry*> ranked;
    for (const Entry& entry : entries_) {
        if (entry.info.report_rank > 0 && providers_[entry.provider]->can_compute(entry.own_name))
            ranked.push_back(&entry);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Entry* a, const Entry* b) { return a->info.report_rank < b->info.report_rank; });
    std::vector<std::string> names;
    for (const Entry* entry : ranked) {
        if (names.size() < most && std::find(names.begin(), names.end(), entry->own_name) == names.end())
            names.push_back(entry->own_name);
    }
    return names;
}

const FieldSet::Entry* FieldSet::find_name(std::string_view name) const {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.info.name == name; });
    return found == entries_.end() ? nullptr : &*found;
}

std::optional<FieldSet::Found> FieldSet::find(std::string_view name) const {
    if (const Entry* entry = find_name(name)) return Found{entry, std::string(name)};
    for (const Entry& entry : entries_) {
        const std::string_view prefix = providers_[entry.provider]->prefix();
        if (!prefix.empty() && name.starts_with(prefix) && name.substr(prefix.size()) == entry.own_name)
            return Found{&entry, std::string(name)};
    }
    for (const Entry& entry : entries_) {
        if (std::find(entry.info.also.begin(), entry.info.also.end(), name) != entry.info.also.end())
            return Found{&entry, entry.info.name};
    }
    return std::nullopt;
}

FieldSet::Found FieldSet::require(std::string_view name) const {
    const std::optional<Found> found = find(name);
    if (!found) unknown_field(name, fields());
    return *found;
}

std::string FieldSet::usual_name(std::string_view word) const {
    const std::optional<Found> found = find(word);
    return found ? found->name : std::string(word);
}

Field FieldSet::get(std::string_view name) const { return std::move(get_all({std::string(name)}).front()); }

std::vector<Field> FieldSet::get_all(const std::vector<std::string>& names) const {
    return get_all(names, {0, points_ - 1});
}

std::vector<Field> FieldSet::get_all(const std::vector<std::string>& names, PointRange points) const {
    std::vector<Found> wanted;
    wanted.reserve(names.size());
    for (const std::string& name : names) wanted.push_back(require(name));
    std::vector<Field> fields(names.size());
    for (std::size_t p = 0; p < providers_.size(); ++p) {
        std::vector<std::string_view> own_names;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (wanted[i].entry->provider != p) continue;
            own_names.push_back(wanted[i].entry->own_name);
            places.push_back(i);
        }
        if (own_names.empty()) continue;
        std::vector<Field> computed = providers_[p]->compute(own_names, points);
        for (std::size_t i = 0; i < places.size(); ++i) {
            fields[places[i]] = std::move(computed.at(i));
            fields[places[i]].info.name = wanted[places[i]].name;
        }
    }
    return fields;
}

namespace {

/// What a log must contain to provide the field; empty: no log provides it.
std::string what_has(std::string_view name) {
    if (name == "limit")
        return "only a simulated log has this field: leave out the log and give --machine FILE; for a recorded log, "
               "--machine FILE provides speed_share, acceleration_share and jerk_share";
    if (is_known_name(name)) return "a channel that this log does not have; `clsurf info` lists those of a log";
    return {};
}

}  // namespace

void unknown_field(std::string_view name, const std::vector<FieldInfo>& fields) {
    std::vector<std::string_view> names;
    names.reserve(fields.size());
    for (const FieldInfo& f : fields) names.push_back(f.name);
    std::string hint = what_has(name);
    if (hint.empty()) hint = did_you_mean(name, names);
    throw UsageError("unknown field '" + std::string(name) + "'",
                     hint.empty() ? "`clsurf help fields` lists them" : hint);
}

}  // namespace clsurf
