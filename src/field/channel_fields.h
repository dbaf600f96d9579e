#pragma once
// ChannelFields: the channels of a log as fields, in the units in which they were recorded.

#include "field/field_provider.h"
#include "log/log.h"

namespace clsurf {

/// The meaning of a channel's values.
struct ChannelClasses {
    std::string channel, label;
    std::vector<FieldClass> classes;
    std::string class_word = {};  ///< as in FieldInfo
};

class ChannelFields : public FieldProvider {
public:
    /// Shares the columns of the log.
    explicit ChannelFields(const Log& log, std::vector<ChannelClasses> classes = {});

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// O(points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;
    [[nodiscard]] std::string_view prefix() const override { return "log."; }

private:
    [[nodiscard]] FieldInfo info_of(const Channel& channel) const;

    std::vector<Channel> channels_;
    std::vector<ChannelClasses> classes_;
    std::shared_ptr<const void> keep_alive_;
};

}  // namespace clsurf
